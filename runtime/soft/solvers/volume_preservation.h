/* Volume preservation within a body's surface, for pressure mode `volume`.
 *
 * The constraint V(x) = V0, by Newton steps at the end of a substep: dx_i = s w_i g_i with g the gradient of
 * the volume, w the inverse masses and s = (V0 - V) / sum w_i |g_i|^2 (Hong, Jung, Choi and Welch, Fast
 * Volume Preservation for a Mass-Spring System, 2006, use the same multiplier). The constraint exerts any
 * pressure that it needs, without the additional substeps of a bulk modulus. The error of a step is of second
 * order: one is enough except where a body strikes the ground.
 *
 * Pinned points do not move, but the simulated rigid bodies that they are pinned to get the reaction and move
 * in proportion to their inverse mass (pinned_impulse.h); their motion restores the corresponding part of the
 * volume. If all pinned points, or all points of the surface, belong to one rigid body, it gets the opposite
 * of the free points' linear and angular momentum. Several rigid bodies could not divide that; then the
 * gradient at the beginning of the substep is used, for which the pinned points' parts add up to it (SHAKE).
 *
 * Points on the ground cannot move below it. They count in the sum with the part of their gradient along the
 * ground or away from it; the ground takes the normal part, with friction.
 *
 * Bias against the energy: none in the volume; the multiplier acts along the gradient at the end of the
 * substep instead of its beginning, which is of first order in h.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_VOLUME_PRESERVATION_H
#define SBRI_VOLUME_PRESERVATION_H

#include "math/lane_sums.h"
#include "skin/skin_lanes.h"
#include "soft/solvers/motion.h"
#include "soft/solvers/pinned_impulse.h"

/* Maximum fraction of the volume that is restored in a step: an inverted body recovers slowly. */
#define SBRI_MAX_VOLUME_FRACTION 0.1f

/* A further step in a substep follows if the last one corrected more than this fraction of the volume. The
 * remaining error is about its square. */
enum { SBRI_MAX_VOLUME_STEPS = 4 };
#define SBRI_VOLUME_FRACTION_LEFT 0.01f

/* Separation below which a point rests on the ground, m. */
#define SBRI_RESTING_M 1e-5f

/* Removes the part of the gradients that points into the ground, for lanes that rest on it. `sign` is that of
 * the multiplier. */
static inline sbri_wide3 sbri_volume_project_gradient(
    const sbri_island_tick *t, uint32_t slot, sbri_wide3 g, float sign) {
  sbri_contact_planes p = sbri_planes_of(t, slot);
  sbri_wide gap = sbri_planes_gap(&p, sbri_wide_load_points(t->positions + slot));
  sbri_wide normal_part = sbri_planes_along(&p, g), zero = sbri_wide_all(0);
  sbri_mask rests = gap <= sbri_wide_all(SBRI_RESTING_M),
            points_in = normal_part * sbri_wide_all(sign) < zero;
  normal_part = sbri_wide_select(rests & points_in, normal_part, zero);
  return (sbri_wide3){
      g.x - normal_part * p.normal.x, g.y - normal_part * p.normal.y, g.z - normal_part * p.normal.z};
}

/* Positions `h` seconds ago, by the present positions and velocities. */
static inline sbri_wide3 sbri_positions_before(const sbri_island_tick *t, uint32_t slot, float h) {
  sbri_wide3 x = sbri_wide_load_points(t->positions + slot);
  sbri_wide3 v = sbri_load3(sbri_const_triple(t->velocities, slot));
  sbri_wide step = sbri_wide_all(h);
  return (sbri_wide3){x.x - step * v.x, x.y - step * v.y, x.z - step * v.z};
}

/* Sums for the reaction on one rigid body: gradients of the free points and their moments about the body, at
 * the positions at the beginning of the substep. */
typedef struct sbri_volume_reaction {
  sbri_reaction *rigid_body; /* NULL: several rigid bodies, or not simulated */
  float h;
  sbri_lane_sums sums;
} sbri_volume_reaction;

/* Gradients of the volume at the body's slots, and the sum of w |g|^2 over the part that may move by a
 * multiplier of that sign. */
