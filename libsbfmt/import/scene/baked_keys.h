/* Bakes the keys of a chain of transforms into keys of one node. */
#ifndef SBFI_BAKED_KEYS_H
#define SBFI_BAKED_KEYS_H

#include "import/scene/raw_scene.h"

typedef struct sbfi_track {
  uint32_t count;
  const float *times;  /* (count) seconds, strictly ascending */
  const float *values; /* (count)(3, or 4 for rotations) */
} sbfi_track;

typedef struct sbfi_keys {
  sbfi_track tracks[SBFI_RAW_TRACKS];
} sbfi_keys;

/* A transform of the chain: its rest value, and keys that replace it. */
typedef struct sbfi_link {
  sbfi_matrix local;
  bool undone;    /* the product uses its inverse; skipped if it is singular */
  sbfi_keys keys; /* tracks without keys keep the rest value; without any keys `local` is constant */
} sbfi_link;

enum { SBFI_LONGEST_CHAIN = 33 };

/* Samples the product links[count - 1] … links[0] at every time of a key; constant tracks get one key.
 * Allocates the results from `arena`; false if memory runs out. */
bool sbfi_bake_keys(
    const sbfi_link *links, uint32_t count, sbfi_arena *arena, sbfi_arena *scratch, sbfi_keys *to);

#endif
