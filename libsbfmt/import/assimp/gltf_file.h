/* A glTF file as it is written, for what assimp does not hand on. */
#ifndef GLTF_FILE_H
#define GLTF_FILE_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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

/* Empty where it cannot be read; `at` is to be freed. */
bytes read_file(const char *path);

/* Whether the name ends as that of a glTF file. */
bool is_gltf_path(const char *path);

/* False where it cannot be read as glTF; gltf_close is to follow in any case. Buffers in data URIs stay
 * empty. */
bool gltf_open(gltf *g, const char *path);
void gltf_close(gltf *g);

/* An extension that the file requires and by which assimp would read its vertices wrong; NULL: none. */
const char *gltf_unread_extension(const gltf *g);

uint32_t gltf_word_at(const uint8_t *at);

#endif