static inline float sbri_volume_gradients(const sbri_island_tick *t, const sbri_body *body,
    const sbri_point *faces, float sign, sbri_volume_reaction *reaction) {
  float lanes[SBRI_BLOCK] = {0};
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    uint32_t lane = slot % SBRI_BLOCK, block = (slot - body->slots.begin) / SBRI_BLOCK;
    sbri_wide3 g = {sbri_wide_all(0), sbri_wide_all(0), sbri_wide_all(0)};
    for (uint32_t c = body->volume.begins[block]; c < body->volume.begins[block + 1]; c++) {
      const sbri_volume_cell *cell = &body->volume.cells[c];
      sbri_wide3 n = sbri_wide_gather(faces, cell->slots + lane);
      sbri_wide w = sbri_wide_load(cell->weights + lane);
      g.x = g.x + w * n.x;
      g.y = g.y + w * n.y;
      g.z = g.z + w * n.z;
    }
    sbri_wide_store_points(t->scratch.velocity_points + slot, g);
    if (reaction->rigid_body) {
      const sbf_vec3 *o = &reaction->rigid_body->about;
      sbri_wide3 r = sbri_positions_before(t, slot, reaction->h);
      r.x = r.x - sbri_wide_all(o->x), r.y = r.y - sbri_wide_all(o->y), r.z = r.z - sbri_wide_all(o->z);
      sbri_lane_sums_add(&reaction->sums, lane, r, g);
    }
    if (t->contacts.near_ground[slot / SBRI_BLOCK]) g = sbri_volume_project_gradient(t, slot, g, sign);
    sbri_wide w = sbri_wide_load(t->island->inverse_masses + slot);
    sbri_wide_store(lanes + lane, sbri_wide_load(lanes + lane) + w * (g.x * g.x + g.y * g.y + g.z * g.z));
  }
  return sbri_tree_sum(lanes);
}

static inline sbf_vec3 sbri_pinned_gradient(const sbri_point *faces, const sbri_face_weight *face_weight) {
  const sbri_point *n = &faces[face_weight->face];
  return sbri_scale(sbri_vec3(n->x, n->y, n->z), face_weight->weight);
}

/* Whether the body is pinned to several rigid bodies, at least one of them simulated. */
static inline bool sbri_volume_is_shared(const sbri_island_tick *t, const sbri_body *body) {
  if (!t->reactions || body->volume.attachment >= 0) return false;
  for (uint32_t k = 0; k < t->island->pins.attachment_count; k++)
    if (t->reactions[t->island->pins.attachments[k]].inverse_mass > 0) return true;
  return false;
}

static inline float sbri_reaction_inverse_mass(const sbri_reaction *r, sbf_vec3 linear, sbf_vec3 angular) {
  return r->inverse_mass * sbri_dot(linear, linear) + r->inverse_inertia * sbri_dot(angular, angular);
}

/* Contribution of the simulated bodies of pinned points to that sum. */
static inline float sbri_volume_pinned_inverse_mass(
    const sbri_island_tick *t, const sbri_body *body, const sbri_point *faces) {
  float sum = 0;
  for (uint32_t k = 0; k < t->island->pins.attachment_count; k++) {
    const sbri_reaction *r = &t->reactions[t->island->pins.attachments[k]];
    sbf_vec3 linear = {0, 0, 0}, angular = {0, 0, 0};
    for (uint32_t i = 0; r->inverse_mass > 0 && i < body->volume.pinned_weight_count; i++) {
      const sbri_face_weight *face_weight = &body->volume.pinned_weights[i];
      if (sbri_reaction_at(t, face_weight->slot) != r) continue;
      sbf_vec3 g = sbri_pinned_gradient(faces, face_weight);
      linear = sbri_add(linear, g);
      angular = sbri_add(angular, sbri_cross(sbri_reaction_arm(t, r, face_weight->slot), g));
    }
    sum += sbri_reaction_inverse_mass(r, linear, angular);
  }
  return sum;
}

/* Applies the impulses to pinned points, at their positions at the beginning of the substep. */
static inline void sbri_volume_apply_to_pinned(
    const sbri_island_tick *t, const sbri_body *body, const sbri_point *faces, float impulse, float h) {
  for (uint32_t i = 0; i < body->volume.pinned_weight_count; i++) {
    const sbri_face_weight *face_weight = &body->volume.pinned_weights[i];
    sbri_reaction *r = sbri_reaction_at(t, face_weight->slot);
    sbf_vec3 point_impulse = sbri_scale(sbri_pinned_gradient(faces, face_weight), impulse);
    if (!r) continue;
    sbri_pinned_apply_impulse(t, face_weight->slot, point_impulse);
    sbf_vec3 displacement = sbri_scale(sbri_slot_velocity(t, t->velocities, face_weight->slot), h);
    r->moment = sbri_sub(r->moment, sbri_cross(displacement, point_impulse));
  }
}

/* Volume within the surface of the points. Also writes twice the area vectors of its faces. */
static inline float sbri_volume_enclosed(
    const sbri_island_tick *t, const sbri_body *body, const sbri_point *points, sbri_point *faces) {
  const sbri_skin *skin = &body->surface.skin;
  const sbri_point *vertices = points;
  const sbri_face_block *face_blocks = body->volume.faces;
  if (!face_blocks) {
    vertices = t->surfaces.vertices + body->surface.first_vertex;
    face_blocks = skin->faces;
    sbri_lanes_compute_vertices(
        skin, points - t->island->first_slot, t->surfaces.vertices + body->surface.first_vertex);
  }
  return sbri_lanes_volume(face_blocks, skin->face_block_count, vertices, faces);
}

