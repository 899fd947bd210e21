/* Springs of VRM as chains that swing. */
#include <math.h>
#include <string.h>

#include "import/convert/conversion.h"
#include "import/vrm/vrm.h"
#include "interchange/vrm_units.h"

typedef struct spring_work {
  sbfi_conversion *c;
  const sbfi_vrm *vrm;
  int32_t *new_colliders; /* (vrm->collider_count) index in the asset, or SBF_NONE */
  double unit_m;          /* metres per unit of the file */
} spring_work;

/* Bone of exactly this node, or SBF_NONE. */
static int32_t bone_of(const sbfi_conversion *c, int32_t node) {
  int32_t bone = node == SBF_NONE ? SBF_NONE : c->bone_of_node[node];
  return bone != SBF_NONE && c->node_of_bone[bone] == (uint32_t)node ? bone : SBF_NONE;
}

static bool is_below(const sbf_asset *a, uint32_t bone, uint32_t ancestor) {
  int32_t at = (int32_t)bone;
  while (at > (int32_t)ancestor) at = a->bones.at[at].parent;
  return at == (int32_t)ancestor && bone != ancestor;
}

static sbf_vec3 normal_to_asset(const sbfi_matrix *m, sbf_vec3 normal) {
  sbfi_matrix inverse;
  double n[3] = {(double)normal.x, (double)normal.y, (double)normal.z}, out[3] = {0, 0, 0}, length = 0;
  if (!sbfi_matrix_invert(m, &inverse)) return normal;
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 3; k++) out[r] += inverse.at[k][r] * n[k];
  for (int k = 0; k < 3; k++) length += out[k] * out[k];
  length = sqrt(length);
  return (sbf_vec3){(float)(out[0] / length), (float)(out[1] / length), (float)(out[2] / length)};
}

static sbf_status write_colliders(spring_work *w) {
  sbfi_conversion *c = w->c;
  uint32_t count = 0;
  sbf_chain_collider *colliders = sbfi_convert_allocate(c, w->vrm->collider_count, sizeof *colliders);
  if (!colliders && w->vrm->collider_count) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < w->vrm->collider_count; i++) {
    const sbfi_vrm_collider *from = &w->vrm->colliders[i];
    w->new_colliders[i] = SBF_NONE;
    int32_t bone = from->node == SBF_NONE ? SBF_NONE : c->bone_of_node[from->node];
    if (bone == SBF_NONE) continue;
    sbf_chain_collider *to = &colliders[count];
    sbf_chain_collider_init(to);
    const char *name = c->rig->nodes[from->node].name;
    to->id = sbfi_new_id(c, "collider", name);
    to->name = sbf_asset_copy_text(c->asset, name);
    if (!to->id || !to->name) return sbfi_convert_no_memory(c);
    sbfi_matrix world = sbfi_matrix_multiply(&c->rig_to_asset, &c->rig->nodes[from->node].world);
    to->bone = bone;
    to->shape = from->shape;
    to->position = sbfi_transform_point(&world, from->offset);
    if (from->shape == SBF_CHAIN_COLLIDER_SHAPE_CAPSULE) to->end = sbfi_transform_point(&world, from->tail);
    if (from->shape == SBF_CHAIN_COLLIDER_SHAPE_PLANE) to->normal = normal_to_asset(&world, from->normal);
    to->radius = (float)((double)from->radius * w->unit_m);
    to->inside = from->inside;
    w->new_colliders[i] = (int32_t)count++;
  }
  c->asset->chain_colliders = (sbf_chain_collider_list){count ? colliders : NULL, count};
  return SBF_OK;
}

static float distance(sbf_vec3 a, sbf_vec3 b) {
  double x = (double)a.x - (double)b.x, y = (double)a.y - (double)b.y, z = (double)a.z - (double)b.z;
  return (float)sqrt(x * x + y * y + z * z);
}

/* One value for all bones if they are equal. */
static uint32_t shortened(const void *values, uint32_t count, size_t size) {
  const char *at = values;
  for (uint32_t i = 1; i < count; i++)
    if (memcmp(at, at + i * size, size) != 0) return count;
  return count ? 1 : 0;
}

typedef struct spring_lists {
  float *stiffness, *drag, *radius;
  sbf_vec3 *gravity;
} spring_lists;

