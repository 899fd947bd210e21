/* Keys of one node from those of a chain of transforms that it is the product of. */
#ifndef SBFI_BAKED_KEYS_H
#define SBFI_BAKED_KEYS_H

#include "import/scene/raw_scene.h"

typedef struct sbfi_track {
  uint32_t count;
  const float *times;  /* (count) seconds, strictly ascending */
  const float *values; /* (count)(3, or 4 of a rotation) */
} sbfi_track;

typedef struct sbfi_keys {
  sbfi_track tracks[SBFI_RAW_TRACKS];
} sbfi_keys;

/* A transform of the chain: what it is at rest, and keys in its place. */
typedef struct sbfi_link {
  sbfi_matrix local;
  bool undone;    /* its inverse stands in the product; one that flattens everything is passed over then */
  sbfi_keys keys; /* a track without keys keeps the rest value; without any, `local` stays as it is */
} sbfi_link;

enum { SBFI_LONGEST_CHAIN = 33 };

/* The product links[count - 1] … links[0] at every time at which any of them has a key; a track that never
 * changes gets one key. Results in `arena`; false where memory runs out. */
bool sbfi_bake_keys(
    const sbfi_link *links, uint32_t count, sbfi_arena *arena, sbfi_arena *scratch, sbfi_keys *to);

#endif
