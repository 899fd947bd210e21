#include "import/rigging/rigged_scene.h"

#include <string.h>

#include "import/rigging/join_pieces.h"
#include "import/rigging/rig_pose.h"

static void *allocate(const sbfi_rigging *r, size_t count, size_t size) {
  return sbfi_arena_allocate(&r->c->scratch, count + 1, size);
}

/* Transform of an input mesh into the space of the rig's nodes. */
static bool position_of(const sbfi_rigging *r, const sbfi_scene_mesh *mesh, sbfi_matrix *world) {
  sbfi_matrix from_asset, transform = sbfi_scene_mesh_world(r->input.scene, mesh);
  if (!sbfi_matrix_invert(&r->c->rig_to_asset, &from_asset)) return false;
  *world = sbfi_matrix_multiply(&r->alignment.to_asset, &transform);
  *world = sbfi_matrix_multiply(&from_asset, world);
  return true;
}

static void add_node(const sbfi_rigging *r, uint32_t mesh, sbfi_scene_node *nodes, uint32_t at) {
  sbfi_scene_node *node = &nodes[at];
  sbfi_matrix to_parent;
  *node = (sbfi_scene_node){.name = r->names[mesh], .parent = r->parent_nodes[mesh], .number = SBF_NONE};
  if (!position_of(r, &r->input.scene->meshes[mesh], &node->world)) node->world = sbfi_matrix_identity();
  node->local = node->world;
  if (node->parent == SBF_NONE) return;
  if (sbfi_matrix_invert(&nodes[node->parent].world, &to_parent))
    node->local = sbfi_matrix_multiply(&to_parent, &node->world);
  else
    node->parent = SBF_NONE;
}

/* --- Skins --------------------------------------------------------------------------------------------- */

static bool add_skin(
    const sbfi_rigging *r, uint32_t mesh, const sbfi_scene_node *nodes, sbfi_scene_mesh *to) {
  const sbfi_influences *weights = r->weights + r->input.mesh_starts[mesh];
  uint32_t node_count = r->rig.scene->node_count, total = 0;
  uint32_t *joint_of_node = allocate(r, node_count, sizeof *joint_of_node); /* index + 1 */
  sbfi_scene_joint *joints = allocate(r, node_count, sizeof *joints);
  uint32_t *starts = allocate(r, (size_t)to->point_count + 1, sizeof *starts);
  uint32_t *skin_joints = allocate(r, (size_t)to->point_count * SBFI_MAX_INFLUENCES, sizeof *skin_joints);
  float *skin_weights = allocate(r, (size_t)to->point_count * SBFI_MAX_INFLUENCES, sizeof *skin_weights);
  if (!joint_of_node || !joints || !starts || !skin_joints || !skin_weights) return false;
  for (uint32_t i = 0; i < to->point_count; i++)
    for (uint32_t k = 0; k < SBFI_MAX_INFLUENCES && weights[i].at[k].weight > 0; k++)
      joint_of_node[weights[i].at[k].node] = 1;
  to->skin.joint_count = 0;
  for (uint32_t n = 0; n < node_count;
       n++) { /* ascending, so that joints of a point keep the order of its nodes */
    sbfi_matrix to_node;
    if (!joint_of_node[n] || !sbfi_matrix_invert(&nodes[n].world, &to_node)) continue;
    joints[to->skin.joint_count] =
        (sbfi_scene_joint){(int32_t)n, sbfi_matrix_multiply(&to_node, &nodes[to->node].world)};
    joint_of_node[n] = ++to->skin.joint_count;
  }
  for (uint32_t i = 0; i < to->point_count; i++) {
    for (uint32_t k = 0; k < SBFI_MAX_INFLUENCES && weights[i].at[k].weight > 0; k++) {
      uint32_t joint = joint_of_node[weights[i].at[k].node];
      if (joint == 0) continue;
      skin_joints[total] = joint - 1;
      skin_weights[total++] = weights[i].at[k].weight;
    }
    starts[i + 1] = total;
  }
  to->skin.joints = joints;
  to->skin.starts = starts;
  to->skin.joint_index = skin_joints;
  to->skin.weights = skin_weights;
  return true;
}

/* --- Polygons that face the wrong way ------------------------------------------------------------------ */

/* Reverses the corners of each polygon but keeps the first. */
static void reverse_corners(const sbfi_scene_mesh *mesh, const void *from, void *to) {
  const uint32_t *in = from;
  uint32_t *out = to;
  for (uint32_t p = 0; p < mesh->polygon_count; p++) {
    uint32_t start = mesh->polygon_starts[p], size = mesh->polygon_starts[p + 1] - start;
    for (uint32_t k = 0; k < size; k++) out[start + k] = in[start + (size - k) % size];
  }
}

