/* Contact of soft bodies with the ground.
 *
 * The contact points are the body's points, or surface samples where points only embed the surface
 * (prepare/contact_samples.c, soft/solvers/soft_contacts.h). Once per tick the ground below each candidate
 * becomes a plane. In each substep, a point that would pass its plane loses normal velocity so that it just
 * arrives, or bounces if it is fast. Points below the plane are moved up at a limited speed that does not
 * become velocity. Contacts never pull.
 *
 * Coulomb friction removes tangential velocity. It is bounded by the friction coefficient times the mean of
 * the normal changes in recent substeps of the tick. With the last change alone, surface waves as short as a
 * cell have their pressure and friction in phase and excite themselves, more so with finer cells: bodies
 * creep down slopes on which they should stick. Sliding friction between elastic bodies is ill-posed in this
 * way unless it follows pressure with a delay (J. R. Rice, N. Lapusta, K. Ranjith, Rate and state dependent
 * friction and the stability of sliding between elastically deformable solids, 2001). Longer waves are damped
 * (soft/solvers/slide_damping.h). The friction of an impact is not delayed in its tick. */
#ifndef SBRI_CONTACT_H
#define SBRI_CONTACT_H

#include "model/island_tick.h"

/* Distance at which contacts are found: twice the displacement of the tick, plus this fraction of the body's
 * size for displacement by forces in the tick. */
#define SBRI_MOTION_FRACTION 0.02f

/* Output tables of contact detection, of the island and the character as in sbri_island_tick. */
typedef struct sbri_contact_tables {
  uint8_t *near_ground;
  float *planes, *pressing;
  sbri_soft_contact *contacts;
  uint32_t *contact_counts;
  struct sbri_external_bodies *external_bodies; /* of the body */
  struct sbri_contact_reports *touched;         /* contacts of the body in the previous tick; for events */
  sbri_point_contacts *point_contacts;          /* (slots) scratch */
  uint8_t *slot_contacts;      /* (slots) scratch: number of contacts that move each point, capped at 2 */
  const sbri_skin *surface;    /* of the body, at its present positions */
  struct sbri_box *self_boxes; /* scratch of the body for self contact */
  struct sbri_moving_ball *self_balls;
  struct sbri_bounds_node *self_nodes;
  uint32_t *self_items;
  uint8_t *self_edges;
} sbri_contact_tables;

/* Finds ground contacts of the body within the tick. Marks blocks of points near the ground and stores a
 * plane for each point: blocks of four by eight values, the unit normal and n.x of the plane. A body with
 * samples gets a list of contacts instead. */
void sbri_contact_prepare(
    const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_tables *tables);

/* Number of recent substeps in the mean, and the fraction of the missing friction that is added to it. With
 * 12 substeps and 0, blocks slide too fast by up to 5 %; with a third, blocks that stick slip by 3e-4 of
 * gravity. */
#define SBRI_PRESSING_SUBSTEPS 6.0f
#define SBRI_PRESSING_DEFICIT_FRACTION (2.0f / 3)
/* s; time of a contact that has had one impulse in the tick */
#define SBRI_PRESSING_BEGUN_S 1e-20f
/* m/s; minimum closing speed of an impact */
#define SBRI_STRIKE_M_S 0.2f

typedef struct sbri_contact_rule {
  float friction, restitution;
  const float *frictions; /* (free slots of the island) coefficient per point; NULL: uniform */
  float step_s;
  float max_correction_m; /* maximum correction of penetration in a substep, m */
  float slack_m;          /* penetration that is not corrected, m */
  float bounce_from_m_s;  /* minimum approach speed of a bounce, m/s */
  float *pressing;        /* as in sbri_island_tick; for points with planes */
} sbri_contact_rule;

/* One plane per lane. */
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

/* Friction coefficients of the group of lanes that begins at `slot`. */
static inline sbri_wide sbri_contact_friction(const sbri_contact_rule *rule, uint32_t slot) {
  return rule->frictions ? sbri_wide_load(rule->frictions + slot) : sbri_wide_all(rule->friction);
}

