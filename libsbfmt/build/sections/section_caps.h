/* Closes holes of a surface. */
#ifndef SBFI_SECTION_CAPS_H
#define SBFI_SECTION_CAPS_H

#include "base/memory.h"
#include "sbfmt/model.h"

typedef struct sbfi_caps {
  uint32_t loops;      /* number of closed holes */
  uint32_t left_sides; /* number of edges at which the surface stays open, because they are in no loop */
} sbfi_caps;

/* Closes every hole. An edge that one polygon traverses and none traverses in reverse belongs to a hole.
 * Edges are joined to loops, which are split at repeated points. A loop of three or four edges gets one
 * polygon, a longer one a point in its centre with a triangle to each edge. Edges of several sheets may be in
 * no loop: they are counted and stay open.
 *
 * Appends points and polygons to `*mesh`, allocated from `arena`. False if memory runs out. */
bool sbfi_section_caps_make(sbf_polygon_mesh *mesh, sbfi_caps *caps, sbfi_arena *arena);

#endif
