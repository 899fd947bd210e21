/* The triangles of a surface, made ready for questions of inside and outside. */
#ifndef SBFI_SOUP_H
#define SBFI_SOUP_H

#include "base/memory.h"
#include "mechanics/vector.h"
#include "sbfmt/model.h"

typedef struct sbfi_soup {
  sbfi_d3 *points;          /* (point_count) one for each place, bit by bit */
  uint32_t (*triangles)[3]; /* (triangle_count + cap_count), the caps last */
  uint32_t point_count, triangle_count, cap_count;
  sbfi_d3 low, high;     /* of the triangles' points; the caps stay within */
  uint32_t turned_count; /* triangles that faced against their neighbours */
} sbfi_soup;

/* Fans the polygons into triangles from their first corners, joins points in one place, leaves out triangles
 * with less than three places. In each piece whose triangles hang together by sides that two of them share,
 * those that face against the greater part of its area are turned.
 *
 * Holes get caps: where a side is passed more often one way than the other, triangles that make up for it,
 * to the mean of the piece of rim that it belongs to. Surface and caps together are closed, whatever else
 * they are. Memory of `arena`; false where it runs out. */
bool sbfi_soup_make(sbfi_soup *soup, const sbf_polygon_mesh *mesh, sbfi_arena *arena);

#endif
