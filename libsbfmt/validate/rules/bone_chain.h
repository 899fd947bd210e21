/* Runs of bones from an end up through its parents to a root. */
#ifndef SBFI_BONE_CHAIN_H
#define SBFI_BONE_CHAIN_H

#include "sbfmt/model.h"

/* Whether `bone` is `above` or a descendant of it. */
bool sbfi_bone_is_descendant(const sbf_asset *asset, int32_t bone, int32_t above);

typedef struct sbfi_bone_run {
  bool whole;         /* the end is a descendant of the root */
  uint32_t count;     /* bones from root to end, inclusive */
  double reach;       /* m, sum of the rest distances between their heads */
  double off_line;    /* m, maximum distance of heads from the line between root and end */
  double head_to_end; /* m, between the heads of root and end */
} sbfi_bone_run;
sbfi_bone_run sbfi_bone_run_of(const sbf_asset *asset, int32_t root, int32_t end);

/* Distance in metres of a point from the line through the heads of two bones; from the head if they
 * coincide. */
double sbfi_distance_from_line(const sbf_asset *asset, int32_t root, int32_t end, sbf_vec3 position);

#endif
