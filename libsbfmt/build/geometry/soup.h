/* Triangles of a surface prepared for inside tests. */
#ifndef SBFI_SOUP_H
#define SBFI_SOUP_H

#include "base/memory.h"
#include "mechanics/vector.h"
#include "sbfmt/model.h"

typedef struct sbfi_soup {
  sbfi_d3 *points;          /* (point_count) one for each exact position */
  uint32_t (*triangles)[3]; /* (triangle_count + cap_count), caps last */
  uint32_t point_count, triangle_count, cap_count;
  sbfi_d3 low, high;      /* bounds of the triangles' points; caps stay within */
  uint32_t flipped_count; /* number of flipped triangles */
} sbfi_soup;

/* Triangulates polygons as fans from their first corners, merges coincident points, drops degenerate
 * triangles. In each piece connected by edges of exactly two triangles, flips the triangles that face against
 * the larger part of its area.
 *
 * Caps holes: for an edge with unbalanced traversals adds triangles that balance it, to the mean of its
 * piece of rim. Surface and caps together are always closed. Allocates from `arena`; false if memory runs
 * out. */
bool sbfi_soup_make(sbfi_soup *soup, const sbf_polygon_mesh *mesh, sbfi_arena *arena);

#endif
