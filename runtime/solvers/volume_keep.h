/* Keeping the volume within a body's surface, for pressure mode `volume`. Written for the lanes of the file
 * that includes it; see model/kernels.h.
 *
 * The constraint V(x) = V0, by Newton steps at the end of a substep: dx_i = s w_i g_i with g the gradient of
 * the volume, w the inverse masses and s = (V0 - V) / sum w_i |g_i|^2 (Hong, Jung, Choi and Welch, Fast
 * Volume Preservation for a Mass-Spring System, 2006, use the same multiplier). The constraint exerts any
 * pressure that it needs, without the additional substeps of a bulk modulus. The error of a step is of second
 * order: one is enough except where a body strikes the ground.
 *
 * Pinned points do not move, but simulated rigid bodies that hold them get the reaction and move in
 * proportion to their inverse mass (pinned_impulse.h); their motion restores the corresponding part of the
 * volume. If one rigid body holds all pinned points, or all points of the surface, it gets the opposite of
 * the free points' linear and angular momentum. Several rigid bodies could not divide that; then the gradient
 * at the beginning of the substep is used, for which the pinned points' parts add up to it (SHAKE).
 *
 * Points on the ground cannot move below it. They count in the sum with the part of their gradient along the
 * ground or away from it; the ground takes the normal part, with friction.
 *
 * Bias against the energy: none in the volume; the multiplier acts along the gradient at the end of the
 * substep instead of its beginning, which is of first order in h. */
#ifndef SBRI_VOLUME_KEEP_H
#define SBRI_VOLUME_KEEP_H

#include "math/lane_sums.h"
#include "skin/skin_lanes.h"
#include "solvers/motion.h"
#include "solvers/pinned_impulse.h"

/* Greatest fraction of the volume that is regained in a step: an inverted body recovers slowly. */
#define SBRI_MAX_VOLUME_FRACTION 0.1f

/* Further steps in a substep follow while more than this fraction of the volume was missing before the last
 * one; the rest is about its square. */
enum { SBRI_MAX_VOLUME_STEPS = 4 };
#define SBRI_VOLUME_FRACTION_LEFT 0.01f

/* A point this near to the ground rests on it, in m. */
#define SBRI_RESTING_M 1e-5f

/* Of the gradients of a group of lanes that touch the ground, what does not lead into it; `sign` of the
 * multiplier. */
static inline sbri_wide3 sbri_volume_off_ground(
    const sbri_island_tick *t, uint32_t slot, sbri_wide3 g, float sign) {
  sbri_contact_planes p = sbri_planes_of(t, slot);
  sbri_wide gap = sbri_planes_gap(&p, sbri_wide_load_points(t->positions + slot));
  sbri_wide along = sbri_planes_along(&p, g), zero = sbri_wide_all(0);
  sbri_mask rests = gap <= sbri_wide_all(SBRI_RESTING_M), leads_in = along * sbri_wide_all(sign) < zero;
  along = sbri_wide_select(rests & leads_in, along, zero);
  return (sbri_wide3){g.x - along * p.normal.x, g.y - along * p.normal.y, g.z - along * p.normal.z};
}

/* Where what goes with those places and speeds was `h` before. */
static inline sbri_wide3 sbri_positions_before(const sbri_island_tick *t, uint32_t slot, float h) {
  sbri_wide3 x = sbri_wide_load_points(t->positions + slot);
  sbri_wide3 v = sbri_load3(sbri_const_triple(t->velocities, slot));
  sbri_wide step = sbri_wide_all(h);
  return (sbri_wide3){x.x - step * v.x, x.y - step * v.y, x.z - step * v.z};
}

/* What one body holds it with: gradients of the free points and their moments about the body's place, where
 * the points were when the substep began. */
typedef struct sbri_volume_hold {
  sbri_reaction *by; /* NULL: several, or it is not simulated */
  float h;
  sbri_lane_sums sums;
} sbri_volume_hold;

/* Gradients of the volume at the body's slots, and the sum of w |g|^2 of what may move by a multiplier of
 * that sign. */
