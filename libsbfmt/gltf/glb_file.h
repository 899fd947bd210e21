/* Binary glTF 2.0 for reading: its JSON, its binary chunk, and typed access to both. The bytes are untrusted.
 * glTF 2.0 specification, sections 3.6 (binary data) and 4 (GLB). */
#ifndef SBFI_GLB_FILE_H
#define SBFI_GLB_FILE_H

#include "gltf/json.h"
#include "sbfmt/codes.h"

typedef struct sbfi_glb_file {
  const sbfi_json *root;
  const uint8_t *binary; /* NULL: there is no binary chunk */
  size_t binary_size;
  sbfi_arena *arena;
  sbf_diagnostic *error;
} sbfi_glb_file;

/* Whether the bytes begin as a GLB. */
bool sbfi_glb_is_begun(const uint8_t *bytes, size_t size);

/* Reads the container and parses the JSON into memory of `arena`. The file refers to `bytes`. */
sbf_status sbfi_glb_file_read(
    sbfi_glb_file *file, const uint8_t *bytes, size_t size, sbfi_arena *arena, sbf_diagnostic *error);
/* The same for JSON and binary data that are not in one block yet. */
sbf_status sbfi_glb_file_parse(sbfi_glb_file *file, const char *json, size_t json_size, const uint8_t *binary,
    size_t binary_size, sbfi_arena *arena, sbf_diagnostic *error);

/* Item `index` of a list of the root, such as "meshes"; NULL, with the file's error set, if there is none. */
const sbfi_json *sbfi_glb_file_item(const sbfi_glb_file *file, const char *list, uint32_t index);

/* Bytes of a buffer view. False, with the file's error set, if it is not inside the binary chunk. */
typedef struct sbfi_glb_bytes {
  const uint8_t *at;
  size_t size, stride; /* stride 0: none is stated */
} sbfi_glb_bytes;
bool sbfi_glb_file_view(const sbfi_glb_file *file, uint32_t index, sbfi_glb_bytes *bytes);

/* Number of items of an accessor of that type ("VEC3"). False, with the file's error set, if it has another
 * type or does not lie inside its view. */
typedef struct sbfi_glb_items {
  const uint8_t *at;
  size_t stride;
  uint32_t count, width, component; /* component: glTF's number of the scalars' type */
} sbfi_glb_items;
bool sbfi_glb_file_accessor(
    const sbfi_glb_file *file, const sbfi_json *index, const char *type, sbfi_glb_items *items);

/* Scalar of an item: 32-bit floats only; whole numbers of any unsigned type. The accessor was checked by
 * sbfi_glb_is_float or sbfi_glb_is_whole. */
bool sbfi_glb_is_float(const sbfi_glb_file *file, const sbfi_glb_items *items);
bool sbfi_glb_is_whole(const sbfi_glb_file *file, const sbfi_glb_items *items);
float sbfi_glb_float(const sbfi_glb_items *items, uint32_t item, uint32_t scalar);
uint32_t sbfi_glb_whole(const sbfi_glb_items *items, uint32_t item, uint32_t scalar);

/* Sets the file's error; always false. */
bool sbfi_glb_fault(const sbfi_glb_file *file, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
