/* Closing a surface. */
#ifndef SBFI_SECTION_CAPS_H
#define SBFI_SECTION_CAPS_H

#include "base/memory.h"
#include "sbfmt/model.h"

typedef struct sbfi_caps {
  uint32_t loops;      /* holes closed */
  uint32_t left_sides; /* sides of polygons at which the surface stays open: they are part of no loop */
} sbfi_caps;

/* Closes every hole. A side that one polygon passes and none passes the other way is a hole's; they are
 * followed to loops, which are split where they meet themselves in a point. A loop of three or four sides
 * gets one polygon, a longer one a point in its middle with a triangle to each side. Sides at which several
 * sheets meet may lie in no loop: they are counted and stay open.
 *
 * `*mesh` is changed to one with more points and polygons, behind those it has, in memory of `arena`. False
 * where memory runs out. */
bool sbfi_section_caps_make(sbf_polygon_mesh *mesh, sbfi_caps *caps, sbfi_arena *arena);

#endif
