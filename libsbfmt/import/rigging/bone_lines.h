/* The bones of a rig as line segments between joints that should be inside a body. */
#ifndef SBFI_BONE_LINES_H
#define SBFI_BONE_LINES_H

#include "import/rigging/rigging.h"
#include "mechanics/vector.h"

typedef struct sbfi_bone_line {
  sbfi_d3 from, to; /* asset space */
  uint32_t bone;    /* bone that moves both ends */
  uint32_t child;   /* bone at the line's end */
  bool is_end;      /* ends at the mark of a limb's end */
  bool is_tail;     /* of a bone without a child, with a guessed length */
  double length;
} sbfi_bone_line;

typedef struct sbfi_bone_lines {
  sbfi_bone_line *at;
  uint32_t count;
  double total;      /* total length */
  sbfi_d3 low, high; /* bounds of the ends */
} sbfi_bone_lines;

/* Frames and controls are not inside a body: lines connect bones with skin, and end marks. End marks
 * farther away than the longest bone are moved closer. False if memory runs out. */
bool sbfi_bone_lines_find(const sbfi_rigging *r, sbfi_bone_lines *lines, sbfi_arena *arena);

#endif
