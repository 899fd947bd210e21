/* The middle of a body: points halfway between its surface and the surface opposite, where bones lie. */
#ifndef SBFI_BODY_CORE_H
#define SBFI_BODY_CORE_H

#include "import/rigging/rigging.h"
#include "mechanics/vector.h"

enum { SBFI_CORE_POINTS = 600 };

typedef struct sbfi_core_point {
  sbfi_d3 position;
  double radius; /* half of how thick the body is there */
  double weight; /* by length of body, so that a thin limb counts as much as a thick one; all sum to 1 */
} sbfi_core_point;

typedef struct sbfi_body_core {
  sbfi_core_point points[SBFI_CORE_POINTS];
  uint32_t count; /* 0: the surface encloses nothing */
} sbfi_body_core;

/* In the space of the surface. False where memory runs out. */
bool sbfi_body_core_find(const sbfi_scene_surface *surface, sbfi_body_core *core, sbfi_arena *arena);

/* The core of the same surface elsewhere. */
void sbfi_body_core_move(const sbfi_body_core *from, const sbfi_matrix *similarity, sbfi_body_core *to);

#endif
