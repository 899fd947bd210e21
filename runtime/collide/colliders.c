#include "collide/colliders.h"

#include <string.h>

/* Places a million metres out are right to a sixteenth: bounds are larger by this share of them. */
static const float ROUNDING = 2.4e-7f;

static sbf_vec3 single(sbr_double3 x) {
  return sbri_vec3((float)x.x, (float)x.y, (float)x.z);
}

/* Of a shape's bounds, turned and moved. */
static sbri_box turned(sbri_box box, sbf_quat turn, sbf_vec3 at) {
  sbri_box all = {at, at};
  for (int i = 0; i < 8; i++) {
    sbf_vec3 corner = {
        i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z};
    sbf_vec3 x = sbri_add(at, sbri_rotate(turn, corner));
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
  sbri_box all =
      sbri_box_join(turned(box, c->turn_from, single(c->from)), turned(box, c->turn_to, single(c->to)));
  /* Between the two rotations corners swing out of both boxes, by no more than they are apart. */
  if (memcmp(&c->turn_from, &c->turn_to, sizeof c->turn_from) != 0) {
    sbf_vec3 size = sbri_sub(box.high, box.low);
    all = sbri_box_grown(all, 0.25f * sbri_length(size));
  }
  return rounded(all);
}

void sbri_colliders_begin_tick(sbri_collider_set *set) {
  uint32_t count = 0;
  set->moving = set->stirred, set->stirred = false;
  for (uint32_t i = 0; i < set->end; i++) {
    sbri_collider *c = &set->at[i];
    if (!c->shape) continue;
    c->from = c->to, c->turn_from = c->turn_to;
    c->to = c->next, c->turn_to = c->turn_next;
    set->moving = set->moving || memcmp(&c->from, &c->to, sizeof c->to) != 0 ||
                  memcmp(&c->turn_from, &c->turn_to, sizeof c->turn_to) != 0;
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
