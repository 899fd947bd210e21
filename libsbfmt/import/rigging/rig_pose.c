#include "import/rigging/rig_pose.h"

#include "import/rigging/similarity.h"

/* Motion of each node from the bind pose to another pose, in asset space. */
static void find_motions(const sbfi_rigging *r, const sbfi_matrix *worlds, sbfi_matrix *motions) {
  const sbfi_scene *rig = r->rig.scene;
  sbfi_matrix from_asset, from_bind;
  if (!sbfi_matrix_invert(&r->c->rig_to_asset, &from_asset)) from_asset = sbfi_matrix_identity();
  for (uint32_t n = 0; n < rig->node_count; n++) {
    motions[n] = sbfi_matrix_identity();
    if (!sbfi_matrix_invert(&rig->nodes[n].world, &from_bind)) continue;
    motions[n] = sbfi_matrix_multiply(&worlds[n], &from_bind);
    motions[n] = sbfi_matrix_multiply(&r->c->rig_to_asset, &motions[n]);
    motions[n] = sbfi_matrix_multiply(&motions[n], &from_asset);
  }
}

static sbfi_matrix *reserve_motions(const sbfi_rigging *r) {
  return sbfi_arena_allocate(&r->c->scratch, (size_t)r->rig.scene->node_count + 1, sizeof(sbfi_matrix));
}

static void add_scaled(sbfi_matrix *to, const sbfi_matrix *m, double weight) {
  for (int row = 0; row < 3; row++)
    for (int k = 0; k < 4; k++) to->at[row][k] += weight * m->at[row][k];
}

/* --- The rig's meshes ---------------------------------------------------------------------------------- */

static sbfi_matrix motion_of_skin(const sbfi_matrix *motions, const sbfi_scene_mesh *mesh, uint32_t point) {
  sbfi_matrix sum = {.at[3][3] = 1};
  double total = 0;
  for (uint32_t s = mesh->skin.starts[point]; s < mesh->skin.starts[point + 1]; s++)
    total += (double)mesh->skin.weights[s];
  if (!(total > 0)) return sbfi_matrix_identity();
  for (uint32_t s = mesh->skin.starts[point]; s < mesh->skin.starts[point + 1]; s++)
    add_scaled(&sum, &motions[mesh->skin.joints[mesh->skin.joint_index[s]].node],
        (double)mesh->skin.weights[s] / total);
  return sum;
}

void sbfi_pose_positions(
    const sbfi_rigging *r, const sbfi_matrix *worlds, sbfi_matrix *motions, sbf_vec3 *positions) {
  const sbfi_scene *rig = r->rig.scene;
  const sbf_vec3 *bound = r->rig.mesh.positions.at;
  find_motions(r, worlds, motions);
  for (uint32_t m = 0; m < rig->mesh_count; m++) {
    const sbfi_scene_mesh *mesh = &rig->meshes[m];
    for (uint32_t i = 0; i < mesh->point_count; i++) {
      uint32_t point = r->rig.mesh_starts[m] + i;
      sbfi_matrix motion = mesh->skin.joint_count ? motion_of_skin(motions, mesh, i) : motions[mesh->node];
      positions[point] = sbfi_transform_point(&motion, bound[point]);
    }
  }
}

bool sbfi_pose_surface(const sbfi_rigging *r, const sbfi_matrix *worlds, sbfi_scene_surface *posed) {
  sbfi_matrix *motions = reserve_motions(r);
  sbf_vec3 *positions =
      sbfi_arena_allocate(&r->c->scratch, (size_t)r->rig.mesh.positions.count + 1, sizeof *positions);
  if (!motions || !positions) return false;
  sbfi_pose_positions(r, worlds, motions, positions);
  return sbfi_surface_with_positions(posed, &r->rig, positions, &r->c->scratch);
}

/* --- The input ----------------------------------------------------------------------------------------- */

/* Motion of a point of the input. */
static sbfi_matrix motion_of_point(
    const sbfi_rigging *r, const sbfi_matrix *motions, uint32_t mesh, uint32_t i) {
  const sbfi_influences *of = &r->weights[r->input.mesh_starts[mesh] + i];
  sbfi_matrix sum = {.at[3][3] = 1};
  if (r->parent_nodes[mesh] != SBF_NONE) return motions[r->parent_nodes[mesh]];
  if (!(of->at[0].weight > 0)) return sbfi_matrix_identity();
  for (uint32_t k = 0; k < SBFI_MAX_INFLUENCES && of->at[k].weight > 0; k++)
    add_scaled(&sum, &motions[of->at[k].node], (double)of->at[k].weight);
  return sum;
}

