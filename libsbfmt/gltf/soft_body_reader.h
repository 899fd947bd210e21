/* Reader of the glTF extension SBF_soft_body (spec/gltf/SBF_soft_body/README.md): an asset whose render
 * meshes, images and clips are those of the glTF file. */
#ifndef SBFI_SOFT_BODY_READER_H
#define SBFI_SOFT_BODY_READER_H

#include "gltf/glb_file.h"
#include "model/schema.h"
#include "packed/packed_codec.h"
#include "sbfmt/packed.h"

#define SBFI_GLTF_EXTENSION "SBF_soft_body"

/* Shorter lists are arrays of JSON; longer ones have a buffer view. */
enum { SBFI_GLTF_INLINE_SCALARS = 16 };

/* Names of filters and codecs, by sbfi_packed_filter and sbfi_packed_codec. */
extern const char *const sbfi_gltf_filter_names[SBFI_FILTER_COUNT];
extern const char *const sbfi_gltf_codec_names[SBFI_CODEC_COUNT];

typedef struct sbfi_gltf_reader {
  sbfi_glb_file file;
  sbf_load_options options; /* with defaults filled in */
  sbfi_arena *arena;        /* of the new asset */
  sbfi_arena scratch;       /* until the load ends; the file's JSON too */
  sbfi_packed_coder coder;
  uint64_t inflated_bytes, inflated_limit;
  uint32_t minor;            /* of the version that the extension states */
  bool newer;                /* a later minor version: may have unknown content */
  uint32_t borrowed_count;   /* lists that are to be taken from the glTF file */
  uint32_t mesh_comparisons; /* with stated checksums */
  uint32_t left_out;         /* skipped members of a newer version */
  char first_left_out[160];
} sbfi_gltf_reader;

/* Size and form of a list. */
typedef struct sbfi_gltf_list {
  const char *name; /* for messages */
  sbfi_item item;
  uint32_t width; /* scalars in an item */
} sbfi_gltf_list;

/* Whether the list is taken from the glTF file. */
bool sbfi_gltf_is_borrowed(const sbfi_json *json);
/* Number of items that the JSON of a list states. False, with the error set, if it is malformed or above
 * the limits. */
bool sbfi_gltf_count(
    const sbfi_gltf_reader *r, const sbfi_json *json, const sbfi_gltf_list *list, uint32_t *count);
/* Reads a list that is not borrowed into memory of `arena`; an empty list gives NULL. False, with the error
 * set, if it is malformed or memory runs out. */
bool sbfi_gltf_read_list(sbfi_gltf_reader *r, const sbfi_json *json, const sbfi_gltf_list *list,
    sbfi_arena *arena, const void **items, uint32_t *count);

/* Adds the correction of a borrowed list, if it has one, to its scalars as the glTF file gives them. */
bool sbfi_gltf_correct(sbfi_gltf_reader *r, const sbfi_json *json, const sbfi_gltf_list *list,
    uint32_t *scalars, uint32_t count);

/* Fills all borrowed lists of an asset that is otherwise complete. `extension` is its JSON. */
bool sbfi_gltf_restore(sbfi_gltf_reader *r, const sbfi_json *extension, sbf_asset *asset);

/* Reads the extension's JSON into `asset`, which has its defaults. The file's `error` is not NULL. */
sbf_status sbfi_gltf_read_asset(sbfi_gltf_reader *r, const sbfi_json *extension, sbf_asset *asset);

/* Difference of two scalars by their bits: small for neighbouring floats of one sign. */
static inline uint32_t sbfi_gltf_difference(uint32_t bits, uint32_t from) {
  uint32_t d = bits - from;
  return d << 1 ^ (d >> 31 ? UINT32_MAX : 0);
}
static inline uint32_t sbfi_gltf_add_difference(uint32_t from, uint32_t difference) {
  return from + (difference >> 1 ^ (difference & 1 ? UINT32_MAX : 0));
}

#endif
