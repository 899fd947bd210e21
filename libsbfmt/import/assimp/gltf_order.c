#include "gltf_order.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { GLB_MAGIC = 0x46546c67, GLB_JSON = 0x4e4f534a, GLB_BIN = 0x004e4942 };
enum { UNSIGNED_BYTE = 5121, UNSIGNED_SHORT = 5123, UNSIGNED_INT = 5125, FLOAT = 5126, TRIANGLES = 4 };
enum { PATH_SIZE = 4096 };
static const uint32_t unused = UINT32_MAX;

typedef struct bytes {
  uint8_t *at;
  size_t size;
} bytes;

typedef struct gltf {
  const char *path;
  bytes file;
  json_t *json;
  bytes *buffers; /* (buffer_count); the first of a GLB lies in the file */
  size_t buffer_count;
} gltf;

/* Items of an accessor where they lie. */
typedef struct view {
  const uint8_t *at;
  size_t count, stride;
  json_int_t type;
} view;

static bytes read_file(const char *path) {
  bytes content = {NULL, 0};
  FILE *file = fopen(path, "rb");
  if (!file) return content;
  long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
  if (size > 0 && fseek(file, 0, SEEK_SET) == 0) content.at = malloc((size_t)size);
  if (content.at && fread(content.at, 1, (size_t)size, file) == (size_t)size) content.size = (size_t)size;
  fclose(file);
  return content;
}

