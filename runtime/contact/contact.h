/* Surfaces against the ground.
 *
 * What meets the ground are the points of a body, or, where they only carry its surface, the samples of that
 * (prepare/contact_samples.c, solvers/touches.h). Once a tick the ground is asked under each that may reach
 * it, and stands for that tick as the plane that touches it there. In each substep one that would end below
 * its plane has its normal speed cut so that it just arrives (or thrown back by the restitution where it is
 * fast), and Coulomb friction takes no more from its sideways speed than the friction coefficient times what
 * the normal lost. What lies below already is moved up, at a limited rate and without gaining speed; nothing
 * is ever pulled down or held. */
#ifndef SBRI_CONTACT_H
#define SBRI_CONTACT_H

#include "model/island_tick.h"

/* As far as something may fall in a tick: twice its present way, and this share of the body for what springs
 * and weight may add. */
#define SBRI_MOTION_SHARE 0.02f

/* Where a tick's contacts go; of the island and of the character, as in sbri_island_tick. */
typedef struct sbri_contact_tables {
  uint8_t *near_ground;
  float *planes;
  sbri_touch *touches;
  uint32_t *touch_counts;
  struct sbri_external_bodies *external_bodies; /* of the body */
  const struct sbri_touching *touched;          /* by the body in the tick before */
  uint8_t *slot_touches;       /* (slots) scratch: how many touches move each point, as two where more */
  const sbri_skin *surface;    /* of the body, as it is carried now */
  struct sbri_box *self_boxes; /* scratch of the body, where it meets itself */
  struct sbri_moving_ball *self_balls;
  struct sbri_bounds_node *self_nodes;
  uint32_t *self_items;
  uint8_t *self_edges;
} sbri_contact_tables;

/* Marks the body's blocks of points that may touch the ground within the tick, and gives each of their points
 * its plane: blocks of four by eight, the unit normal and n.x of the plane. Of a body with samples instead,
 * lists those that may. */
void sbri_contact_prepare(
    const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_tables *tables);

typedef struct sbri_contact_rule {
  float friction, restitution;
  const float *frictions; /* (free slots of the island) of each point instead; NULL: all are alike */
  float step_s;
  float push_m;          /* most that a point is moved up in a substep */
  float slack_m;         /* as deep as a point may lie without being moved up */
  float bounce_from_m_s; /* slower contacts do not bounce */
} sbri_contact_rule;

/* A plane for each of a group of lanes. */
typedef struct sbri_contact_planes {
  sbri_wide3 normal;
  sbri_wide offset;
} sbri_contact_planes;

static inline sbri_contact_planes sbri_planes_load(const float *block) {
  return (sbri_contact_planes){
      {sbri_wide_load(block), sbri_wide_load(block + SBRI_BLOCK), sbri_wide_load(block + 2 * SBRI_BLOCK)},
      sbri_wide_load(block + 3 * SBRI_BLOCK)};
}
static inline sbri_wide sbri_planes_along(const sbri_contact_planes *p, sbri_wide3 v) {
  return p->normal.x * v.x + p->normal.y * v.y + p->normal.z * v.z;
}
static inline sbri_wide sbri_planes_gap(const sbri_contact_planes *p, sbri_wide3 x) {
  return sbri_planes_along(p, x) - p->offset;
}

/* Of the group of lanes from `slot` on. */
static inline sbri_wide sbri_contact_friction(const sbri_contact_rule *rule, uint32_t slot) {
  return rule->frictions ? sbri_wide_load(rule->frictions + slot) : sbri_wide_all(rule->friction);
}

