/* Medial points of a body, halfway between its surface and the opposite surface, where bones are expected. */
#ifndef SBFI_BODY_CORE_H
#define SBFI_BODY_CORE_H

#include "import/rigging/rigging.h"
#include "mechanics/vector.h"

enum { SBFI_CORE_POINTS = 600 };

typedef struct sbfi_core_point {
  sbfi_d3 position;
  double radius; /* half of the body's thickness there */
  double weight; /* proportional to the length of the body, so that thin limbs count as much as thick ones;
                    the sum is 1 */
} sbfi_core_point;

typedef struct sbfi_body_core {
  sbfi_core_point points[SBFI_CORE_POINTS];
  uint32_t count; /* 0: the surface encloses no volume */
} sbfi_body_core;

/* Works in the surface's space. False if memory runs out. */
bool sbfi_body_core_find(const sbfi_scene_surface *surface, sbfi_body_core *core, sbfi_arena *arena);

/* Transforms a core. */
void sbfi_body_core_move(const sbfi_body_core *from, const sbfi_matrix *similarity, sbfi_body_core *to);

#endif