/* Normals are mapped back by the transpose of the motion, in the mesh's own space. */
static sbf_vec3 normal_back(const sbfi_matrix *motion, sbf_vec3 n) {
  const double v[3] = {(double)n.x, (double)n.y, (double)n.z};
  double out[3] = {0, 0, 0};
  for (int k = 0; k < 3; k++)
    for (int row = 0; row < 3; row++) out[k] += motion->at[row][k] * v[row];
  return sbfi_d3_rounded(sbfi_d3_normal((sbfi_d3){out[0], out[1], out[2]}));
}

/* Creates one normal per corner, because corners that shared a normal may have rotated differently. */
static bool undo_normals(const sbfi_matrix *motions, sbfi_scene_mesh *to, sbfi_arena *arena) {
  sbf_vec3 *normals = sbfi_arena_allocate(arena, (size_t)to->corner_count + 1, sizeof *normals);
  int32_t *corners = sbfi_arena_allocate(arena, (size_t)to->corner_count + 1, sizeof *corners);
  uint32_t count = 0;
  if (!normals || !corners) return false;
  for (uint32_t i = 0; i < to->corner_count; i++) {
    corners[i] = SBF_NONE;
    if (to->normals.corner_index[i] == SBF_NONE) continue;
    normals[count] = normal_back(&motions[to->corner_points[i]], to->normals.at[to->normals.corner_index[i]]);
    corners[i] = (int32_t)count++;
  }
  to->normals.at = normals;
  to->normals.count = count;
  to->normals.corner_index = corners;
  return true;
}

static bool undo_shapes(const sbfi_matrix *back, sbfi_scene_mesh *to, sbfi_arena *arena) {
  sbfi_scene_shape *shapes = sbfi_arena_copy(arena, to->shapes, to->shape_count, sizeof *shapes);
  for (uint32_t s = 0; shapes && s < to->shape_count; s++) {
    sbf_vec3 *delta = sbfi_arena_allocate(arena, (size_t)to->point_count + 1, sizeof *delta);
    if (!delta) return false;
    for (uint32_t i = 0; i < to->point_count; i++) {
      sbfi_matrix turn = back[i];
      for (int row = 0; row < 3; row++) turn.at[row][3] = 0;
      delta[i] = sbfi_transform_point(&turn, to->shapes[s].delta[i]);
    }
    shapes[s].delta = delta;
  }
  to->shapes = shapes;
  return shapes != NULL;
}

bool sbfi_pose_undo(const sbfi_rigging *r, uint32_t mesh, const sbfi_matrix *to_asset, sbfi_scene_mesh *to) {
  sbfi_arena *arena = &r->c->scratch;
  sbfi_matrix from_asset;
  sbfi_matrix *motions = reserve_motions(r);
  sbfi_matrix *own = sbfi_arena_allocate(arena, (size_t)to->point_count + 1, sizeof *own);
  sbfi_matrix *back = sbfi_arena_allocate(arena, (size_t)to->point_count + 1, sizeof *back);
  sbf_vec3 *points = sbfi_arena_allocate(arena, (size_t)to->point_count + 1, sizeof *points);
  if (!motions || !own || !back || !points) return false;
  find_motions(r, r->alignment.pose_worlds, motions);
  if (!sbfi_matrix_invert(to_asset, &from_asset)) return true; /* singular: nothing to undo */
  for (uint32_t i = 0; i < to->point_count; i++) {
    own[i] = motion_of_point(r, motions, mesh, i);
    own[i] = sbfi_matrix_multiply(&own[i], to_asset);
    own[i] = sbfi_matrix_multiply(&from_asset, &own[i]);
    if (!sbfi_matrix_invert(&own[i], &back[i])) own[i] = back[i] = sbfi_matrix_identity();
    points[i] = sbfi_transform_point(&back[i], to->points[i]);
  }
  to->points = points;
  if (to->normals.corner_index && !undo_normals(own, to, arena)) return false;
  return to->shape_count == 0 || undo_shapes(back, to, arena);
}
