/* Runs of bones from an end up its parents to a root. */
#ifndef SBFI_BONE_CHAIN_H
#define SBFI_BONE_CHAIN_H

#include "sbfmt/model.h"

/* Whether `bone` is `above` or hangs on it, at whatever distance. */
bool sbfi_bone_hangs_on(const sbf_asset *asset, int32_t bone, int32_t above);

typedef struct sbfi_bone_run {
  bool whole;         /* the end hangs below the root */
  uint32_t count;     /* bones from root to end, both counted */
  double reach;       /* m: the sum of the distances at rest between their heads */
  double off_line;    /* m: how far the heads between lie from the line from root to end */
  double head_to_end; /* m: between the heads of root and end */
} sbfi_bone_run;
sbfi_bone_run sbfi_bone_run_of(const sbf_asset *asset, int32_t root, int32_t end);

/* Distance in metres of a place from the line through the heads of two bones; from the head where they are
 * in one place. */
double sbfi_distance_from_line(const sbf_asset *asset, int32_t root, int32_t end, sbf_vec3 position);

#endif
