/* Finds what swings: chains with springs as they are; a gait's tails and followers of rotation by frequency
 * and damping ratio; other chains as ends without inertia that return at the chain's rate. */
#include "export/glb_springs.h"

#include <math.h>

#include "interchange/vrm_units.h"
#include "mechanics/vector.h"
#include "motion/quatd.h"

static const double TURN = 6.283185307179586, STEP_S = 1.0 / 60;
static const double SAME_POINT = 1e-3; /* fraction of a bone's length between its end and a child there */

static float number_of(sbf_f32_list list, uint32_t k) {
  return list.count > 1 ? list.at[k] : list.count ? list.at[0] : 0;
}

/* Vector in a bone's frame. */
static sbf_vec3 in_bone(const sbf_asset *a, uint32_t bone, sbfi_d3 v) {
  const sbf_quat q = a->bones.at[bone].rotation;
  const double back[4] = {-(double)q.x, -(double)q.y, -(double)q.z, (double)q.w}, from[3] = {v.x, v.y, v.z};
  double to[3];
  sbfi_quatd_rotate(back, from, to);
  return (sbf_vec3){(float)to[0], (float)to[1], (float)to[2]};
}

/* From the head of a chain's bone k to its end, in the bone's frame. */
static sbf_vec3 step_of(const sbf_asset *a, const sbf_chain *chain, uint32_t k) {
  const sbf_bone *bone = &a->bones.at[chain->bones.at[k]];
  if (k + 1 == chain->bones.count)
    return (sbf_vec3){0, chain->spring && chain->spacing.count ? chain->spacing.at[k] : bone->length, 0};
  sbfi_d3 next = sbfi_d3_of(a->bones.at[chain->bones.at[k + 1]].head);
  return in_bone(a, chain->bones.at[k], sbfi_d3_sub(next, sbfi_d3_of(bone->head)));
}

static double length_of(sbf_vec3 v) {
  return sbfi_d3_length(sbfi_d3_of(v));
}

/* As a second-order system of that frequency in Hz. With e = 1 - dragForce and c = stiffness h / length, a
 * small angle goes from step to step as a <- (a + e (a - a_before)) / (1 + c): its two modes have the product
 * e / (1 + c) and the sum (1 + e) / (1 + c), which are those of the system. A system with less damping than
 * that of the steps has none of its own. */
static void set_frequency(sbfi_glb_joint *joint, double length, double frequency, double damping_ratio) {
  double w = TURN * frequency * STEP_S, z = damping_ratio, root = sqrt(fabs(1 - z * z));
  double sum = z < 1 ? 2 * exp(-z * w) * cos(root * w) : exp(-w / (z + root)) + exp(-w * (z + root));
  double product = exp(-2 * z * w), ahead = sum - product;
  double kept = ahead > 0 ? product / ahead : 2, c = ahead > 0 ? 1 / ahead - 1 : w * w;
  if (kept > 1) kept = 1, c = w * w;
  joint->drag_force = (float)(1 - kept);
  joint->stiffness = (float)(length * fmin(fmax(c, 0), 1e6) / STEP_S);
}

/* Without inertia; a small angle decays at that rate in 1/s. */
static void set_rate(sbfi_glb_joint *joint, double length, double rate) {
  joint->drag_force = 1;
  joint->stiffness = (float)(length * expm1(fmin(rate * STEP_S, 10)) / STEP_S);
}

static void set_spring(sbfi_glb_joint *joint, const sbf_chain_spring *spring, uint32_t k) {
  double drag = (double)number_of(spring->drag, k), factor = sbfi_vrm_acceleration(drag);
  sbf_vec3 none = {0, 0, 0}, g = !spring->gravity.count      ? none
                                 : spring->gravity.count > 1 ? spring->gravity.at[k]
                                                             : spring->gravity.at[0];
  double gravity = length_of(g);
  joint->drag_force = (float)sbfi_vrm_drag_force(drag);
  joint->stiffness = (float)((double)number_of(spring->stiffness, k) / factor);
  joint->hit_radius = number_of(spring->radius, k);
  joint->gravity_power = (float)(gravity / factor);
  if (gravity > 0) joint->gravity_direction = sbfi_d3_rounded(sbfi_d3_scale(sbfi_d3_of(g), 1 / gravity));
}

static const sbf_tail *tail_of(const sbf_asset *a, uint32_t chain) {
  for (uint32_t t = 0; a->gaits.count && t < a->gaits.at[0].tails.count; t++)
    if (a->gaits.at[0].tails.at[t].chain == (int32_t)chain) return &a->gaits.at[0].tails.at[t];
  return NULL;
}

/* Whether no other spring swings these bones; they are taken then. */
static bool take_bones(uint8_t *taken, const uint32_t *bones, uint32_t count) {
  for (uint32_t k = 0; k < count; k++)
    if (taken[bones[k]]) return false;
  for (uint32_t k = 0; k < count; k++) taken[bones[k]] = 1;
  return true;
}

/* Child at the end of a bone that no spring swings yet, which is taken then; SBF_NONE: there is none. */
static int32_t take_end(const sbf_asset *a, uint32_t bone, sbf_vec3 end, uint8_t *taken) {
  for (uint32_t i = bone + 1; i < a->bones.count; i++) {
    if (a->bones.at[i].parent != (int32_t)bone || taken[i]) continue;
    sbfi_d3 head = sbfi_d3_sub(sbfi_d3_of(a->bones.at[i].head), sbfi_d3_of(a->bones.at[bone].head));
    sbfi_d3 away = sbfi_d3_sub(sbfi_d3_of(in_bone(a, bone, head)), sbfi_d3_of(end));
    if (sbfi_d3_length(away) > SAME_POINT * length_of(end)) continue;
    taken[i] = 1;
    return (int32_t)i;
  }
  return SBF_NONE;
}