/* Adds a normal velocity change to v and applies friction of at most max. */
static inline sbri_wide3 sbri_contact_apply_normal_change(
    const sbri_contact_planes *p, sbri_wide3 v, sbri_wide normal_velocity_change, sbri_wide max) {
  sbri_wide speed = sbri_planes_along(p, v), one = sbri_wide_all(1);
  sbri_wide3 n = p->normal, s = {v.x - n.x * speed, v.y - n.y * speed, v.z - n.z * speed};
  sbri_wide tangential = sbri_wide_sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
  sbri_wide fraction = sbri_wide_min(max / sbri_wide_max(tangential, sbri_wide_all(1e-20f)), one);
  return (sbri_wide3){v.x + n.x * normal_velocity_change - s.x * fraction,
      v.y + n.y * normal_velocity_change - s.y * fraction,
      v.z + n.z * normal_velocity_change - s.z * fraction};
}

/* Mean of the normal velocity changes of recent substeps, for a substep of step_s. */
static inline float sbri_pressing_mean(sbri_pressing with, float normal_velocity_change, float step_s) {
  return with.velocity_change > 0 ? step_s * with.velocity_change / with.time_s : normal_velocity_change;
}

/* Adds the normal velocity change of a substep. The first one of a tick is not counted: a contact that
 * arrives within the substep has less. */
static inline sbri_pressing sbri_pressing_add(
    sbri_pressing before, float normal_velocity_change, float closing_speed, float step_s) {
  const float old_fraction = 1 - 1 / SBRI_PRESSING_SUBSTEPS;
  if (!(normal_velocity_change > 0) || before.time_s < 0) return before;
  if (closing_speed > SBRI_STRIKE_M_S) return (sbri_pressing){0, -1, 0};
  if (before.time_s == 0) return (sbri_pressing){0, SBRI_PRESSING_BEGUN_S, 0};
  sbri_pressing with = {old_fraction * before.velocity_change + normal_velocity_change,
      old_fraction * before.time_s + step_s, before.deficit};
  float mean = sbri_pressing_mean(with, normal_velocity_change, step_s);
  with.deficit += normal_velocity_change - (mean + SBRI_PRESSING_DEFICIT_FRACTION * before.deficit);
  return with;
}

/* Normal velocity change that bounds friction in a substep; `with` is the result of sbri_pressing_add. A mean
 * alone loses its lag whenever a contact begins or ends, which is often for samples that share points. */
static inline float sbri_pressing_bound(sbri_pressing with, float normal_velocity_change, float step_s) {
  float bound = sbri_pressing_mean(with, normal_velocity_change, step_s) +
                SBRI_PRESSING_DEFICIT_FRACTION * with.deficit;
  return bound > 0 ? bound : 0;
}

/* For the lanes that begin at `slot`: updates rule->pressing and returns the mean. Contacts of points with
 * planes begin and end less often, so the mean suffices. */
static inline sbri_wide sbri_contact_update_pressing(
    const sbri_contact_rule *rule, uint32_t slot, sbri_wide normal_velocity_change, sbri_wide speed) {
  float *to = rule->pressing + 2 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
  sbri_wide zero = sbri_wide_all(0), old_fraction = sbri_wide_all(1 - 1 / SBRI_PRESSING_SUBSTEPS);
  sbri_wide sum = sbri_wide_load(to), time = sbri_wide_load(to + SBRI_BLOCK), h = sbri_wide_all(rule->step_s);
  sbri_mask is_pressed = normal_velocity_change > zero, is_impact = speed < sbri_wide_all(-SBRI_STRIKE_M_S);
  sbri_wide next_time = sbri_wide_select(is_impact, sbri_wide_all(-1), old_fraction * time + h);
  sbri_mask first = time == zero;
  next_time = sbri_wide_select(first & (next_time > zero), sbri_wide_all(SBRI_PRESSING_BEGUN_S), next_time);
  next_time = sbri_wide_select(time < zero, time, next_time);
  sum = sbri_wide_select(
      is_pressed, sbri_wide_select(first, zero, old_fraction * sum + normal_velocity_change), sum);
  time = sbri_wide_select(is_pressed, next_time, time);
  sbri_wide_store(to, sum);
  sbri_wide_store(to + SBRI_BLOCK, time);
  sbri_wide mean = h * sum / sbri_wide_max(time, sbri_wide_all(1e-20f));
  return sbri_wide_select(is_pressed & (time > zero) & (sum > zero), mean, normal_velocity_change);
}

