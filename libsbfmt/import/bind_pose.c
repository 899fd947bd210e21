#include "import/bind_pose.h"

#include <math.h>

/* While worlds are worked out their last corner, which is 1 in the end, says where they come from. */
enum { UNSET = 0, FROM_SKIN = 1, FROM_BELOW = 2 };

static void set_joints(const sbfi_scene *scene, sbfi_matrix *worlds) {
  /* Later skins first, so that the first one stays. */
  for (uint32_t m = scene->mesh_count; m-- > 0;) {
    const sbfi_scene_mesh *mesh = &scene->meshes[m];
    for (uint32_t j = 0; j < mesh->joint_count; j++) {
      sbfi_matrix to_mesh;
      if (!sbfi_matrix_invert(&mesh->joints[j].bind, &to_mesh)) continue;
      worlds[mesh->joints[j].node] = sbfi_matrix_multiply(&scene->nodes[mesh->node].world, &to_mesh);
    }
  }
}

/* A bone that no skin has, with a joint somewhere below: from its first child, as if that had not moved in it
 * since. Children stand behind their parents, so each is done when its parent's turn comes. */
static void set_bones_above(const sbfi_scene *scene, sbfi_matrix *worlds) {
  for (uint32_t i = scene->node_count; i-- > 0;) {
    int32_t parent = scene->nodes[i].parent;
    sbfi_matrix to_parent;
    if (worlds[i].at[3][3] == UNSET || parent == SBF_NONE || !scene->nodes[parent].is_bone) continue;
    if (worlds[parent].at[3][3] == FROM_SKIN) continue;
    if (!sbfi_matrix_invert(&scene->nodes[i].local, &to_parent)) continue;
    worlds[parent] = sbfi_matrix_multiply(&worlds[i], &to_parent);
    worlds[parent].at[3][3] = FROM_BELOW;
  }
}

double sbfi_bind_worlds(const sbfi_scene *scene, sbfi_matrix *worlds) {
  for (uint32_t i = 0; i < scene->node_count; i++) worlds[i].at[3][3] = UNSET;
  set_joints(scene, worlds);
  set_bones_above(scene, worlds);
  double farthest = 0;
  for (uint32_t i = 0; i < scene->node_count; i++) {
    const sbfi_scene_node *node = &scene->nodes[i];
    if (worlds[i].at[3][3] == UNSET)
      worlds[i] =
          node->parent == SBF_NONE ? node->local : sbfi_matrix_multiply(&worlds[node->parent], &node->local);
    worlds[i].at[3][3] = 1;
    double distance = 0;
    for (int k = 0; k < 3; k++) {
      double d = worlds[i].at[k][3] - node->world.at[k][3];
      distance += d * d;
    }
    if (distance > farthest) farthest = distance;
  }
  return sqrt(farthest);
}

sbfi_matrix sbfi_bind_placement(
    const sbfi_scene *scene, const sbfi_scene_mesh *mesh, const sbfi_matrix *bind_worlds) {
  return mesh->joint_count ? scene->nodes[mesh->node].world : bind_worlds[mesh->node];
}