static bool reverse_polygons(const sbfi_rigging *r, sbfi_scene_mesh *mesh) {
  uint32_t *points = allocate(r, mesh->corner_count, sizeof *points);
  int32_t *normals = allocate(r, mesh->corner_count, sizeof *normals);
  uint32_t *vertices = allocate(r, mesh->corner_count, sizeof *vertices);
  sbfi_scene_uvs *sets = allocate(r, mesh->uv_set_count, sizeof *sets);
  if (!points || !normals || !vertices || !sets) return false;
  reverse_corners(mesh, mesh->corner_points, points);
  mesh->corner_points = points;
  if (mesh->normals.corner_index) reverse_corners(mesh, mesh->normals.corner_index, normals);
  if (mesh->normals.corner_index) mesh->normals.corner_index = normals;
  if (mesh->corner_vertices) reverse_corners(mesh, mesh->corner_vertices, vertices);
  if (mesh->corner_vertices) mesh->corner_vertices = vertices;
  for (uint32_t s = 0; s < mesh->uv_set_count; s++) {
    int32_t *corners = allocate(r, mesh->corner_count, sizeof *corners);
    if (!corners) return false;
    reverse_corners(mesh, mesh->uv_sets[s].corner, corners);
    sets[s] = mesh->uv_sets[s];
    sets[s].corner = corners;
  }
  mesh->uv_sets = sets;
  return true;
}

static bool has_weights(const sbfi_rigging *r, uint32_t mesh) {
  for (uint32_t i = r->input.mesh_starts[mesh]; i < r->input.mesh_starts[mesh + 1]; i++)
    if (r->weights[i].at[0].weight > 0) return true;
  return false;
}

bool sbfi_rigged_scene_build(const sbfi_rigging *r) {
  sbfi_conversion *c = r->c;
  const sbfi_scene *input = r->input.scene, *rig = r->rig.scene;
  uint32_t mesh_count = input->mesh_count, node_count = rig->node_count;
  sbfi_scene *scene = allocate(r, 1, sizeof *scene);
  sbfi_scene_node *nodes = allocate(r, (size_t)node_count + mesh_count, sizeof *nodes);
  sbfi_scene_mesh *meshes = sbfi_arena_copy(&c->scratch, input->meshes, mesh_count, sizeof *meshes);
  int32_t *bone_of_node = allocate(r, (size_t)node_count + mesh_count, sizeof *bone_of_node);
  if (!scene || !nodes || !meshes || !bone_of_node) return false;
  memcpy(nodes, rig->nodes, node_count * sizeof *nodes);
  memcpy(bone_of_node, c->bone_of_node, node_count * sizeof *bone_of_node);
  for (uint32_t m = 0; m < mesh_count; m++) {
    uint32_t at = node_count + m;
    add_node(r, m, nodes, at);
    bone_of_node[at] = nodes[at].parent == SBF_NONE ? SBF_NONE : bone_of_node[nodes[at].parent];
    meshes[m].node = (int32_t)at;
    meshes[m].skin.joint_count = 0;
    if (r->parent_nodes[m] == SBF_NONE && has_weights(r, m) && !add_skin(r, m, nodes, &meshes[m]))
      return false;
    if (r->is_reversed[m] && !reverse_polygons(r, &meshes[m])) return false;
    sbfi_matrix to_asset = sbfi_matrix_multiply(&c->rig_to_asset, &nodes[at].world);
    if (r->alignment.pose_worlds && !sbfi_pose_undo(r, m, &to_asset, &meshes[m])) return false;
  }
  uint32_t joined_count = mesh_count;
  if (!sbfi_join_pieces(r, nodes, meshes, &joined_count)) return false;
  *scene = *input;
  scene->unit_m = rig->unit_m;
  scene->unit_known = rig->unit_known;
  scene->axes = rig->axes;
  scene->axes_known = rig->axes_known;
  scene->nodes = nodes;
  scene->saved_worlds = NULL;
  scene->node_count = node_count + mesh_count;
  scene->meshes = meshes;
  scene->mesh_count = joined_count;
  scene->clips = rig->clips;
  scene->clip_count = rig->clip_count;
  c->scene = c->rig = scene;
  c->to_asset = c->rig_to_asset;
  c->bone_of_node = bone_of_node;
  return true;
}
