/* Whether a scene keeps every promise of import/scene/scene.h. */
#ifndef TEST_SCENE_CHECK_H
#define TEST_SCENE_CHECK_H

#include "import/scene/scene.h"

/* What is broken first, in words; NULL where all is well. */
const char *scene_check(const sbfi_scene *scene);

typedef struct scene_counts {
  uint32_t meshes, points, polygons, triangles, quads, ngons, skinned, bones, ends, unused;
} scene_counts;
scene_counts scene_count(const sbfi_scene *scene);

/* The mesh, or the node, of a name; NULL where there is none. */
const sbfi_scene_mesh *scene_mesh_of_node(const sbfi_scene *scene, const char *node_name);
int32_t scene_find_node(const sbfi_scene *scene, const char *name, bool bone);

#endif
