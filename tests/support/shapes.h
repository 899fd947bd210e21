/* Meshes that tests are about: cubes and sheets worked out here, and the groups of an OBJ file. */
#ifndef TEST_SHAPES_H
#define TEST_SHAPES_H

#include "sbfmt/asset.h"

/* Surface of an axis-parallel cube around `centre`, each face of n x n quads facing outwards, edges welded:
 * 6 n^2 + 2 points. Lives in the asset; a failed allocation ends the test program. */
sbf_polygon_mesh shape_cube(sbf_asset *asset, uint32_t n, float side, sbf_vec3 centre);

/* Closed bar from x = 0 to `length`, of squares `side` / n wide where `along` = length n / side; its other
 * sides lie around the x axis. */
sbf_polygon_mesh shape_bar(sbf_asset *asset, uint32_t along, uint32_t n, float length, float side);

/* A flat sheet of n x m unit quads in the plane y = 0, facing up: (n + 1)(m + 1) points. */
sbf_polygon_mesh shape_sheet(sbf_asset *asset, uint32_t n, uint32_t m);

/* The same surface with every quad cut in two triangles along its first diagonal. */
sbf_polygon_mesh shape_triangulated(sbf_asset *asset, const sbf_polygon_mesh *mesh);

/* A soft body for each `g` or `o` of an OBJ file, with a bone of its own whose head stands at the first
 * vertex; nothing but v, f and the group names is read. */
void shape_sections_of_obj(sbf_asset *asset, const char *path);

/* All vertices and faces of an OBJ file of any size as one surface. */
sbf_polygon_mesh shape_of_obj(sbf_asset *asset, const char *path);

/* Adds a soft body (and its bone, where `with_bone`) to an asset made by sbf_asset_create. */
sbf_soft_body *shape_add_body(
    sbf_asset *asset, const char *name, const sbf_polygon_mesh *surface, bool with_bone);

#endif
