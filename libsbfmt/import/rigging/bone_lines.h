/* The bones of a rig as lines between their joints: what of them is to lie inside a body. */
#ifndef SBFI_BONE_LINES_H
#define SBFI_BONE_LINES_H

#include "import/rigging/rigging.h"
#include "mechanics/vector.h"

typedef struct sbfi_bone_line {
  sbfi_d3 from, to; /* asset space */
  uint32_t bone;    /* that carries both of them */
  uint32_t child;   /* that it leads to */
  bool is_end;      /* to a mark of the end of a limb */
  bool is_tail;     /* of a bone without a child, as long as it may be */
  double length;
} sbfi_bone_line;

typedef struct sbfi_bone_lines {
  sbfi_bone_line *at;
  uint32_t count;
  double total;      /* length */
  sbfi_d3 low, high; /* of the ends */
} sbfi_bone_lines;

/* Frames and controls do not lie in a body: lines run between bones that hold skin, and to marks of ends.
 * Marks that lie farther away than any bone is long are moved nearer. False where memory runs out. */
bool sbfi_bone_lines_find(const sbfi_rigging *r, sbfi_bone_lines *lines, sbfi_arena *arena);

#endif
