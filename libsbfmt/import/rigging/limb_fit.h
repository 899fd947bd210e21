/* A pose of the rig's bones, without a mesh of its own, in which they lie in the middle of the input. */
#ifndef SBFI_LIMB_FIT_H
#define SBFI_LIMB_FIT_H

#include "import/rigging/body_core.h"
#include "import/rigging/bone_lines.h"

typedef struct sbfi_limb_fit {
  const sbf_bone *bones;
  uint32_t bone_count;
  sbfi_bone_lines rest, posed;
  bool *is_turned;        /* (bones) the first of limbs that turned */
  double *turned_lengths; /* (bones) of those limbs */
  sbfi_matrix *motions;   /* (bones) from rest, asset space; rotations and offsets */
  sbfi_body_core core;    /* asset space */
  double size;            /* of the input, its longest side */
  sbfi_d3 offset;         /* by which the whole of the rig moved */
  bool is_fixed;          /* it does not */
  const bool *is_middle;  /* (bones) those that turn about x alone, with the whole moved across it; or NULL */
  double cost;            /* of the pose at hand: 0 where all bones lie in the middle of all parts */
  /* Of the limb at hand. */
  bool *below;                        /* (bones) its first bone and what hangs on it */
  uint32_t *line_indices, line_count; /* of its lines */
  sbfi_bone_line *turned_lines;
  double others[SBFI_CORE_POINTS]; /* distance of core points to lines of no limb */
} sbfi_limb_fit;

/* False where memory runs out. */
bool sbfi_limb_fit_begin(sbfi_limb_fit *f, const sbfi_rigging *r, const sbfi_bone_lines *lines,
    const sbfi_body_core *core, sbfi_arena *arena);

/* Lays lines by the motions of their bones, and moves the whole, after `begin`. */
void sbfi_limb_fit_take_motions(sbfi_limb_fit *f, sbfi_d3 offset);

/* Turns joints until no turn is better. */
void sbfi_limb_fit_search(sbfi_limb_fit *f);

#endif