static void set_joint(const spring_work *w, const sbfi_vrm_joint *joint, uint32_t k, spring_lists *to) {
  double drag = sbfi_vrm_drag((double)joint->drag_force), factor = sbfi_vrm_acceleration(drag);
  double gravity = factor * (double)joint->gravity_power;
  const sbf_vec3 g = joint->gravity_direction;
  to->stiffness[k] = (float)fmin(factor * (double)joint->stiffness, 1e30);
  to->drag[k] = (float)drag;
  to->radius[k] = (float)((double)joint->hit_radius * w->unit_m);
  const double along[3] = {gravity * (double)g.x, gravity * (double)g.y, gravity * (double)g.z};
  float limited[3];
  for (int i = 0; i < 3; i++) limited[i] = (float)fmax(-1e30, fmin(along[i], 1e30)) + 0.0f;
  to->gravity[k] = (sbf_vec3){limited[0], limited[1], limited[2]};
}

/* The last joint of VRM 1.0 has no numbers of its own: it takes those of the one before. */
static bool write_spring(
    spring_work *w, const sbfi_vrm_spring *from, const sbf_chain *chain, sbf_chain_spring *to) {
  sbfi_conversion *c = w->c;
  uint32_t count = chain->bones.count, collider_count = 0;
  spring_lists lists = {sbfi_convert_allocate(c, count, sizeof(float)),
      sbfi_convert_allocate(c, count, sizeof(float)), sbfi_convert_allocate(c, count, sizeof(float)),
      sbfi_convert_allocate(c, count, sizeof(sbf_vec3))};
  uint32_t *colliders = sbfi_convert_allocate(c, from->collider_count, sizeof *colliders);
  if (!lists.stiffness || !lists.drag || !lists.radius || !lists.gravity) return false;
  if (!colliders && from->collider_count) return false;
  for (uint32_t k = 0; k < count; k++)
    set_joint(
        w, &from->joints[!from->has_tail && k > 0 && k + 1 == from->joint_count ? k - 1 : k], k, &lists);
  for (uint32_t i = 0; i < from->collider_count; i++)
    if (w->new_colliders[from->colliders[i]] != SBF_NONE)
      colliders[collider_count++] = (uint32_t)w->new_colliders[from->colliders[i]];
  sbf_chain_spring_init(to);
  to->stiffness = (sbf_f32_list){lists.stiffness, shortened(lists.stiffness, count, sizeof(float))};
  to->drag = (sbf_f32_list){lists.drag, shortened(lists.drag, count, sizeof(float))};
  to->gravity = (sbf_vec3_list){lists.gravity, shortened(lists.gravity, count, sizeof(sbf_vec3))};
  to->radius = (sbf_f32_list){lists.radius, shortened(lists.radius, count, sizeof(float))};
  to->center = bone_of(c, from->center);
  to->colliders = (sbf_u32_list){collider_count ? colliders : NULL, collider_count};
  return true;
}

/* Distance of a last joint that is no bone but the tip of the one before; 0: it is none. */
static float tip_of(const spring_work *w, const sbfi_vrm_spring *from) {
  const sbfi_scene_node *end = &w->c->rig->nodes[from->joints[from->joint_count - 1].node];
  if (from->has_tail || end->is_bone || !end->is_end || end->parent == SBF_NONE) return 0;
  sbfi_matrix world = sbfi_matrix_multiply(&w->c->rig_to_asset, &w->c->rig->nodes[end->parent].world);
  const sbf_vec3 at = {(float)end->local.at[0][3], (float)end->local.at[1][3], (float)end->local.at[2][3]};
  return distance(sbfi_transform_point(&world, (sbf_vec3){0, 0, 0}), sbfi_transform_point(&world, at));
}

/* Bones of a spring's first joints; NULL, with `*why` unless memory ran out, if some are none. */
static uint32_t *bones_of(spring_work *w, const sbfi_vrm_spring *from, uint32_t count, const char **why) {
  sbfi_conversion *c = w->c;
  uint32_t *bones = sbfi_convert_allocate(c, count, sizeof *bones);
  for (uint32_t k = 0; bones && k < count; k++) {
    int32_t bone = bone_of(c, from->joints[k].node);
    if (bone == SBF_NONE) *why = "has a joint that is no bone, but an object with a mesh";
    if (bone != SBF_NONE && k > 0 && !is_below(c->asset, (uint32_t)bone, bones[k - 1]))
      *why = "has bones that are not below each other";
    if (*why) return NULL;
    bones[k] = (uint32_t)bone;
  }
  return bones;
}

