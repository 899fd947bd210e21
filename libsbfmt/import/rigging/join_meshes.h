/* Makes one mesh of several pieces of it. */
#ifndef SBFI_JOIN_MESHES_H
#define SBFI_JOIN_MESHES_H

#include "import/scene/scene.h"

/* Joins the meshes whose entry of `sets` is `root`, the lowest of them, in file order: `*to` is a copy of
 * that one with the points, polygons, normals, colours and texture coordinates of all. Points of several
 * pieces at one position are merged. Not for meshes with skins or vertices of their own. Allocates from
 * `arena`; false if memory runs out. */
bool sbfi_join_meshes(sbfi_arena *arena, const uint32_t *sets, uint32_t root, const sbfi_scene_mesh *meshes,
    uint32_t mesh_count, sbfi_scene_mesh *to);

#endif
