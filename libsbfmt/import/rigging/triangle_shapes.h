/* Triangles of a surface, to be found by their shape whatever their size, place and attitude. */
#ifndef SBFI_TRIANGLE_SHAPES_H
#define SBFI_TRIANGLE_SHAPES_H

#include "import/rigging/rigging.h"
#include "mechanics/vector.h"

/* Corners in the order of the sides opposite them, the longest side first. */
typedef struct sbfi_shaped_triangle {
  uint32_t points[3];
  float middle, shortest; /* sides, as shares of the longest */
  float longest;
} sbfi_shaped_triangle;

typedef struct sbfi_triangle_shapes {
  sbfi_shaped_triangle *triangles; /* by cell, cell by cell */
  uint32_t count;
  uint32_t *cell_starts; /* (cells + 1), a cell for each pair of rounded ratios */
} sbfi_triangle_shapes;

/* Of polygons of three corners the triangle, of four all four that they could be divided into, of more a fan.
 * What is nearly flat or has two sides of one length is left out. False where memory runs out. */
bool sbfi_triangle_shapes_make(
    sbfi_triangle_shapes *shapes, const sbfi_scene_surface *surface, sbfi_arena *arena);

/* How many triangles have that shape, give or take a thousandth: an upper bound. */
uint32_t sbfi_triangle_shapes_count(const sbfi_triangle_shapes *shapes, const sbfi_shaped_triangle *like);
/* Hands them over until `visit` is false. */
void sbfi_triangle_shapes_find(const sbfi_triangle_shapes *shapes, const sbfi_shaped_triangle *like,
    bool (*visit)(void *user, const sbfi_shaped_triangle *triangle), void *user);

#endif
