/* Symmetric poses of a rig: limbs of both sides rotate as mirror images. */
#ifndef SBFI_LIMB_SYMMETRY_H
#define SBFI_LIMB_SYMMETRY_H

#include "import/rigging/limb_fit.h"
#include "import/rigging/surface_finder.h"

typedef struct sbfi_limb_symmetry {
  const sbfi_rigging *r;
  const sbfi_bone_lines *lines;
  int32_t *twins; /* (bones) twin on the other side; the bone itself in the middle; SBF_NONE if it has none */
  int8_t *sides;  /* (bones) 1 left, -1 right, 0 in the middle */
  bool has_twins; /* all bones inside a body have a twin, and some are on a side */
  sbfi_surface_finder finder; /* of the input, in its own space */
} sbfi_limb_symmetry;

/* Pairs bones by name. Allocates from `arena`; false if memory runs out. */
bool sbfi_limb_symmetry_find(
    sbfi_limb_symmetry *s, const sbfi_rigging *r, const sbfi_bone_lines *lines, sbfi_arena *arena);

/* Whether the input in the current alignment is its own mirror image in x about `plane`. */
bool sbfi_limb_symmetry_holds(const sbfi_limb_symmetry *s, double *plane);

/* Fits the limbs of one side (1 left, -1 right) and the middle to the input, starting from the rig's pose
 * of that side, and mirrors the result to the other side. Allocates from `arena`; false if memory runs
 * out. */
bool sbfi_limb_symmetry_search(sbfi_limb_symmetry *s, double plane, int side, const sbfi_body_core *core,
    sbfi_limb_fit *f, sbfi_arena *arena);

#endif
