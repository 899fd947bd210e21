#include "gltf_file.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { GLB_MAGIC = 0x46546c67, GLB_JSON = 0x4e4f534a, GLB_BIN = 0x004e4942 };
enum { PATH_SIZE = 4096 };

bool is_gltf_path(const char *path) {
  const char *dot = strrchr(path, '.');
  return dot && (strcasecmp(dot, ".glb") == 0 || strcasecmp(dot, ".gltf") == 0);
}

bool begins_as_glb(const char *path) {
  uint8_t magic[4];
  FILE *file = fopen(path, "rb");
  if (!file) return false;
  bool begins = fread(magic, 1, sizeof magic, file) == sizeof magic && gltf_word_at(magic) == GLB_MAGIC;
  fclose(file);
  return begins;
}

void percent_decode(char *text) {
  char *to = text;
  for (const char *from = text; *from; from++, to++) {
    unsigned byte;
    bool encoded = *from == '%' && isxdigit((unsigned char)from[1]) && isxdigit((unsigned char)from[2]) &&
                   sscanf(from + 1, "%2x", &byte) == 1 && byte;
    *to = encoded ? (char)byte : *from;
    if (encoded) from += 2;
  }
  *to = 0;
}

bytes read_file(const char *path) {
  bytes content = {NULL, 0};
  FILE *file = fopen(path, "rb");
  if (!file) return content;
  long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
  if (size > 0 && fseek(file, 0, SEEK_SET) == 0) content.at = malloc((size_t)size);
  if (content.at && fread(content.at, 1, (size_t)size, file) == (size_t)size) content.size = (size_t)size;
  fclose(file);
  return content;
}

uint32_t gltf_word_at(const uint8_t *at) {
  return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

/* Reads the chunk of a GLB at `*offset` and advances the offset; empty if it has another type or is
 * truncated. */
static bytes chunk(const bytes *file, size_t *offset, uint32_t type) {
  if (file->size < *offset || file->size - *offset < 8) return (bytes){NULL, 0};
  const uint8_t *header = file->at + *offset;
  size_t size = gltf_word_at(header);
  if (gltf_word_at(header + 4) != type || file->size - *offset - 8 < size) return (bytes){NULL, 0};
  *offset += 8 + size;
  return (bytes){file->at + *offset - size, size};
}

static bytes sibling_buffer(const gltf *g, const json_t *buffer) {
  char path[PATH_SIZE];
  const char *uri = json_string_value(json_object_get(buffer, "uri")), *slash = strrchr(g->path, '/');
  if (!uri || strncmp(uri, "data:", 5) == 0) return (bytes){NULL, 0};
  int length = snprintf(
      path, sizeof path, "%.*s%s", uri[0] == '/' || !slash ? 0 : (int)(slash - g->path) + 1, g->path, uri);
  if (length <= 0 || (size_t)length >= sizeof path) return (bytes){NULL, 0};
  bytes content = read_file(path);
  if (!content.at) {
    percent_decode(path);
    content = read_file(path);
  }
  return content;
}

/* Finds the JSON and the first binary chunk of a GLB; false for a glTF of text. */
static bool split(const gltf *g, bytes *text, bytes *binary) {
  size_t offset = 12;
  if (g->file.size < 12 || gltf_word_at(g->file.at) != GLB_MAGIC) return false;
  *text = chunk(&g->file, &offset, GLB_JSON);
  *binary = chunk(&g->file, &offset, GLB_BIN);
  return true;
}

bool gltf_open(gltf *g, const char *path) {
  *g = (gltf){.path = path, .file = read_file(path)};
  bytes text = g->file, binary;
  split(g, &text, &binary);
  if (text.size) g->json = json_loadb((const char *)text.at, text.size, JSON_DISABLE_EOF_CHECK, NULL);
  return g->json != NULL;
}

bool gltf_load_buffers(gltf *g) {
  bytes text, binary = {NULL, 0};
  bool packed = split(g, &text, &binary);
  const json_t *buffers = json_object_get(g->json, "buffers");
  size_t count = json_array_size(buffers);
  if (g->buffers) return true;
  g->buffers = calloc(count ? count : 1, sizeof *g->buffers);
  if (!g->buffers) return false;
  for (; g->buffer_count < count; g->buffer_count++) {
    const json_t *buffer = json_array_get(buffers, g->buffer_count);
    bool inside = packed && g->buffer_count == 0 && !json_object_get(buffer, "uri");
    g->buffers[g->buffer_count] = inside ? binary : sibling_buffer(g, buffer);
  }
  return true;
}

static int32_t number_in(const json_t *list, size_t index, size_t count) {
  const json_t *number = json_array_get(list, index);
  json_int_t value = json_is_integer(number) ? json_integer_value(number) : -1;
  return value >= 0 && (size_t)value < count && value <= INT32_MAX ? (int32_t)value : GLTF_UNKNOWN;
}

static const json_t *top_nodes(const json_t *json) {
  const json_t *number = json_object_get(json, "scene");
  size_t scene = json_is_integer(number) ? (size_t)json_integer_value(number) : 0;
  return json_object_get(json_array_get(json_object_get(json, "scenes"), scene), "nodes");
}

int32_t gltf_root(const json_t *json) {
  const json_t *tops = top_nodes(json);
  return json_array_size(tops) == 1 ? number_in(tops, 0, json_array_size(json_object_get(json, "nodes")))
                                    : GLTF_ADDED;
}

int32_t gltf_child(const json_t *json, int32_t node, unsigned index) {
  const json_t *nodes = json_object_get(json, "nodes");
  const json_t *children = node >= 0 ? json_object_get(json_array_get(nodes, (size_t)node), "children")
                           : node == GLTF_ADDED ? top_nodes(json)
                                                : NULL;
  return number_in(children, index, json_array_size(nodes));
}

const char *gltf_unread_extension(const gltf *g) {
  static const char *const unread[] = {
      "KHR_mesh_quantization", "EXT_meshopt_compression", "KHR_meshopt_compression"};
  size_t at;
  json_t *required;
  json_array_foreach(json_object_get(g->json, "extensionsRequired"), at, required) {
    for (size_t i = 0; i < sizeof unread / sizeof *unread; i++)
      if (json_is_string(required) && strcmp(json_string_value(required), unread[i]) == 0) return unread[i];
  }
  return NULL;
}

void gltf_close(gltf *g) {
  for (size_t i = 0; i < g->buffer_count; i++) {
    bool inside = g->buffers[i].at >= g->file.at && g->buffers[i].at < g->file.at + g->file.size;
    if (!inside) free(g->buffers[i].at);
  }
  free(g->buffers);
  free(g->file.at);
  json_decref(g->json);
}
