/* Bones from the rig's node tree. Rest transforms are baked into asset space. */
#include <math.h>
#include <string.h>

#include "import/convert/skeleton_draft.h"
#include "import/scene/trs.h"

static sbfi_d3 column(const sbfi_matrix *m, int k) {
  return (sbfi_d3){m->at[0][k], m->at[1][k], m->at[2][k]};
}

static sbfi_d3 normal_or(sbfi_d3 a, sbfi_d3 otherwise) {
  double length = sbfi_d3_length(a);
  return length > 1e-12 ? sbfi_d3_scale(a, 1 / length) : otherwise;
}

static sbfi_d3 across(sbfi_d3 a, sbfi_d3 axis) {
  return sbfi_d3_sub(a, sbfi_d3_scale(axis, sbfi_d3_dot(a, axis)));
}

/* Rotation of a right-handed orthonormal frame whose Y is the given axis and whose X is closest to `x`. */
static sbf_quat rotation_from_axes(sbfi_d3 x, sbfi_d3 y) {
  sbfi_d3 axis_y = normal_or(y, (sbfi_d3){0, 1, 0});
  sbfi_d3 spare = fabs(axis_y.x) < 0.9 ? (sbfi_d3){1, 0, 0} : (sbfi_d3){0, 0, 1};
  sbfi_d3 axis_x = normal_or(across(x, axis_y), sbfi_d3_normal(across(spare, axis_y)));
  sbfi_d3 axis_z = sbfi_d3_cross(axis_x, axis_y);
  sbfi_matrix frame = {{{axis_x.x, axis_y.x, axis_z.x, 0}, {axis_x.y, axis_y.y, axis_z.y, 0},
      {axis_x.z, axis_y.z, axis_z.z, 0}, {0, 0, 0, 1}}};
  sbfi_trs trs = sbfi_trs_decompose(&frame);
  const double *q = trs.rotation, sign = q[3] < 0 ? -1 : 1;
  return (sbf_quat){(float)(q[0] * sign + 0.0), (float)(q[1] * sign + 0.0), (float)(q[2] * sign + 0.0),
      (float)(q[3] * sign + 0.0)}; /* no negative zero */
}

/* Direction of the bone as drawn; it becomes the bone's +Y. */
static sbfi_d3 direction_of(const sbfi_skeleton_draft *s, const sbfi_bone_draft *bone) {
  if (s->along_y) return bone->y;
  if (bone->next != SBF_NONE) return bone->along;
  if (sbfi_d3_length(bone->tip) > 1e-9) return bone->tip;
  bool below = bone->parent != SBF_NONE && s->bones[bone->parent].next != SBF_NONE;
  return below ? s->bones[bone->parent].along : bone->y;
}

/* Indices of the bones ordered so that parents come first, otherwise in file order. */
static bool order_bones(sbfi_conversion *c, const sbfi_skeleton_draft *s, uint32_t *old_from_new) {
  bool *placed = sbfi_arena_allocate(&c->scratch, s->count, sizeof *placed);
  uint32_t *path = sbfi_arena_allocate(&c->scratch, s->count, sizeof *path), count = 0;
  if (!placed || !path) return false;
  for (uint32_t i = 0; i < s->count; i++) {
    uint32_t depth = 0;
    for (int32_t bone = (int32_t)i; bone != SBF_NONE && !placed[bone]; bone = s->bones[bone].parent)
      path[depth++] = (uint32_t)bone;
    while (depth) {
      placed[path[--depth]] = true;
      old_from_new[count++] = path[depth];
    }
  }
  return true;
}

static bool write_bone(sbfi_conversion *c, const sbfi_skeleton_draft *s, const sbfi_bone_draft *from,
    const int32_t *new_from_old, sbf_bone *bone) {
  sbf_bone_init(bone);
  sbfi_bone_draft rotated = *from;
  rotated.y = direction_of(s, from);
  bone->id = sbfi_new_id(c, "bone", c->rig->nodes[from->node].name);
  bone->name = sbf_asset_copy_text(c->asset, c->rig->nodes[from->node].name);
  bone->parent = from->parent == SBF_NONE ? SBF_NONE : new_from_old[from->parent];
  bone->head = sbfi_d3_rounded(from->head);
  bone->rotation = rotation_from_axes(from->x, rotated.y);
  if (from->next == SBF_NONE) rotated.along = from->tip;
  bool has_end = sbfi_d3_length(rotated.along) > 1e-9;
  bone->length = has_end && sbfi_bone_runs_straight(&rotated) ? (float)sbfi_d3_length(rotated.along) : 0;
  return bone->id && bone->name;
}