static inline float sbri_volume_gradients(const sbri_island_tick *t, const sbri_body *body,
    const sbri_point *faces, float sign, sbri_volume_hold *hold) {
  float lanes[SBRI_BLOCK] = {0};
  for (uint32_t slot = body->slot_begin; slot < body->slot_end; slot += SBRI_LANES) {
    uint32_t lane = slot % SBRI_BLOCK, block = (slot - body->slot_begin) / SBRI_BLOCK;
    sbri_wide3 g = {sbri_wide_all(0), sbri_wide_all(0), sbri_wide_all(0)};
    for (uint32_t c = body->volume_begins[block]; c < body->volume_begins[block + 1]; c++) {
      const sbri_carry_cell *cell = &body->volume_cells[c];
      sbri_wide3 n = sbri_wide_gather(faces, cell->slots + lane);
      sbri_wide w = sbri_wide_load(cell->weights + lane);
      g.x = g.x + w * n.x;
      g.y = g.y + w * n.y;
      g.z = g.z + w * n.z;
    }
    sbri_wide_store_points(t->velocity_points + slot, g);
    if (hold->by) {
      const sbf_vec3 *o = &hold->by->about;
      sbri_wide3 r = sbri_positions_before(t, slot, hold->h);
      r.x = r.x - sbri_wide_all(o->x), r.y = r.y - sbri_wide_all(o->y), r.z = r.z - sbri_wide_all(o->z);
      sbri_lane_sums_add(&hold->sums, lane, r, g);
    }
    if (t->near_ground[slot / SBRI_BLOCK]) g = sbri_volume_off_ground(t, slot, g, sign);
    sbri_wide w = sbri_wide_load(t->island->inverse_masses + slot);
    sbri_wide_store(lanes + lane, sbri_wide_load(lanes + lane) + w * (g.x * g.x + g.y * g.y + g.z * g.z));
  }
  return sbri_tree_sum(lanes);
}

static inline sbf_vec3 sbri_pinned_gradient(const sbri_point *faces, const sbri_face_weight *face_weight) {
  const sbri_point *n = &faces[face_weight->face];
  return sbri_scale(sbri_vec3(n->x, n->y, n->z), face_weight->weight);
}

/* Whether it is pinned to several bodies, at least one of them simulated. */
static inline bool sbri_volume_is_shared(const sbri_island_tick *t, const sbri_body *body) {
  if (!t->reactions || body->volume_carrier >= 0) return false;
  for (uint32_t k = 0; k < t->island->carrier_count; k++)
    if (t->reactions[t->island->carriers[k]].inverse_mass > 0) return true;
  return false;
}

static inline float sbri_reaction_inverse_mass(const sbri_reaction *r, sbf_vec3 push, sbf_vec3 turn) {
  return r->inverse_mass * sbri_dot(push, push) + r->inverse_inertia * sbri_dot(turn, turn);
}

/* Contribution of the simulated bodies of pinned points to that sum. */
static inline float sbri_volume_pinned_inverse_mass(
    const sbri_island_tick *t, const sbri_body *body, const sbri_point *faces) {
  float sum = 0;
  for (uint32_t k = 0; k < t->island->carrier_count; k++) {
    const sbri_reaction *r = &t->reactions[t->island->carriers[k]];
    sbf_vec3 push = {0, 0, 0}, turn = {0, 0, 0};
    for (uint32_t i = 0; r->inverse_mass > 0 && i < body->pinned_face_weight_count; i++) {
      const sbri_face_weight *face_weight = &body->pinned_face_weights[i];
      if (sbri_reaction_at(t, face_weight->slot) != r) continue;
      sbf_vec3 g = sbri_pinned_gradient(faces, face_weight);
      push = sbri_add(push, g);
      turn = sbri_add(turn, sbri_cross(sbri_reaction_arm(t, r, face_weight->slot), g));
    }
    sum += sbri_reaction_inverse_mass(r, push, turn);
  }
  return sum;
}

/* On what is held, where it was when the substep began. */
static inline void sbri_volume_apply_to_pinned(
    const sbri_island_tick *t, const sbri_body *body, const sbri_point *faces, float impulse, float h) {
  for (uint32_t i = 0; i < body->pinned_face_weight_count; i++) {
    const sbri_face_weight *face_weight = &body->pinned_face_weights[i];
    sbri_reaction *r = sbri_reaction_at(t, face_weight->slot);
    sbf_vec3 push = sbri_scale(sbri_pinned_gradient(faces, face_weight), impulse);
    if (!r) continue;
    sbri_pinned_apply_impulse(t, face_weight->slot, push);
    sbf_vec3 displacement = sbri_scale(sbri_slot_velocity(t, t->velocities, face_weight->slot), h);
    r->moment = sbri_sub(r->moment, sbri_cross(displacement, push));
  }
}

/* The volume within the surface of those points, and its faces' areas, twice. */
static inline float sbri_volume_within(
    const sbri_island_tick *t, const sbri_body *body, const sbri_point *points, sbri_point *faces) {
  const sbri_skin *skin = &body->surface;
  const sbri_point *vertices = points;
  const sbri_face_block *named = body->volume_faces;
  if (!named) {
    vertices = t->surface_vertices + body->first_vertex;
    named = skin->faces;
    sbri_lanes_compute_vertices(
        skin, points - t->island->first_slot, t->surface_vertices + body->first_vertex);
  }
  return sbri_lanes_volume(named, skin->face_block_count, vertices, faces);
}

/* The faces as they were when the substep began: by how places and speeds are now, which is all that a push
 * which changes both alike has to do with. */