/* Result of a ground contact: the new velocity and the immediate correction of the position. `x` is the
 * position at the beginning of the substep. */
typedef struct sbri_contact_result {
  sbri_wide3 velocity;
  sbri_wide up;
} sbri_contact_result;

static inline sbri_contact_result sbri_contact_evaluate(
    const sbri_contact_planes *p, sbri_wide3 x, sbri_wide3 v, const sbri_contact_rule *rule, uint32_t slot) {
  sbri_wide zero = sbri_wide_all(0), h = sbri_wide_all(rule->step_s);
  sbri_wide gap = sbri_planes_gap(p, x), speed = sbri_planes_along(p, v);
  sbri_mask arrives = gap + h * speed < zero;
  /* Velocity that just reaches the plane; 0 for a point that is already below. */
  sbri_wide target = zero - sbri_wide_max(gap, zero) / h;
  sbri_mask bounces = speed < sbri_wide_all(-rule->bounce_from_m_s);
  target = sbri_wide_select(
      bounces, sbri_wide_max(target, zero - sbri_wide_all(rule->restitution) * speed), target);
  sbri_wide normal_velocity_change = sbri_wide_select(arrives, sbri_wide_max(target - speed, zero), zero);
  sbri_wide depth = sbri_wide_max(zero - gap - sbri_wide_all(rule->slack_m), zero);
  sbri_wide up = sbri_wide_min(depth, sbri_wide_all(rule->max_correction_m));
  sbri_wide max_friction = sbri_contact_friction(rule, slot) *
                           sbri_contact_update_pressing(rule, slot, normal_velocity_change, speed);
  return (sbri_contact_result){sbri_contact_apply_normal_change(p, v, normal_velocity_change, max_friction),
      sbri_wide_select(arrives, up, zero)};
}

/* Moves a group of lanes through a substep in contact. `x` is the position at the beginning on entry and at
 * the end on return. */
static inline void sbri_contact_move(
    sbri_wide3 *x, sbri_wide3 *v, const float *plane, const sbri_contact_rule *rule, uint32_t slot) {
  sbri_contact_planes p = sbri_planes_load(plane);
  sbri_contact_result a = sbri_contact_evaluate(&p, *x, *v, rule, slot);
  sbri_wide h = sbri_wide_all(rule->step_s);
  *v = a.velocity;
  x->x = x->x + h * v->x + p.normal.x * a.up;
  x->y = x->y + h * v->y + p.normal.y * a.up;
  x->z = x->z + h * v->z + p.normal.z * a.up;
}

/* Bounds a position correction from `from` to `to`, which changes velocity by the correction per second, so
 * that it does not move a point into the ground or deeper. The normal part that is removed causes friction.
 */
static inline void sbri_contact_bound(const sbri_contact_planes *p, sbri_wide3 from, sbri_wide3 *to,
    sbri_wide3 *v, const sbri_contact_rule *rule, uint32_t slot) {
  sbri_wide zero = sbri_wide_all(0), h = sbri_wide_all(rule->step_s);
  sbri_wide min = sbri_wide_min(sbri_planes_gap(p, from), zero);
  sbri_wide depth = sbri_wide_max(min - sbri_planes_gap(p, *to), zero);
  sbri_wide max_friction = sbri_contact_friction(rule, slot) * depth / h;
  sbri_wide3 bounded = sbri_contact_apply_normal_change(p, *v, depth / h, max_friction);
  to->x = to->x + h * (bounded.x - v->x);
  to->y = to->y + h * (bounded.y - v->y);
  to->z = to->z + h * (bounded.z - v->z);
  *v = bounded;
}

#endif
