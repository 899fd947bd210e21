#include "stream_builder.h"

#include <stdlib.h>
#include <string.h>

#include "import/scene/stream_format.h"

static void append(stream_builder *s, const void *bytes, size_t size) {
  if (s->size + size > s->capacity) {
    s->capacity = 2 * (s->size + size) + 256;
    s->at = realloc(s->at, s->capacity);
    if (!s->at) abort();
  }
  if (size) memcpy(s->at + s->size, bytes, size);
  s->size += size;
}

void stream_bytes(stream_builder *s, const void *bytes, size_t size) {
  append(s, bytes, size);
  append(s, "\0\0\0", -size & 3);
}

void stream_u32(stream_builder *s, uint32_t value) {
  append(s, &value, sizeof value);
}

void stream_f32(stream_builder *s, float value) {
  append(s, &value, sizeof value);
}

void stream_f32s(stream_builder *s, const float *values, size_t count) {
  append(s, values, count * sizeof *values);
}

void stream_f64(stream_builder *s, double value) {
  append(s, &value, sizeof value);
}

void stream_string(stream_builder *s, const char *text) {
  stream_u32(s, (uint32_t)strlen(text));
  stream_bytes(s, text, strlen(text));
}

void stream_none(stream_builder *s) {
  stream_u32(s, 0);
}

void stream_header(stream_builder *s) {
  stream_u32(s, SBFI_STREAM_MAGIC);
  stream_u32(s, SBFI_STREAM_VERSION);
  stream_string(s, "a test");
  stream_f64(s, 0);
  for (int i = 0; i < 6; i++) stream_u32(s, 0);
  stream_u32(s, 0);
}

void stream_translation(stream_builder *s, float x, float y, float z) {
  const float rows[] = {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1};
  stream_f32s(s, rows, 16);
}

void stream_node(
    stream_builder *s, const char *name, int32_t parent, uint32_t kind, float x, float y, float z) {
  stream_string(s, name);
  stream_u32(s, (uint32_t)parent);
  stream_u32(s, kind);
  stream_u32(s, UINT32_MAX);
  stream_translation(s, x, y, z);
  stream_u32(s, 0);
}

void stream_limited_node(stream_builder *s, const char *name, int32_t parent, uint32_t stated,
    const float *bounds, size_t bound_count) {
  stream_string(s, name);
  stream_u32(s, (uint32_t)parent);
  stream_u32(s, 0);
  stream_u32(s, UINT32_MAX);
  stream_translation(s, 0, 0, 0);
  stream_u32(s, stated);
  stream_f32s(s, bounds, bound_count);
}

void stream_triangles(
    stream_builder *s, const char *name, uint32_t material, const float *positions, uint32_t count) {
  stream_string(s, name);
  stream_u32(s, material);
  stream_u32(s, 3 * count);
  stream_f32s(s, positions, 9 * (size_t)count);
  stream_u32(s, 0);
  stream_u32(s, 0);
  stream_none(s);
  stream_u32(s, count);
  for (uint32_t i = 0; i < count; i++) stream_u32(s, 3);
  stream_u32(s, 3 * count);
  for (uint32_t i = 0; i < 3 * count; i++) stream_u32(s, i);
  stream_none(s);
  stream_none(s);
}

void stream_material(stream_builder *s, const char *name, const char *image) {
  const float values[] = {1, 0.5f, 0.25f, 1, 0, 0, 0, 0.5f, 0.25f, 0.5f};
  stream_string(s, name);
  stream_f32s(s, values, 10);
  stream_u32(s, 0);
  stream_u32(s, 1);
  const char *const images[] = {image, "", ""};
  const float in_place[] = {0, 0, 0, 1, 1};
  for (int k = 0; k < 3; k++) {
    stream_string(s, images[k]);
    stream_u32(s, 0);
    stream_f32s(s, in_place, 5);
  }
}

void stream_end(stream_builder *s) {
  stream_u32(s, SBFI_STREAM_END);
}

/* A quad with normals, uvs, a bone, a shape, a material with an embedded image, and a clip of its bone, which
 * hangs on an FBX helper. */
void stream_everything(stream_builder *s) {
  static const float quad[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0},
                     moved[] = {0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 1, 0};
  static const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, uvs[] = {0, 0, 1, 0, 1, 1, 0, 1};
  static const float colors[] = {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 0.5f};
  stream_header(s);
  stream_u32(s, 4);
  static const float bounds[] = {-0.25f, 0.5f, -1, 1};
  stream_limited_node(s, "root", -1, 5, bounds, 4);
  stream_none(s);
  stream_node(s, "bone_$AssimpFbx$_Translation", 0, SBFI_STREAM_PLAIN, 0, 1, 0);
  stream_none(s);
  stream_node(s, "bone", 1, SBFI_STREAM_BONE, 0, 0, 1);
  stream_none(s);
  stream_node(s, "skin", 0, SBFI_STREAM_NO_BONE, 0, 0, 0);
  stream_u32(s, 1);
  stream_u32(s, 0);
  stream_u32(s, 1);
  stream_string(s, "quad");
  stream_u32(s, 0);
  stream_u32(s, 4);
  stream_f32s(s, quad, 12);
  stream_u32(s, 1);
  stream_f32s(s, normals, 12);
  stream_u32(s, 1);
  stream_f32s(s, colors, 16);
  stream_u32(s, 1);
  stream_f32s(s, uvs, 8);
  stream_u32(s, 1);
  stream_u32(s, 4);
  stream_u32(s, 4);
  for (uint32_t i = 0; i < 4; i++) stream_u32(s, i);
  stream_u32(s, 1);
  stream_string(s, "bone");
  stream_translation(s, 0, -1, -1);
  stream_u32(s, 2);
  stream_u32(s, 1);
  stream_u32(s, 3);
  stream_f32(s, 0.5f);
  stream_f32(s, 1);
  stream_u32(s, 1);
  stream_string(s, "wide");
  stream_f32(s, 0);
  stream_f32s(s, moved, 12);
  stream_u32(s, 1);
  stream_material(s, "paint", "*0");
  stream_u32(s, 1);
  stream_string(s, "paint.png");
  stream_string(s, "png");
  stream_u32(s, 5);
  stream_bytes(s, "image", 5);
  stream_u32(s, 1);
  stream_string(s, "nod");
  stream_f64(s, 10);
  stream_f64(s, 10);
  stream_u32(s, 2);
  stream_string(s, "bone_$AssimpFbx$_Translation");
  stream_u32(s, 2);
  for (int i = 0; i < 2; i++) {
    const float at[] = {0, 1 + (float)i, 0};
    stream_f64(s, 10.0 * i);
    stream_f32s(s, at, 3);
  }
  stream_none(s);
  stream_none(s);
  stream_string(s, "bone");
  stream_none(s);
  stream_u32(s, 1);
  stream_f64(s, 5);
  const float turn[] = {0, 1, 0, 0};
  stream_f32s(s, turn, 4);
  stream_none(s);
  stream_end(s);
}