static sbf_status write_chain(spring_work *w, const sbfi_vrm_spring *from, sbf_chain *to, bool *written) {
  sbfi_conversion *c = w->c;
  const char *why = NULL, *name = *from->name ? from->name : c->rig->nodes[from->joints[0].node].name;
  float tip = tip_of(w, from);
  uint32_t count = from->joint_count - (tip > 0), *bones = bones_of(w, from, count, &why);
  *written = bones != NULL;
  if (why) {
    sbfi_convert_warn(c, SBF_CODE_IMPORT_SPRING, "the spring \"%.60s\" %s: it is left out", name, why);
    return SBF_OK;
  }
  float *spacing = sbfi_convert_allocate(c, count, sizeof *spacing);
  sbf_chain_spring *spring = sbfi_convert_allocate(c, 1, sizeof *spring);
  sbf_chain_init(to);
  to->id = sbfi_new_id(c, "chain", name);
  to->name = sbf_asset_copy_text(c->asset, name);
  if (!bones || !spacing || !spring || !to->id || !to->name) return sbfi_convert_no_memory(c);
  for (uint32_t k = 0; k + 1 < count; k++)
    spacing[k] = distance(c->asset->bones.at[bones[k]].head, c->asset->bones.at[bones[k + 1]].head);
  spacing[count - 1] = from->has_tail ? (float)((double)SBFI_VRM_TAIL * w->unit_m) : tip;
  to->bones = (sbf_u32_list){bones, count};
  to->spacing = (sbf_f32_list){spacing, count};
  to->spring = spring;
  return write_spring(w, from, to, spring) ? SBF_OK : sbfi_convert_no_memory(c);
}

/* Drops proposed chains, and the tails that they are, whose bones swing already. */
static void drop_proposed(const sbf_asset *a, sbf_chain_list *kept, const uint8_t *swings) {
  bool overlap = false;
  for (uint32_t i = 0; i < kept->count; i++)
    for (uint32_t k = 0; k < kept->at[i].bones.count; k++)
      overlap = overlap || swings[kept->at[i].bones.at[k]];
  if (!overlap) return;
  kept->count = 0; /* there is one at most, a tail or a spine */
  for (uint32_t g = 0; g < a->gaits.count; g++)
    ((sbf_gait *)(uintptr_t)&a->gaits.at[g])->tails = (sbf_tail_list){NULL, 0}; /* the conversion owns it */
}

sbf_status sbfi_convert_springs(sbfi_conversion *c) {
  const sbfi_vrm *vrm = c->rig ? c->rig->vrm : NULL;
  sbf_asset *a = c->asset;
  if (!vrm || !vrm->spring_count || !a->bones.count) return SBF_OK;
  double determinant = sbfi_matrix_determinant(&c->rig_to_asset);
  spring_work w = {.c = c, .vrm = vrm, .unit_m = cbrt(fabs(determinant))};
  sbf_chain_list proposed = a->chains;
  sbf_chain *chains = sbfi_convert_allocate(c, (size_t)proposed.count + vrm->spring_count, sizeof *chains);
  uint8_t *swings = sbfi_arena_allocate(&c->scratch, a->bones.count, 1);
  w.new_colliders = sbfi_arena_allocate(&c->scratch, (size_t)vrm->collider_count + 1, sizeof(int32_t));
  if (!chains || !swings || !w.new_colliders) return sbfi_convert_no_memory(c);
  sbf_status status = write_colliders(&w);
  for (uint32_t i = 0; status == SBF_OK && i < vrm->spring_count; i++)
    for (uint32_t k = 0; k < vrm->springs[i].joint_count; k++) {
      int32_t bone = bone_of(c, vrm->springs[i].joints[k].node);
      if (bone != SBF_NONE) swings[bone] = 1;
    }
  drop_proposed(a, &proposed, swings);
  if (proposed.count) memcpy(chains, proposed.at, proposed.count * sizeof *chains);
  uint32_t count = proposed.count;
  for (uint32_t i = 0; status == SBF_OK && i < vrm->spring_count; i++) {
    bool written;
    status = write_chain(&w, &vrm->springs[i], &chains[count], &written);
    count += written;
  }
  a->chains = (sbf_chain_list){count ? chains : NULL, count};
  return status;
}