static sbf_status write_bones(sbfi_conversion *c, const sbfi_skeleton_draft *s) {
  sbf_bone *bones = sbfi_convert_allocate(c, s->count, sizeof *bones);
  uint32_t *old_from_new = sbfi_arena_allocate(&c->scratch, s->count, sizeof *old_from_new);
  int32_t *new_from_old = sbfi_arena_allocate(&c->scratch, s->count, sizeof *new_from_old);
  c->node_of_bone = sbfi_arena_allocate(&c->scratch, s->count, sizeof *c->node_of_bone);
  if (!bones || !old_from_new || !new_from_old || !c->node_of_bone || !order_bones(c, s, old_from_new))
    return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < s->count; i++) new_from_old[old_from_new[i]] = (int32_t)i;
  for (uint32_t i = 0; i < s->count; i++) {
    const sbfi_bone_draft *from = &s->bones[old_from_new[i]];
    c->node_of_bone[i] = from->node;
    if (!write_bone(c, s, from, new_from_old, &bones[i])) return sbfi_convert_no_memory(c);
  }
  for (uint32_t i = 0; i < c->rig->node_count; i++)
    if (c->bone_of_node[i] != SBF_NONE) c->bone_of_node[i] = new_from_old[c->bone_of_node[i]];
  c->asset->bones = (sbf_bone_list){bones, s->count};
  return SBF_OK;
}

sbf_status sbfi_convert_skeleton(sbfi_conversion *c) {
  if (!c->rig || sbfi_scene_bone_count(c->rig) == 0) return SBF_OK;
  uint32_t node_count = c->rig->node_count;
  sbfi_skeleton_draft s = {sbfi_arena_allocate(&c->scratch, node_count, sizeof *s.bones), 0, false};
  c->bone_of_node = sbfi_arena_allocate(&c->scratch, node_count, sizeof *c->bone_of_node);
  if (!c->bone_of_node || !s.bones) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < node_count; i++) {
    const sbfi_scene_node *node = &c->rig->nodes[i];
    int32_t above = node->parent != SBF_NONE ? c->bone_of_node[node->parent] : SBF_NONE;
    c->bone_of_node[i] = above; /* other nodes follow the nearest bone above */
    sbfi_matrix world = sbfi_matrix_multiply(&c->rig_to_asset, &node->world);
    bool marks_tip = node->is_end && above != SBF_NONE && s.bones[above].node == (uint32_t)node->parent;
    if (!node->is_bone && marks_tip) s.bones[above].tip = sbfi_d3_sub(column(&world, 3), s.bones[above].head);
    if (!node->is_bone) continue;
    s.bones[s.count] = (sbfi_bone_draft){.node = i,
        .parent = above,
        .head = column(&world, 3),
        .x = column(&world, 0),
        .y = column(&world, 1),
        .neighbor = SBF_NONE};
    c->bone_of_node[i] = (int32_t)s.count++;
  }
  sbfi_draft_continue(&s);
  sbf_status status = sbfi_reparent_detached_bones(c, &s);
  return status == SBF_OK ? write_bones(c, &s) : status;
}

/* --- Ends of bones ----------------------------------------------------------------------------------- */

static void reach_to(sbf_bone *bone, sbf_vec3 point, float *length) {
  const sbf_quat q = bone->rotation;
  const sbf_vec3 axis = {
      2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)};
  float along = (point.x - bone->head.x) * axis.x + (point.y - bone->head.y) * axis.y +
                (point.z - bone->head.z) * axis.z;
  if (along > *length) *length = along;
}

static void reach_skin(const sbf_render_mesh *mesh, sbf_bone *bones, float *lengths) {
  const sbf_skin *skin = mesh->skin;
  for (uint32_t i = 0, at = 0; skin && i < mesh->mesh.positions.count; at += skin->influence_counts.at[i++])
    for (uint32_t k = at; k < at + skin->influence_counts.at[i]; k++) {
      uint32_t bone = skin->bones.at[k];
      if (skin->weights.at[k] > 0.5f) reach_to(&bones[bone], mesh->mesh.positions.at[i], &lengths[bone]);
    }
}

sbf_status sbfi_measure_leaf_bones(sbfi_conversion *c) {
  uint32_t count = c->asset->bones.count;
  if (count == 0) return SBF_OK;
  sbf_bone *bones = (sbf_bone *)(uintptr_t)c->asset->bones.at; /* the conversion owns the asset */
  float *lengths = sbfi_arena_allocate(&c->scratch, count, sizeof *lengths);
  if (!lengths) return sbfi_convert_no_memory(c);
  for (uint32_t b = 0; b < c->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &c->asset->soft_bodies.at[b];
    for (uint32_t i = 0; body->bone >= 0 && i < body->surface.positions.count; i++)
      reach_to(&bones[body->bone], body->surface.positions.at[i], &lengths[body->bone]);
  }
  for (uint32_t m = 0; m < c->asset->render_meshes.count; m++)
    reach_skin(&c->asset->render_meshes.at[m], bones, lengths);
  for (uint32_t i = 0; i < count; i++)
    if (bones[i].length <= 0) bones[i].length = lengths[i];
  return SBF_OK;
}
