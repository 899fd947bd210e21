/* Reads a glTF file directly, for data that assimp drops. */
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
  json_t *json;   /* NULL if the file is not a readable glTF */
  bytes *buffers; /* (buffer_count); the first buffer of a GLB points into the file */
  size_t buffer_count;
} gltf;

/* Empty if it cannot be read; the caller frees `at`. */
bytes read_file(const char *path);

/* Whether the name has the extension of a glTF file, or the file begins as a binary one. */
bool is_gltf_path(const char *path);
bool begins_as_glb(const char *path);

/* Replaces %XX by their bytes, in place. */
void percent_decode(char *text);

/* Reads the file, without buffers in other files. False if it cannot be read as glTF; gltf_close is required
 * in any case. */
bool gltf_open(gltf *g, const char *path);
/* Reads the buffers beside the file. Those in data URIs stay empty. False if memory runs out. */
bool gltf_load_buffers(gltf *g);
void gltf_close(gltf *g);

/* Number of the node that is assimp's root: the scene's only top node, or GLTF_ADDED if assimp added the
 * root. And of child `index` of a node or of that root; GLTF_UNKNOWN if it has none. assimp keeps the order.
 */
enum { GLTF_ADDED = -1, GLTF_UNKNOWN = -2 };
int32_t gltf_root(const json_t *json);
int32_t gltf_child(const json_t *json, int32_t node, unsigned index);

/* Required extension of the file that makes assimp read wrong vertices; NULL if none. */
const char *gltf_unread_extension(const gltf *g);

uint32_t gltf_word_at(const uint8_t *at);

#endif
