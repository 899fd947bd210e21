/* Which places of two rigid hulls may touch within a tick. */
#include "meet/finding.h"

#include "collide/hull_sweep.h"
#include "math/vec3.h"

/* How near hulls begin to touch, beside their ways: a share of their size. */
static const float NEAR_SHARE = 0.02f;
/* Hulls that go further in a tick than this share of the smaller one are looked at where they come near. */
static const float FAST_SHARE = 0.5f;
enum { MIDDLE = 1 }; /* the feature of a touch of that; corners have 0 */

static sbri_placed_hull placed(const sbri_party *p, const sbr_transform *at) {
  return (sbri_placed_hull){&p->rigid->hull, at->position, at->rotation, p->of->scale};
}

static bool overlap_at_rest(const sbri_party *a, const sbri_party *b) {
  sbr_transform at_a = {sbri_scale(a->rigid->center, a->of->scale), a->rigid->axes},
                at_b = {sbri_scale(b->rigid->center, b->of->scale), b->rigid->axes};
  sbri_placed_hull hull_a = placed(a, &at_a), hull_b = placed(b, &at_b);
  sbri_hull_pair pair;
  return sbri_hulls_meet(&hull_a, &hull_b, 0, &pair) && pair.gap < 0;
}

/* However it turns on from there, the middle of the one stays as far from the other's plane as its hull is
 * thick: what is hit aside at such speeds turns several times in a tick. */
static void add_middle(const sbri_finding *f, const sbri_party *parties, const sbr_transform *frames,
    const sbri_hull_pair *pair, int one) {
  const sbri_party *p = &parties[one], *other = &parties[!one];
  const sbri_hull *hull = &p->rigid->hull;
  sbf_vec3 n = one ? sbri_scale(pair->normal, -1) : pair->normal; /* towards the one */
  sbf_vec3 x =
      sbri_add_scaled(frames[one].position, sbri_rotate(frames[one].rotation, hull->middle), p->of->scale);
  float gap = sbri_dot(n, sbri_sub(x, one ? pair->on_a[0] : pair->on_b[0]));
  uint32_t face;
  float thick = -sbri_hull_depth(hull, hull->middle, &face) * p->of->scale;
  sbri_meet_side sides[2];
  sides[one] = sbri_rigid_side(p, hull->middle);
  sides[!one] =
      sbri_rigid_side(other, sbri_into_frame(&frames[!one], sbri_add_scaled(x, n, -gap), other->of->scale));
  sbri_meet_touch t = {.a = sides[0],
      .b = sides[1],
      .normal = pair->normal,
      .margin = gap < thick ? gap : thick,
      .feature = MIDDLE};
  sbri_finding_add(f, &parties[0], &parties[1], &t);
}

void sbri_meet_hulls(const sbri_finding *f, const sbri_party *a, const sbri_party *b) {
  sbr_transform from_a = sbri_party_frame(a, false), from_b = sbri_party_frame(b, false),
                to_a = sbri_party_frame(a, true), to_b = sbri_party_frame(b, true);
  sbri_placed_hull hull_a = placed(a, &from_a), hull_b = placed(b, &from_b);
  sbf_vec3 way = sbri_sub(sbri_sub(to_a.position, from_a.position), sbri_sub(to_b.position, from_b.position));
  float sizes[2] = {a->rigid->radius * a->of->scale, b->rigid->radius * b->of->scale};
  float near = NEAR_SHARE * (sizes[0] + sizes[1]), reach = sbri_length(way) + near;
  sbri_hull_pair pair;
  bool fast = sbri_length(way) > FAST_SHARE * fminf(sizes[0], sizes[1]);
  if (fast) { /* as they are when they come near */
    const sbri_placed_hull from[2] = {hull_a, hull_b}, to[2] = {placed(a, &to_a), placed(b, &to_b)};
    float share = sbri_hulls_sweep(from, to, near);
    if (share > 1) return;
    hull_a = sbri_hull_on_way(&from[0], &to[0], share), hull_b = sbri_hull_on_way(&from[1], &to[1], share);
    from_a = (sbr_transform){hull_a.at, hull_a.turn}, from_b = (sbr_transform){hull_b.at, hull_b.turn};
    reach = 2 * near;
  }
  if (!sbri_hulls_meet(&hull_a, &hull_b, reach, &pair)) return;
  if (sbri_are_of_one(a, b) && overlap_at_rest(a, b)) return;
  for (uint32_t i = 0; i < pair.count; i++) {
    sbri_meet_touch t = {.a = sbri_rigid_side(a, sbri_into_frame(&from_a, pair.on_a[i], a->of->scale)),
        .b = sbri_rigid_side(b, sbri_into_frame(&from_b, pair.on_b[i], b->of->scale)),
        .normal = pair.normal};
    sbri_finding_add(f, a, b, &t);
  }
  const sbri_party parties[2] = {*a, *b};
  const sbr_transform frames[2] = {from_a, from_b};
  if (fast) add_middle(f, parties, frames, &pair, sizes[1] < sizes[0]);
}