static bool is_descending(const sbf_asset *a, const uint32_t *bones, uint32_t count) {
  for (uint32_t k = 1; k < count; k++) {
    int32_t bone = (int32_t)bones[k];
    while (bone > (int32_t)bones[k - 1]) bone = a->bones.at[bone].parent;
    if (bone != (int32_t)bones[k - 1] || bones[k] == bones[k - 1]) return false;
  }
  return true;
}

/* Joints of a chain from bone `first` on; bones at the end without length do not swing. */
static bool add_chain(
    sbfi_glb *g, const sbf_chain *chain, const sbf_tail *tail, uint8_t *taken, sbfi_glb_spring *to) {
  const sbf_asset *a = g->e->asset;
  uint32_t first = tail || chain->spring ? 0 : 1, count = chain->bones.count;
  while (count > first && length_of(step_of(a, chain, count - 1)) <= 0) count--;
  if (count <= first || !is_descending(a, chain->bones.at, chain->bones.count)) return false;
  uint32_t ends = count < chain->bones.count ? 1 : 0; /* the next bone ends the last one that swings */
  if (!take_bones(taken, chain->bones.at + first, count - first + ends)) return false;
  *to = (sbfi_glb_spring){.name = *chain->name ? chain->name : chain->id,
      .source = tail ? NULL : chain->spring,
      .joints = sbfi_glb_allocate(g, count - first, sizeof *to->joints),
      .joint_count = count - first,
      .end_bone = SBF_NONE,
      .end = step_of(a, chain, count - 1)};
  to->end_bone =
      ends ? (int32_t)chain->bones.at[count] : take_end(a, chain->bones.at[count - 1], to->end, taken);
  for (uint32_t k = first; to->joints && k < count; k++) {
    sbfi_glb_joint *joint = &to->joints[k - first];
    double length = length_of(step_of(a, chain, k));
    *joint = (sbfi_glb_joint){.bone = chain->bones.at[k], .gravity_direction = {0, -1, 0}};
    if (tail)
      set_frequency(joint, length, (double)tail->frequency, (double)tail->damping_ratio);
    else if (chain->spring)
      set_spring(joint, chain->spring, k);
    else
      set_rate(joint, length, (double)chain->damping);
  }
  return to->joints != NULL;
}

static bool add_follower(sbfi_glb *g, const sbf_follower *follower, uint8_t *taken, sbfi_glb_spring *to) {
  uint32_t bone = (uint32_t)follower->bone;
  double length = (double)g->e->asset->bones.at[bone].length;
  bool rotates =
      follower->channel == SBF_FOLLOWER_CHANNEL_ROTATION || follower->channel == SBF_FOLLOWER_CHANNEL_BOTH;
  if (!rotates || length <= 0 || !take_bones(taken, &bone, 1)) return false;
  *to = (sbfi_glb_spring){.name = *follower->name ? follower->name : follower->id,
      .joints = sbfi_glb_allocate(g, 1, sizeof *to->joints),
      .joint_count = 1,
      .end_bone = SBF_NONE,
      .end = {0, (float)length, 0}};
  to->end_bone = take_end(g->e->asset, bone, to->end, taken);
  if (!to->joints) return false;
  to->joints[0] = (sbfi_glb_joint){.bone = bone, .gravity_direction = {0, -1, 0}};
  set_frequency(to->joints, length, (double)follower->frequency, (double)follower->damping_ratio);
  return true;
}

void sbfi_glb_plan_springs(sbfi_glb *g, uint32_t first_node) {
  const sbf_asset *a = g->e->asset;
  uint32_t capacity = a->chains.count + a->followers.count;
  if (!capacity || !a->bones.count || g->e->motion) return;
  sbfi_glb_springs *s = sbfi_glb_allocate(g, 1, sizeof *s);
  uint8_t *taken = sbfi_glb_allocate(g, a->bones.count, 1);
  if (!s || !taken) return;
  s->at = sbfi_glb_allocate(g, capacity, sizeof *s->at);
  for (int own = 1; own >= 0 && s->at; own--) /* chains with springs first */
    for (uint32_t i = 0; i < a->chains.count; i++) {
      const sbf_tail *tail = tail_of(a, i);
      if (own != (a->chains.at[i].spring && !tail)) continue;
      if (add_chain(g, &a->chains.at[i], tail, taken, &s->at[s->count]))
        s->count++;
      else
        s->chains_left_out++;
    }
  for (uint32_t i = 0; i < a->followers.count && s->at; i++) {
    if (add_follower(g, &a->followers.at[i], taken, &s->at[s->count]))
      s->count++;
    else
      s->followers_left_out++;
  }
  for (uint32_t i = 0; i < s->count; i++)
    if (s->at[i].end_bone == SBF_NONE) s->at[i].end_node = first_node + s->end_count++;
  for (uint32_t i = 0; i < a->chain_colliders.count; i++) {
    const sbf_chain_collider *c = &a->chain_colliders.at[i];
    s->extended = s->extended || c->inside || c->shape == SBF_CHAIN_COLLIDER_SHAPE_PLANE;
  }
  g->springs = s;
}