static inline void sbri_compute_volume_faces_before(
    const sbri_island_tick *t, const sbri_body *body, sbri_point *faces, float h) {
  sbri_point *before = t->element_forces; /* scratch that nothing else uses here */
  for (uint32_t slot = 0; slot < t->island->free_count; slot += SBRI_LANES)
    sbri_wide_store_points(before + slot, sbri_positions_before(t, slot, h));
  for (uint32_t slot = t->island->free_count; slot < t->island->slot_count; slot++) {
    const sbri_point *x = &t->positions[slot];
    sbf_vec3 v = sbri_slot_velocity(t, t->velocities, slot);
    before[slot] = (sbri_point){x->x - h * v.x, x->y - h * v.y, x->z - h * v.z, 0};
  }
  (void)sbri_volume_within(t, body, before, faces);
}

/* One step at the end of a substep; returns the fraction of the volume that was missing before it. `owed`:
 * volume that simulated bodies will restore, by the impulses of earlier steps. */
static inline float sbri_volume_step(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule, float *owed) {
  sbri_point *faces = t->surface_faces + body->first_face;
  float rest = (float)body->rest_volume_m3, max = SBRI_MAX_VOLUME_FRACTION * rest;
  float missing = rest - sbri_volume_within(t, body, t->positions, faces) - *owed;
  const bool shared = sbri_volume_is_shared(t, body);
  if (shared) sbri_compute_volume_faces_before(t, body, faces, rule->step_s);
  sbri_reaction *by = t->reactions && body->volume_carrier >= 0 ? &t->reactions[body->volume_carrier] : NULL;
  sbri_volume_hold hold;
  hold.by = by && by->inverse_mass > 0 ? by : NULL, hold.h = rule->step_s;
  if (hold.by) memset(&hold.sums, 0, sizeof hold.sums);
  float sum = sbri_volume_gradients(t, body, faces, missing, &hold), limited = 0;
  sbf_vec3 push = {0, 0, 0}, turn = {0, 0, 0};
  if (hold.by) push = sbri_lanes_push(&hold.sums), turn = sbri_lanes_moment(&hold.sums);
  if (hold.by && body->pinned_face_weight_count > 0)
    limited = sbri_reaction_inverse_mass(hold.by, push, turn);
  if (shared) limited = sbri_volume_pinned_inverse_mass(t, body, faces);
  if (!(sum > 0) || !(missing - missing == 0)) return 0;
  float s = (missing > max ? max : missing < -max ? -max : missing) / (sum + limited);
  *owed += s * limited;
  if (hold.by) {
    hold.by->impulse = sbri_add_scaled(hold.by->impulse, push, -s / rule->step_s);
    hold.by->moment = sbri_add_scaled(hold.by->moment, turn, -s / rule->step_s);
  }
  if (shared) sbri_volume_apply_to_pinned(t, body, faces, s / rule->step_s, rule->step_s);
  sbri_wide rate = sbri_wide_all(1 / rule->step_s);
  for (uint32_t slot = body->slot_begin; slot < body->slot_end; slot += SBRI_LANES) {
    float *velocity = sbri_triple(t->velocities, slot);
    sbri_wide3 g = sbri_wide_load_points(t->velocity_points + slot), v = sbri_load3(velocity);
    sbri_wide3 from = sbri_wide_load_points(t->positions + slot);
    sbri_wide k = sbri_wide_all(s) * sbri_wide_load(t->island->inverse_masses + slot);
    g.x = k * g.x, g.y = k * g.y, g.z = k * g.z;
    sbri_wide3 to = {from.x + g.x, from.y + g.y, from.z + g.z};
    v.x = v.x + rate * g.x, v.y = v.y + rate * g.y, v.z = v.z + rate * g.z;
    if (t->near_ground[slot / SBRI_BLOCK]) {
      sbri_contact_planes p = sbri_planes_of(t, slot);
      sbri_contact_bound(&p, from, &to, &v, rule, slot);
    }
    sbri_wide_store_points(t->positions + slot, to);
    sbri_store3(velocity, v);
  }
  return missing / rest;
}

/* At the end of a substep of `h` seconds: moves the body's free points along the gradient of the volume, by
 * their inverse masses, until the rest volume is enclosed again, and changes their velocities by as much per
 * second. Momentum is kept with what the held points' bodies take, but for what the ground does. */
static inline void sbri_volume_keep(const sbri_island_tick *t, const sbri_body *body, float h) {
  const sbri_contact_rule rule = sbri_contact_rule_of(t, body, h);
  sbri_soft_contacts_store(t, body);
  float owed = 0;
  for (int i = 0; i < SBRI_MAX_VOLUME_STEPS; i++) {
    float missing = sbri_volume_step(t, body, &rule, &owed);
    if (missing < SBRI_VOLUME_FRACTION_LEFT && -missing < SBRI_VOLUME_FRACTION_LEFT) break;
  }
  sbri_soft_contacts_bound(t, body, &rule);
}

#endif
