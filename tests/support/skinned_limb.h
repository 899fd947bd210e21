/* A limb under one skin: a tube along +Y over a chain of bones of one metre each. */
#ifndef TEST_SKINNED_LIMB_H
#define TEST_SKINNED_LIMB_H

#include "sbfmt/asset.h"

typedef struct skinned_limb {
  uint32_t bones; /* in a chain, ids b0, b1, ... */
  uint32_t sides, rings_a_bone;
  float radius, slope; /* m; over how much of the length weights go from one bone to the next; 0: a step */
  bool open;           /* without the polygons at both ends */
  bool seam;           /* the vertices of the first column stand there twice, as where a texture begins */
  float rag;           /* m by which the step is shifted from column to column, to and fro */
} skinned_limb;

/* An asset with the bones and one skinned render mesh of quads. Failed allocations end the test program. */
sbf_asset *skinned_limb_make(const skinned_limb *of);

#endif
