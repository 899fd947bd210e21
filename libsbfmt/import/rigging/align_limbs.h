/* Lays an input over a rig whose limbs stand otherwise, by turning the limbs. */
#ifndef SBFI_ALIGN_LIMBS_H
#define SBFI_ALIGN_LIMBS_H

#include "import/rigging/bone_lines.h"

typedef struct sbfi_limb_candidate {
  sbfi_matrix to_asset;
  double factor; /* of its cost: the rarer, the greater */
} sbfi_limb_candidate;

typedef struct sbfi_limb_alignment {
  sbfi_matrix to_asset;      /* of the input's own space */
  sbfi_matrix *motions;      /* (bones) from rest, asset space; rotations and offsets */
  sbfi_bone_line *lines;     /* those given, moved */
  double cost, unposed_cost; /* see limb_fit.h; the second of the usual alignment without turns */
  char names[300];           /* of the bones that turn, "" for none */
} sbfi_limb_alignment;

/* Of several ways in which the input may lie over the rig, the best with limbs turned. `unposed` is the usual
 * one without. Memory of `arena`; false where it runs out. */
bool sbfi_align_limbs(sbfi_rigging *r, const sbfi_bone_lines *lines, const sbfi_limb_candidate *candidates,
    uint32_t count, const sbfi_matrix *unposed, sbfi_limb_alignment *found, sbfi_arena *arena);

#endif