/* A velocity that has gained `gain` along the normal, less what friction takes for it. */
static inline sbri_wide3 sbri_contact_gain(
    const sbri_contact_planes *p, sbri_wide3 v, sbri_wide gain, sbri_wide friction) {
  sbri_wide speed = sbri_planes_along(p, v), one = sbri_wide_all(1);
  sbri_wide3 n = p->normal, s = {v.x - n.x * speed, v.y - n.y * speed, v.z - n.z * speed};
  sbri_wide sideways = sbri_wide_sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
  sbri_wide max = friction * gain;
  sbri_wide share = sbri_wide_min(max / sbri_wide_max(sideways, sbri_wide_all(1e-20f)), one);
  return (sbri_wide3){
      v.x + n.x * gain - s.x * share, v.y + n.y * gain - s.y * share, v.z + n.z * gain - s.z * share};
}

/* What the ground makes of a velocity, and by how much it moves the place up at once; `x` as at the beginning
 * of the substep. */
typedef struct sbri_contact_answer {
  sbri_wide3 velocity;
  sbri_wide up;
} sbri_contact_answer;

static inline sbri_contact_answer sbri_contact_ask(
    const sbri_contact_planes *p, sbri_wide3 x, sbri_wide3 v, const sbri_contact_rule *rule, uint32_t slot) {
  sbri_wide zero = sbri_wide_all(0), h = sbri_wide_all(rule->step_s);
  sbri_wide gap = sbri_planes_gap(p, x), speed = sbri_planes_along(p, v);
  sbri_mask touches = gap + h * speed < zero;
  /* To where it just arrives; nowhere, where it lies below already. */
  sbri_wide wanted = zero - sbri_wide_max(gap, zero) / h;
  sbri_mask bounces = speed < sbri_wide_all(-rule->bounce_from_m_s);
  wanted = sbri_wide_select(
      bounces, sbri_wide_max(wanted, zero - sbri_wide_all(rule->restitution) * speed), wanted);
  sbri_wide gain = sbri_wide_select(touches, sbri_wide_max(wanted - speed, zero), zero);
  sbri_wide deep = sbri_wide_max(zero - gap - sbri_wide_all(rule->slack_m), zero);
  sbri_wide up = sbri_wide_min(deep, sbri_wide_all(rule->push_m));
  return (sbri_contact_answer){
      sbri_contact_gain(p, v, gain, sbri_contact_friction(rule, slot)), sbri_wide_select(touches, up, zero)};
}

/* One group of lanes in a substep: corrects velocity and place; `x` comes in as at the beginning of the
 * substep and goes out as at its end. */
static inline void sbri_contact_move(
    sbri_wide3 *x, sbri_wide3 *v, const float *plane, const sbri_contact_rule *rule, uint32_t slot) {
  sbri_contact_planes p = sbri_planes_load(plane);
  sbri_contact_answer a = sbri_contact_ask(&p, *x, *v, rule, slot);
  sbri_wide h = sbri_wide_all(rule->step_s);
  *v = a.velocity;
  x->x = x->x + h * v->x + p.normal.x * a.up;
  x->y = x->y + h * v->y + p.normal.y * a.up;
  x->z = x->z + h * v->z + p.normal.z * a.up;
}

/* A correction of places from `from` to `to` after the substep's own motion, which changed velocities by as
 * much per second: it does not go into the ground, or deeper into it, and what that takes of it rubs. */
static inline void sbri_contact_bound(const sbri_contact_planes *p, sbri_wide3 from, sbri_wide3 *to,
    sbri_wide3 *v, const sbri_contact_rule *rule, uint32_t slot) {
  sbri_wide zero = sbri_wide_all(0), h = sbri_wide_all(rule->step_s);
  sbri_wide min = sbri_wide_min(sbri_planes_gap(p, from), zero);
  sbri_wide lift = sbri_wide_max(min - sbri_planes_gap(p, *to), zero);
  sbri_wide3 bounded = sbri_contact_gain(p, *v, lift / h, sbri_contact_friction(rule, slot));
  to->x = to->x + h * (bounded.x - v->x);
  to->y = to->y + h * (bounded.y - v->y);
  to->z = to->z + h * (bounded.z - v->z);
  *v = bounded;
}

#endif