/* Faces at the beginning of the substep, by the present positions and velocities. A correction that changes
 * both consistently does not change them. */
static inline void sbri_compute_volume_faces_before(
    const sbri_island_tick *t, const sbri_body *body, sbri_point *faces, float h) {
  sbri_point *before = t->scratch.element_forces; /* scratch that is unused here */
  for (uint32_t slot = 0; slot < t->island->free_count; slot += SBRI_LANES)
    sbri_wide_store_points(before + slot, sbri_positions_before(t, slot, h));
  for (uint32_t slot = t->island->free_count; slot < t->island->slot_count; slot++) {
    const sbri_point *x = &t->positions[slot];
    sbf_vec3 v = sbri_slot_velocity(t, t->velocities, slot);
    before[slot] = (sbri_point){x->x - h * v.x, x->y - h * v.y, x->z - h * v.z, 0};
  }
  (void)sbri_volume_enclosed(t, body, before, faces);
}

/* One step at the end of a substep; returns the fraction of the volume that was missing before it. `owed`:
 * volume that simulated bodies will restore, by the impulses of earlier steps. */
static inline float sbri_volume_step(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule, float *owed) {
  sbri_point *faces = t->surfaces.faces + body->surface.first_face;
  float rest = (float)body->surface.rest_volume_m3, max = SBRI_MAX_VOLUME_FRACTION * rest;
  float missing = rest - sbri_volume_enclosed(t, body, t->positions, faces) - *owed;
  const bool shared = sbri_volume_is_shared(t, body);
  if (shared) sbri_compute_volume_faces_before(t, body, faces, rule->step_s);
  sbri_reaction *rigid_body =
      t->reactions && body->volume.attachment >= 0 ? &t->reactions[body->volume.attachment] : NULL;
  sbri_volume_reaction reaction;
  reaction.rigid_body = rigid_body && rigid_body->inverse_mass > 0 ? rigid_body : NULL,
  reaction.h = rule->step_s;
  if (reaction.rigid_body) memset(&reaction.sums, 0, sizeof reaction.sums);
  float sum = sbri_volume_gradients(t, body, faces, missing, &reaction), pinned_sum = 0;
  sbf_vec3 linear = {0, 0, 0}, angular = {0, 0, 0};
  if (reaction.rigid_body)
    linear = sbri_lanes_force(&reaction.sums), angular = sbri_lanes_moment(&reaction.sums);
  if (reaction.rigid_body && body->volume.pinned_weight_count > 0)
    pinned_sum = sbri_reaction_inverse_mass(reaction.rigid_body, linear, angular);
  if (shared) pinned_sum = sbri_volume_pinned_inverse_mass(t, body, faces);
  if (!(sum > 0) || !(missing - missing == 0)) return 0;
  float s = (missing > max ? max : missing < -max ? -max : missing) / (sum + pinned_sum);
  *owed += s * pinned_sum;
  if (reaction.rigid_body) {
    reaction.rigid_body->impulse = sbri_add_scaled(reaction.rigid_body->impulse, linear, -s / rule->step_s);
    reaction.rigid_body->moment = sbri_add_scaled(reaction.rigid_body->moment, angular, -s / rule->step_s);
  }
  if (shared) sbri_volume_apply_to_pinned(t, body, faces, s / rule->step_s, rule->step_s);
  sbri_wide rate = sbri_wide_all(1 / rule->step_s);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    float *velocity = sbri_triple(t->velocities, slot);
    sbri_wide3 g = sbri_wide_load_points(t->scratch.velocity_points + slot), v = sbri_load3(velocity);
    sbri_wide3 from = sbri_wide_load_points(t->positions + slot);
    sbri_wide k = sbri_wide_all(s) * sbri_wide_load(t->island->inverse_masses + slot);
    g.x = k * g.x, g.y = k * g.y, g.z = k * g.z;
    sbri_wide3 to = {from.x + g.x, from.y + g.y, from.z + g.z};
    v.x = v.x + rate * g.x, v.y = v.y + rate * g.y, v.z = v.z + rate * g.z;
    if (t->contacts.near_ground[slot / SBRI_BLOCK]) {
      sbri_contact_planes p = sbri_planes_of(t, slot);
      sbri_contact_bound(&p, from, &to, &v, rule, slot);
    }
    sbri_wide_store_points(t->positions + slot, to);
    sbri_store3(velocity, v);
  }
  return missing / rest;
}

/* Volume preservation at the end of a substep of `h` seconds: moves the body's free points along the gradient
 * of the volume, weighted by their inverse masses, until the rest volume is restored, and changes their
 * velocities accordingly. Momentum is conserved together with the pinned rigid bodies, except for the
 * ground's part. */
static inline void sbri_volume_preserve(const sbri_island_tick *t, const sbri_body *body, float h) {
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
