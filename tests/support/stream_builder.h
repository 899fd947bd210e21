/* Writes streams as sbfmt-import does, and such as it should not. */
#ifndef TEST_STREAM_BUILDER_H
#define TEST_STREAM_BUILDER_H

#include <stddef.h>
#include <stdint.h>

/* Grows as needed; free() `at`, which is aligned for any type. */
typedef struct stream_builder {
  uint8_t *at;
  size_t size, capacity;
} stream_builder;

void stream_bytes(stream_builder *s, const void *bytes, size_t size); /* and zeros up to a whole word */
void stream_u32(stream_builder *s, uint32_t value);
void stream_f32(stream_builder *s, float value);
void stream_f32s(stream_builder *s, const float *values, size_t count);
void stream_f64(stream_builder *s, double value);
void stream_string(stream_builder *s, const char *text);

/* The beginning: no unit, no axes, whole. */
void stream_header(stream_builder *s);
/* A node without meshes that lies `x, y, z` from its parent, -1 for none; its mesh count still to come. */
void stream_node(
    stream_builder *s, const char *name, int32_t parent, uint32_t kind, float x, float y, float z);
/* A plain node at its parent's place with joint limits: `stated` bits 0 to 2 for twist, swing_y, swing_z, and
 * least and greatest of each. */
void stream_limited_node(stream_builder *s, const char *name, int32_t parent, uint32_t stated,
    const float *bounds, size_t bound_count);
/* Four rows of a matrix that moves by x, y, z. */
void stream_translation(stream_builder *s, float x, float y, float z);
/* A mesh of `count` triangles, three vertices each, without normals, uv sets, bones or shapes. */
void stream_triangles(
    stream_builder *s, const char *name, uint32_t material, const float *positions, uint32_t count);
/* A material with a base colour image; "" for none. */
void stream_material(stream_builder *s, const char *name, const char *image);
/* A list of nothing, and the end. */
void stream_none(stream_builder *s);
void stream_end(stream_builder *s);

/* A scene with one of everything, for tests that damage it. */
void stream_everything(stream_builder *s);

#endif
