/* Corners of a render mesh that look alike: one vertex for a simplifier, which keeps the lines along which
 * those of a point differ. */
#ifndef SBFI_WEDGES_H
#define SBFI_WEDGES_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* What corners differ by, beside their points, texture coordinates and materials. */
typedef struct sbfi_wedge_rule {
  bool normals; /* hard edges are kept */
  bool bones;   /* lines are kept along which another bone begins to hold most of the skin */
} sbfi_wedge_rule;

typedef struct sbfi_wedges {
  uint32_t *of_corner; /* (corners of the mesh) */
  uint32_t *corners;   /* (count) the first corner of each */
  uint32_t *slots;     /* (count) material slot of its polygons */
  sbf_vec3 *positions; /* (count) */
  uint32_t count;
  uint32_t *triangles; /* (3 * triangle_count) wedges: polygons as fans from their first corners, less what
                          names a point twice */
  uint32_t triangle_count;
} sbfi_wedges;

/* Memory of `arena`; false where it runs out. */
bool sbfi_wedges_make(
    sbfi_wedges *wedges, const sbf_render_mesh *mesh, sbfi_wedge_rule rule, sbfi_arena *arena);

#endif
