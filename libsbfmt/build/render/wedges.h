/* Groups equal corners of a render mesh to wedges: one vertex each for a simplifier, which preserves the
 * lines along which the wedges of a point differ. */
#ifndef SBFI_WEDGES_H
#define SBFI_WEDGES_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* Attributes that separate corners, in addition to points, texture coordinates and materials. */
typedef struct sbfi_wedge_rule {
  bool normals; /* preserves hard edges */
  bool bones;   /* preserves boundaries between bones of greatest weight */
} sbfi_wedge_rule;

typedef struct sbfi_wedges {
  uint32_t *of_corner; /* (corners of the mesh) */
  uint32_t *corners;   /* (count) the first corner of each */
  uint32_t *slots;     /* (count) material slot of its polygons */
  sbf_vec3 *positions; /* (count) */
  uint32_t count;
  uint32_t *triangles; /* (3 * triangle_count) wedges: polygons as fans from their first corners, without
                          degenerate triangles */
  uint32_t triangle_count;
} sbfi_wedges;

/* Allocates from `arena`; false if memory runs out. */
bool sbfi_wedges_make(
    sbfi_wedges *wedges, const sbf_render_mesh *mesh, sbfi_wedge_rule rule, sbfi_arena *arena);

#endif
