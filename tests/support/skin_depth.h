/* How deep a place is within a closed surface, worked out in another way than the runtime does. */
#ifndef TEST_SKIN_DEPTH_H
#define TEST_SKIN_DEPTH_H

#include "sbfmt/model.h"

/* m to the nearest triangle, 0 outside; `at` are the places of the mesh's vertices. Triangles at the vertex
 * `own` are left out, and x must be inside once more than by itself; UINT32_MAX: there is none. */
double skin_depth(const sbf_polygon_mesh *mesh, const sbf_vec3 *at, sbf_vec3 x, uint32_t own);

#endif
