#include "shapes/colliders.h"

#include <string.h>

/* Relative enlargement of bounds: a million metres from the origin positions are exact to 1/16 m. */
static const float ROUNDING = 2.4e-7f;

static sbf_vec3 single(sbr_double3 x) {
  return sbri_vec3((float)x.x, (float)x.y, (float)x.z);
}

/* Bounds of a shape, rotated and moved. */
static sbri_box rotated_bounds(sbri_box box, sbf_quat rotation, sbf_vec3 at) {
  sbri_box all = {at, at};
  for (int i = 0; i < 8; i++) {
    sbf_vec3 corner = {
        i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z};
    sbf_vec3 x = sbri_add(at, sbri_rotate(rotation, corner));
    all = i ? sbri_box_with(all, x) : sbri_box_of_point(x);
  }
  return all;
}

static sbri_box rounded(sbri_box box) {
  sbf_vec3 h = {fmaxf(fabsf(box.low.x), fabsf(box.high.x)), fmaxf(fabsf(box.low.y), fabsf(box.high.y)),
      fmaxf(fabsf(box.low.z), fabsf(box.high.z))};
  return sbri_box_grown(box, ROUNDING * (h.x + h.y + h.z) + 1e-5f);
}

sbri_box sbri_collider_bounds(const sbri_collider *c) {
  sbri_box box = c->shape->bounds;
  sbri_box all = sbri_box_join(rotated_bounds(box, c->rotation_from, single(c->from)),
      rotated_bounds(box, c->rotation_to, single(c->to)));
  /* Between the two rotations, corners leave both boxes by at most a quarter of the diagonal. */
  if (memcmp(&c->rotation_from, &c->rotation_to, sizeof c->rotation_from) != 0) {
    sbf_vec3 size = sbri_sub(box.high, box.low);
    all = sbri_box_grown(all, 0.25f * sbri_length(size));
  }
  return rounded(all);
}

static sbf_vec3 single_of(const double v[3]) {
  return sbri_vec3((float)v[0], (float)v[1], (float)v[2]);
}

/* The impulses of the last tick are those that other bodies are assumed to apply in the next. If the host has
 * not set the motion since, the body continues with them. */
static void begin_body(sbri_collider *c, float tick_s) {
  sbri_host_body *b = &c->body;
  b->contributor_count = b->next_contributor_count, b->impulse = single_of(b->next_impulse),
  b->moment = single_of(b->next_moment);
  b->next_contributor_count = 0;
  for (int k = 0; k < 3; k++) b->next_impulse[k] = b->next_moment[k] = 0;
  if (!b->is_moving || b->is_reported) return;
  sbf_vec3 velocity_change =
      sbri_add_scaled(sbri_scale(b->acceleration, tick_s), b->impulse, b->inverse_mass);
  b->velocity = sbri_add(b->velocity, sbri_host_body_free(b, velocity_change));
}

/* Predicts the position after the tick without impulses. */
static void advance(const sbri_collider_set *set, sbri_collider *c, float tick_s) {
  sbri_host_body *b = &c->body;
  if (!b->is_moving) return;
  const sbri_collider *leader = &set->at[c->leader];
  if (!b->is_reported && leader != c) {
    sbf_vec3 arm = {
        (float)(c->to.x - leader->to.x), (float)(c->to.y - leader->to.y), (float)(c->to.z - leader->to.z)};
    b->angular_velocity = leader->body.angular_velocity;
    b->velocity = sbri_add(leader->body.velocity, sbri_cross(b->angular_velocity, arm));
  }
  b->is_reported = false;
  c->next = (sbr_double3){c->to.x + (double)(tick_s * b->velocity.x),
      c->to.y + (double)(tick_s * b->velocity.y), c->to.z + (double)(tick_s * b->velocity.z)};
  sbf_vec3 half = sbri_scale(b->angular_velocity, 0.5f * tick_s);
  if (!(sbri_dot(half, half) > 0)) {
    c->rotation_next = c->rotation_to;
    return;
  }
  c->rotation_next =
      sbri_quat_normalize(sbri_quat_multiply((sbf_quat){half.x, half.y, half.z, 1}, c->rotation_to));
}

void sbri_colliders_begin_tick(sbri_collider_set *set, double tick_s) {
  uint32_t count = 0;
  set->is_moving = set->has_changed, set->has_changed = false;
  for (uint32_t i = 0; i < set->end; i++)
    if (set->at[i].shape && set->at[i].body.inverse_mass > 0) begin_body(&set->at[i], (float)tick_s);
  for (uint32_t i = 0; i < set->end; i++)
    if (set->at[i].shape) advance(set, &set->at[i], (float)tick_s);
  for (uint32_t i = 0; i < set->end; i++) {
    sbri_collider *c = &set->at[i];
    if (!c->shape) continue;
    c->from = c->to, c->rotation_from = c->rotation_to;
    c->to = c->next, c->rotation_to = c->rotation_next;
    set->is_moving = set->is_moving || memcmp(&c->from, &c->to, sizeof c->to) != 0 ||
                     memcmp(&c->rotation_from, &c->rotation_to, sizeof c->rotation_to) != 0;
    set->bounds[count] = sbri_collider_bounds(c);
    set->listed[count++] = i;
  }
  sbri_bounds_tree_make(&set->tree, set->bounds, count);
}

sbri_collider_frame sbri_collider_frame_of(const sbri_collider *c, sbr_double3 origin, float scale) {
  return (sbri_collider_frame){.collider = c,
      .from = {(float)(c->from.x - origin.x), (float)(c->from.y - origin.y), (float)(c->from.z - origin.z)},
      .to = {(float)(c->to.x - origin.x), (float)(c->to.y - origin.y), (float)(c->to.z - origin.z)},
      .scale = scale};
}

sbri_box sbri_box_in_world(sbri_box box, sbr_double3 origin, float scale) {
  sbf_vec3 at = single(origin);
  return rounded((sbri_box){sbri_add_scaled(at, box.low, scale), sbri_add_scaled(at, box.high, scale)});
}
