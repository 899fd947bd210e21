/* Finds a pose of a rig without a mesh in which its bones are in the middle of the input. */
#ifndef SBFI_LIMB_FIT_H
#define SBFI_LIMB_FIT_H

#include "import/rigging/body_core.h"
#include "import/rigging/bone_lines.h"

typedef struct sbfi_limb_fit {
  const sbf_bone *bones;
  uint32_t bone_count;
  sbfi_bone_lines rest, posed;
  bool *is_rotated;        /* (bones) first bones of rotated limbs */
  double *rotated_lengths; /* (bones) lengths of these limbs */
  sbfi_matrix *motions;    /* (bones) from rest, asset space; rotations and offsets */
  sbfi_body_core core;     /* asset space */
  double size;             /* of the input, its longest side */
  sbfi_d3 offset;          /* offset of the whole rig */
  bool is_fixed;           /* keeps the offset */
  /* (bones) bones that rotate about x alone while the rig moves in that plane; or NULL */
  const bool *is_middle;
  double cost; /* of the current pose; 0: all bones are in the middle of all parts */
  /* State of the current limb. */
  bool *below;                        /* (bones) its first bone and descendants */
  uint32_t *line_indices, line_count; /* of its lines */
  sbfi_bone_line *rotated_lines;
  double others[SBFI_CORE_POINTS]; /* distances of core points to lines of other bones */
} sbfi_limb_fit;

/* False if memory runs out. */
bool sbfi_limb_fit_begin(sbfi_limb_fit *f, const sbfi_rigging *r, const sbfi_bone_lines *lines,
    const sbfi_body_core *core, sbfi_arena *arena);

/* Updates the lines from the motions of their bones and the offset of the whole rig. */
void sbfi_limb_fit_update_lines(sbfi_limb_fit *f, sbfi_d3 offset);

/* Rotates joints until no rotation is an improvement. */
void sbfi_limb_fit_search(sbfi_limb_fit *f);

#endif