static uint32_t word_at(const uint8_t *at) {
  return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

/* The chunk of a GLB that begins at `*offset`, which moves behind it; nothing where it is another or cut. */
static bytes chunk(const bytes *file, size_t *offset, uint32_t type) {
  if (file->size < *offset || file->size - *offset < 8) return (bytes){NULL, 0};
  const uint8_t *header = file->at + *offset;
  size_t size = word_at(header);
  if (word_at(header + 4) != type || file->size - *offset - 8 < size) return (bytes){NULL, 0};
  *offset += 8 + size;
  return (bytes){file->at + *offset - size, size};
}

static bytes buffer_beside(const gltf *g, const json_t *buffer) {
  char path[PATH_SIZE];
  const char *uri = json_string_value(json_object_get(buffer, "uri")), *slash = strrchr(g->path, '/');
  if (!uri || strncmp(uri, "data:", 5) == 0 || strchr(uri, '%')) return (bytes){NULL, 0};
  int length = snprintf(
      path, sizeof path, "%.*s%s", uri[0] == '/' || !slash ? 0 : (int)(slash - g->path) + 1, g->path, uri);
  return length > 0 && (size_t)length < sizeof path ? read_file(path) : (bytes){NULL, 0};
}

static bool open_gltf(gltf *g, const char *path) {
  *g = (gltf){.path = path, .file = read_file(path)};
  bytes text = g->file, binary = {NULL, 0};
  bool packed = g->file.size >= 12 && word_at(g->file.at) == GLB_MAGIC;
  if (packed) {
    size_t offset = 12;
    text = chunk(&g->file, &offset, GLB_JSON);
    binary = chunk(&g->file, &offset, GLB_BIN);
  }
  if (text.size) g->json = json_loadb((const char *)text.at, text.size, JSON_DISABLE_EOF_CHECK, NULL);
  const json_t *buffers = json_object_get(g->json, "buffers");
  size_t count = json_array_size(buffers);
  g->buffers = calloc(count ? count : 1, sizeof *g->buffers);
  if (!g->json || !g->buffers) return false;
  for (; g->buffer_count < count; g->buffer_count++) {
    const json_t *buffer = json_array_get(buffers, g->buffer_count);
    bool inside = packed && g->buffer_count == 0 && !json_object_get(buffer, "uri");
    g->buffers[g->buffer_count] = inside ? binary : buffer_beside(g, buffer);
  }
  return true;
}

static void close_gltf(gltf *g) {
  for (size_t i = 0; i < g->buffer_count; i++) {
    bool inside = g->buffers[i].at >= g->file.at && g->buffers[i].at < g->file.at + g->file.size;
    if (!inside) free(g->buffers[i].at);
  }
  free(g->buffers);
  free(g->file.at);
  json_decref(g->json);
}

static bool size_of(const json_t *object, const char *key, size_t *to) {
  const json_t *value = json_object_get(object, key);
  if (value && (!json_is_integer(value) || json_integer_value(value) < 0)) return false;
  *to = value ? (size_t)json_integer_value(value) : 0;
  return true;
}

/* Of `components` numbers an item; false where it cannot be read in place. */
static bool open_view(const gltf *g, const json_t *number, size_t components, view *to) {
  size_t view_number, buffer, first, offset, length, width;
  const json_t *accessor = json_array_get(json_object_get(g->json, "accessors"),
      json_is_integer(number) ? (size_t)json_integer_value(number) : SIZE_MAX);
  if (!accessor || json_object_get(accessor, "sparse") || !json_object_get(accessor, "bufferView"))
    return false;
  if (!size_of(accessor, "bufferView", &view_number) || !size_of(accessor, "byteOffset", &offset) ||
      !size_of(accessor, "count", &to->count))
    return false;
  const json_t *v = json_array_get(json_object_get(g->json, "bufferViews"), view_number);
  if (!v || json_object_get(v, "extensions") || !size_of(v, "buffer", &buffer) ||
      !size_of(v, "byteOffset", &first) || !size_of(v, "byteLength", &length) ||
      !size_of(v, "byteStride", &to->stride) || buffer >= g->buffer_count)
    return false;
  to->type = json_integer_value(json_object_get(accessor, "componentType"));
  width = components * (to->type == UNSIGNED_BYTE ? 1 : to->type == UNSIGNED_SHORT ? 2 : 4);
  if (!to->stride) to->stride = width;
  const bytes *from = &g->buffers[buffer];
  if (!from->at || first > from->size || length > from->size - first || offset > length || !to->count ||
      to->stride > length || (to->count - 1) > (length - offset) / to->stride ||
      (to->count - 1) * to->stride + width > length - offset)
    return false;
  to->at = from->at + first + offset;
  return true;
}

static uint32_t index_at(const view *v, size_t i) {
  const uint8_t *at = v->at + i * v->stride;
  if (v->type == UNSIGNED_BYTE) return at[0];
  return v->type == UNSIGNED_SHORT ? at[0] | (uint32_t)at[1] << 8 : word_at(at);
}

/* Fills `source` (mNumVertices): the file's number of each vertex. False where the mesh is not this
 * primitive. */
static bool match(const gltf *g, const json_t *primitive, const struct aiMesh *mesh, uint32_t *source) {
  view indices, positions;
  const json_t *mode = json_object_get(primitive, "mode");
  if ((mode && json_integer_value(mode) != TRIANGLES) ||
      !open_view(g, json_object_get(primitive, "indices"), 1, &indices) || indices.type == FLOAT ||
      !open_view(g, json_object_get(json_object_get(primitive, "attributes"), "POSITION"), 3, &positions) ||
      positions.type != FLOAT || indices.count != 3 * (size_t)mesh->mNumFaces)
    return false;
  for (unsigned i = 0; i < mesh->mNumVertices; i++) source[i] = unused;
  for (size_t c = 0; c < indices.count; c++) {
    const struct aiFace *face = &mesh->mFaces[c / 3];
    uint32_t from = index_at(&indices, c), to = face->mNumIndices == 3 ? face->mIndices[c % 3] : unused;
    if (to >= mesh->mNumVertices || from >= positions.count || (source[to] != unused && source[to] != from) ||
        memcmp(positions.at + from * positions.stride, &mesh->mVertices[to], 3 * sizeof(float)) != 0)
      return false;
    source[to] = from;
  }
  return true;
}

/* Turns the file's numbers into the places of a list without gaps; vertices that nothing uses come last. */
static bool rank(uint32_t *source, unsigned count) {
  uint32_t end = 0;
  for (unsigned i = 0; i < count; i++)
    if (source[i] != unused && source[i] >= end) end = source[i] + 1;
  uint32_t *place = malloc(((size_t)end + 1) * sizeof *place), next = 0;
  if (!place) return false;
  for (uint32_t s = 0; s < end; s++) place[s] = unused;
  for (unsigned i = 0; i < count; i++)
    if (source[i] != unused) place[source[i]] = i;
  bool once = true; /* two vertices of one number: not what assimp does */
  for (unsigned i = 0; i < count; i++) once = once && (source[i] == unused || place[source[i]] == i);
  for (uint32_t s = 0; s < end; s++)
    if (place[s] != unused) source[place[s]] = next++;
  for (unsigned i = 0; i < count; i++)
    if (source[i] == unused) source[i] = next++;
  free(place);
  return once;
}

static bool reorder(void *items, size_t width, const uint32_t *place, unsigned count) {
  uint8_t *from = items, *to = from ? malloc(count * width) : NULL;
  if (!from) return true;
  if (!to) return false;
  for (unsigned i = 0; i < count; i++) memcpy(to + place[i] * width, from + i * width, width);
  memcpy(from, to, count * width);
  free(to);
  return true;
}

static void apply(struct aiMesh *mesh, const uint32_t *place) {
  unsigned n = mesh->mNumVertices;
  bool good = reorder(mesh->mVertices, sizeof *mesh->mVertices, place, n) &&
              reorder(mesh->mNormals, sizeof *mesh->mNormals, place, n) &&
              reorder(mesh->mTangents, sizeof *mesh->mTangents, place, n) &&
              reorder(mesh->mBitangents, sizeof *mesh->mBitangents, place, n);
  for (unsigned i = 0; good && i < AI_MAX_NUMBER_OF_TEXTURECOORDS; i++)
    good = reorder(mesh->mTextureCoords[i], sizeof *mesh->mTextureCoords[i], place, n);
  for (unsigned i = 0; good && i < AI_MAX_NUMBER_OF_COLOR_SETS; i++)
    good = reorder(mesh->mColors[i], sizeof *mesh->mColors[i], place, n);
  for (unsigned i = 0; good && i < mesh->mNumAnimMeshes; i++)
    if (mesh->mAnimMeshes[i]->mNumVertices == n)
      good = reorder(mesh->mAnimMeshes[i]->mVertices, sizeof *mesh->mAnimMeshes[i]->mVertices, place, n);
  if (!good) abort(); /* half of a mesh in another order: the parent reports that the importer broke down */
  for (unsigned f = 0; f < mesh->mNumFaces; f++)
    for (unsigned k = 0; k < mesh->mFaces[f].mNumIndices; k++)
      mesh->mFaces[f].mIndices[k] = place[mesh->mFaces[f].mIndices[k]];
  for (unsigned b = 0; b < mesh->mNumBones; b++)
    for (unsigned k = 0; k < mesh->mBones[b]->mNumWeights; k++) {
      unsigned *vertex = &mesh->mBones[b]->mWeights[k].mVertexId;
      if (*vertex < n) *vertex = place[*vertex];
    }
}

static void restore_mesh(const gltf *g, struct aiMesh *mesh) {
  uint32_t *source = mesh->mVertices ? malloc((mesh->mNumVertices + 1) * sizeof *source) : NULL;
  if (!source) return;
  size_t m, p;
  json_t *described, *primitive;
  bool found = false;
  json_array_foreach(json_object_get(g->json, "meshes"), m, described) {
    json_array_foreach(json_object_get(described, "primitives"), p, primitive) {
      if (!found && match(g, primitive, mesh, source)) found = true;
      if (found) break;
    }
    if (found) break;
  }
  if (found && rank(source, mesh->mNumVertices)) apply(mesh, source);
  free(source);
}

void restore_gltf_order(struct aiScene *scene, const char *path) {
  const char *dot = strrchr(path, '.');
  if (!dot || (strcasecmp(dot, ".glb") != 0 && strcasecmp(dot, ".gltf") != 0)) return;
  gltf g;
  if (open_gltf(&g, path))
    for (unsigned i = 0; i < scene->mNumMeshes; i++) restore_mesh(&g, scene->mMeshes[i]);
  close_gltf(&g);
}
