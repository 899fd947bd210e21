/* Contacts between two hulls. */
#include "coupling/body_contact/narrow_phase.h"

#include "math/vec3.h"
#include "shapes/hull_sweep.h"

/* Contact margin beside the motion, as a fraction of the hulls' sizes. */
static const float NEAR_FRACTION = 0.02f;
/* Hulls that move by more than this fraction of the smaller one's size are tested at the time of impact. */
static const float FAST_FRACTION = 0.5f;
enum { CENTER_FEATURE = 1 }; /* feature of a center contact; corners have 0 */

static sbri_placed_hull hull_at(const sbri_pair_body *p, const sbr_transform *at) {
  return (sbri_placed_hull){&p->rigid->hull, at->position, at->rotation, p->owner->scale};
}

static bool overlap_at_rest(const sbri_pair_body *a, const sbri_pair_body *b) {
  sbr_transform at_a = {sbri_scale(a->rigid->center, a->owner->scale), a->rigid->axes},
                at_b = {sbri_scale(b->rigid->center, b->owner->scale), b->rigid->axes};
  sbri_placed_hull hull_a = hull_at(a, &at_a), hull_b = hull_at(b, &at_b);
  sbri_hull_pair pair;
  return sbri_collide_hulls(&hull_a, &hull_b, 0, &pair) && pair.gap < 0;
}

/* A body hit off-center at high speed turns several times in a tick. A contact at its center keeps it at its
 * thickness from the other's plane in every orientation. */
static void add_center_contact(const sbri_narrow_phase *f, const sbri_pair_body *bodies,
    const sbr_transform *frames, const sbri_hull_pair *pair, int one) {
  const sbri_pair_body *p = &bodies[one], *other = &bodies[!one];
  const sbri_hull *hull = &p->rigid->hull;
  sbf_vec3 n = one ? sbri_scale(pair->normal, -1) : pair->normal; /* towards this body */
  sbf_vec3 x =
      sbri_add_scaled(frames[one].position, sbri_rotate(frames[one].rotation, hull->middle), p->owner->scale);
  float gap = sbri_dot(n, sbri_sub(x, one ? pair->on_a[0] : pair->on_b[0]));
  uint32_t face;
  float thickness = -sbri_hull_depth(hull, hull->middle, &face) * p->owner->scale;
  sbri_contact_side sides[2];
  sides[one] = sbri_rigid_contact_side(p, hull->middle);
  sides[!one] = sbri_rigid_contact_side(
      other, sbri_to_local(&frames[!one], sbri_add_scaled(x, n, -gap), other->owner->scale));
  sbri_contact t = {.a = sides[0],
      .b = sides[1],
      .normal = pair->normal,
      .margin = gap < thickness ? gap : thickness,
      .feature = CENTER_FEATURE};
  sbri_narrow_phase_add(f, &bodies[0], &bodies[1], &t);
}

void sbri_find_hull_contacts(const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b) {
  sbr_transform from_a = sbri_pair_body_frame(a, false), from_b = sbri_pair_body_frame(b, false),
                to_a = sbri_pair_body_frame(a, true), to_b = sbri_pair_body_frame(b, true);
  sbri_placed_hull hull_a = hull_at(a, &from_a), hull_b = hull_at(b, &from_b);
  sbf_vec3 displacement =
      sbri_sub(sbri_sub(to_a.position, from_a.position), sbri_sub(to_b.position, from_b.position));
  float sizes[2] = {a->rigid->radius * a->owner->scale, b->rigid->radius * b->owner->scale};
  float near = NEAR_FRACTION * (sizes[0] + sizes[1]), reach = sbri_length(displacement) + near;
  sbri_hull_pair pair;
  bool fast = sbri_length(displacement) > FAST_FRACTION * fminf(sizes[0], sizes[1]);
  if (fast) { /* at the time of impact */
    const sbri_placed_hull from[2] = {hull_a, hull_b}, to[2] = {hull_at(a, &to_a), hull_at(b, &to_b)};
    float fraction = sbri_hulls_sweep(from, to, near);
    if (fraction > 1) return;
    hull_a = sbri_hull_interpolate(&from[0], &to[0], fraction),
    hull_b = sbri_hull_interpolate(&from[1], &to[1], fraction);
    from_a = (sbr_transform){hull_a.at, hull_a.rotation},
    from_b = (sbr_transform){hull_b.at, hull_b.rotation};
    reach = 2 * near;
  }
  if (!sbri_collide_hulls(&hull_a, &hull_b, reach, &pair)) return;
  if (sbri_are_same_character(a, b) && overlap_at_rest(a, b)) return;
  for (uint32_t i = 0; i < pair.count; i++) {
    sbri_contact t = {.a = sbri_rigid_contact_side(a, sbri_to_local(&from_a, pair.on_a[i], a->owner->scale)),
        .b = sbri_rigid_contact_side(b, sbri_to_local(&from_b, pair.on_b[i], b->owner->scale)),
        .normal = pair.normal};
    sbri_narrow_phase_add(f, a, b, &t);
  }
  const sbri_pair_body bodies[2] = {*a, *b};
  const sbr_transform frames[2] = {from_a, from_b};
  if (fast) add_center_contact(f, bodies, frames, &pair, sizes[1] < sizes[0]);
}
