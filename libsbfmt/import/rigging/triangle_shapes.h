/* Triangles of a surface, indexed by shape, independent of size, position and orientation. */
#ifndef SBFI_TRIANGLE_SHAPES_H
#define SBFI_TRIANGLE_SHAPES_H

#include "import/rigging/rigging.h"
#include "mechanics/vector.h"

/* Corners ordered by their opposite sides, longest first. */
typedef struct sbfi_shaped_triangle {
  uint32_t points[3];
  float middle, shortest; /* sides as fractions of the longest */
  float longest;
} sbfi_shaped_triangle;

typedef struct sbfi_triangle_shapes {
  sbfi_shaped_triangle *triangles; /* sorted by cell */
  uint32_t count;
  uint32_t *cell_starts; /* (cells + 1), one cell for each pair of rounded ratios */
} sbfi_triangle_shapes;

/* Uses triangles, all four triangles of quads, and fans of larger polygons. Skips nearly degenerate and
 * isosceles ones. False if memory runs out. */
bool sbfi_triangle_shapes_make(
    sbfi_triangle_shapes *shapes, const sbfi_scene_surface *surface, sbfi_arena *arena);

/* Upper bound of the number of triangles with that shape, within a thousandth. */
uint32_t sbfi_triangle_shapes_count(const sbfi_triangle_shapes *shapes, const sbfi_shaped_triangle *like);
/* Calls `visit` for each until it returns false. */
void sbfi_triangle_shapes_find(const sbfi_triangle_shapes *shapes, const sbfi_shaped_triangle *like,
    bool (*visit)(void *user, const sbfi_shaped_triangle *triangle), void *user);

#endif
