/* Aligns an input with a rig in another pose by rotating the limbs. */
#ifndef SBFI_ALIGN_LIMBS_H
#define SBFI_ALIGN_LIMBS_H

#include "import/rigging/bone_lines.h"

typedef struct sbfi_limb_candidate {
  sbfi_matrix to_asset;
  double factor; /* factor on the cost; greater for rarer alignments */
} sbfi_limb_candidate;

typedef struct sbfi_limb_alignment {
  sbfi_matrix to_asset;  /* from the input's own space */
  sbfi_matrix *motions;  /* (bones) from rest, asset space; rotations and offsets */
  sbfi_bone_line *lines; /* the given lines in the new pose */
  /* see limb_fit.h; unposed_cost is that of the best usual alignment without rotations */
  double cost, unposed_cost;
  char names[300]; /* names of the rotated bones, "" if none */
} sbfi_limb_alignment;

/* Selects the best of several candidate alignments, with rotated limbs. `unposed` is the usual alignment
 * without rotations. Allocates from `arena`; false if memory runs out. */
bool sbfi_align_limbs(sbfi_rigging *r, const sbfi_bone_lines *lines, const sbfi_limb_candidate *candidates,
    uint32_t count, const sbfi_matrix *unposed, sbfi_limb_alignment *found, sbfi_arena *arena);

#endif
