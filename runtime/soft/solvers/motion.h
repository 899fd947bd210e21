/* Building blocks of the time integrators: forces and damping change velocities (kick, decay), velocities
 * change positions above the ground (drift), and pinned points follow their pins.
 *
 * Damping acts on a point's velocity relative to its frame: the pin frame, or the mean rigid motion of a body
 * without pins. It slows neither a fall nor a walk. It is the exact decay exp(-alpha h). Damping of springs
 * is a force from the velocities before the substep.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_MOTION_H
#define SBRI_MOTION_H

#include <string.h>

#include "contact/contact.h"
#include "math/trig.h"
#include "soft/solvers/contact_lanes.h"
#include "soft/solvers/divided_forces.h"
#include "soft/solvers/external_forces.h"
#include "soft/solvers/loads.h"
#include "soft/solvers/reaction.h"
#include "soft/solvers/region_forces.h"
#include "soft/solvers/rigid_motion.h"
#include "soft/solvers/scheme.h"
#include "soft/solvers/soft_contacts.h"
#include "soft/solvers/spring_forces.h"
#include "soft/solvers/tetrahedron_forces.h"

/* Maximum speed at which penetration is resolved, and the minimum speed of a contact that bounces. */
#define SBRI_PUSH_M_S 2.0f
#define SBRI_BOUNCE_FROM_M_S 0.05f
/* Penetration that is tolerated at surface samples, as a fraction of the body's size. Samples that share
 * points press each other in slightly; resolving that would shake the body. */
#define SBRI_SLACK_FRACTION 1e-4f

typedef struct sbri_decay {
  float frame;         /* fraction of the velocity relative to the frame that is left after a substep */
  float media;         /* fraction of the velocity relative to the medium */
  const float *alphas; /* damping per point, 1/s; NULL: uniform. `frame` is then the minimum */
  float h;
} sbri_decay;

static inline sbri_decay sbri_decay_of(const sbri_body *body, float h) {
  return (sbri_decay){body->damping.alpha_1_s > 0 ? sbri_exp(-body->damping.alpha_1_s * h) : 1,
      body->damping.media_friction_1_s > 0 ? sbri_exp(-body->damping.media_friction_1_s * h) : 1,
      body->damping.alphas, h};
}

/* Fraction of the velocity relative to the frame that is left in each lane. */
static inline sbri_wide sbri_kept_fractions(sbri_decay decay, uint32_t slot) {
  float fractions[SBRI_LANES];
  if (!decay.alphas) return sbri_wide_all(decay.frame);
  for (uint32_t lane = 0; lane < SBRI_LANES; lane++)
    fractions[lane] = sbri_exp(-decay.alphas[slot + lane] * decay.h);
  return sbri_wide_load(fractions);
}

/* Damps a body without pins against its own rigid motion, over `time_s` seconds. Moves it by the removed
 * velocity times `ahead_s`. */
static inline void sbri_self_damp(
    const sbri_island_tick *t, const sbri_body *body, float time_s, float ahead_s) {
  float *v = t->velocities;
  if (body->damping.alphas)
    sbri_rigid_motion_damp_each(t->island, body, t->positions, v, body->damping.alphas, time_s, ahead_s);
  else
    sbri_rigid_motion_damp(
        t->island, body, t->positions, v, sbri_exp(-body->damping.alpha_1_s * time_s), ahead_s);
}

/* Whether damping pulls the body's velocities towards those of its pin frames. */
static inline bool sbri_is_damped_to_driver(
    const sbri_island_tick *t, const sbri_body *body, sbri_decay decay) {
  return body->is_pinned && decay.frame < 1 && !t->undamped;
}

/* Damped velocities of a group of lanes. Bodies without pins are damped by sbri_self_damp, which needs all
 * their lanes. */
static inline sbri_wide3 sbri_decayed(
    const sbri_island_tick *t, uint32_t slot, sbri_wide3 v, sbri_decay decay, bool is_to_driver) {
  sbri_wide drifting = sbri_wide_all(decay.media);
  if (is_to_driver) {
    sbri_wide fraction = sbri_kept_fractions(decay, slot);
    sbri_wide3 u = sbri_load3(sbri_const_triple(t->driver_velocities, slot));
    v.x = u.x + (v.x - u.x) * fraction;
    v.y = u.y + (v.y - u.y) * fraction;
    v.z = u.z + (v.z - u.z) * fraction;
  }
  if (decay.media < 1) {
    sbri_wide3 u = {sbri_wide_all(t->environment.wind.x), sbri_wide_all(t->environment.wind.y),
        sbri_wide_all(t->environment.wind.z)};
    sbri_mask real = sbri_wide_load(t->island->inverse_masses + slot) > sbri_wide_all(0);
    v.x = sbri_wide_select(real, u.x + (v.x - u.x) * drifting, v.x);
    v.y = sbri_wide_select(real, u.y + (v.y - u.y) * drifting, v.y);
    v.z = sbri_wide_select(real, u.z + (v.z - u.z) * drifting, v.z);
  }
  return v;
}

/* Slots from `begin` to `end` of a body. */
typedef struct sbri_slot_range {
  const sbri_body *body;
  uint32_t begin, end;
} sbri_slot_range;

static inline sbri_slot_range sbri_slots_of(const sbri_body *body) {
  return (sbri_slot_range){body, body->slots.begin, body->slots.end};
}

/* Minimum number of slots of a task. Fewer slots take less time than starting a task. */
enum { SBRI_TASK_SLOTS = 2048 };

/* Number of tasks among which loops over the body's slots are divided. */
static inline uint32_t sbri_count_slot_tasks(const sbri_island_tick *t, const sbri_body *body) {
  uint32_t count = t->tasks ? (body->slots.end - body->slots.begin) / SBRI_TASK_SLOTS : 1;
  return count < 1 ? 1 : count < SBRI_MAX_PARTS ? count : SBRI_MAX_PARTS;
}

/* Slots of task `index` of `count`: whole blocks. */
static inline sbri_slot_range sbri_slots_of_task(const sbri_body *body, uint32_t index, uint32_t count) {
  uint64_t blocks = (body->slots.end - body->slots.begin) / SBRI_BLOCK;
  return (sbri_slot_range){body, body->slots.begin + (uint32_t)(blocks * index / count) * SBRI_BLOCK,
      body->slots.begin + (uint32_t)(blocks * (index + 1) / count) * SBRI_BLOCK};
}

/* v += h a(x), then damping. `spring_sums`, if not NULL, receives the sums of the spring forces. */
SBRI_INLINE void sbri_kick_slots(const sbri_island_tick *t, sbri_slot_range range, float h, sbri_decay decay,
    int kind, float *stretches, sbri_spring_sums *spring_sums) {
  sbri_wide step = sbri_wide_all(h);
  bool is_to_driver = sbri_is_damped_to_driver(t, range.body, decay);
  for (uint32_t slot = range.begin; slot < range.end; slot += SBRI_LANES) {
    float *velocity = sbri_triple(t->velocities, slot);
    sbri_wide3 x = sbri_wide_load_points(t->positions + slot), v = sbri_load3(velocity);
    sbri_wide3 a = sbri_acceleration(t, slot, x, kind, stretches);
    if (spring_sums) sbri_add_spring_forces(t, slot, x, a, spring_sums);
    v.x = v.x + step * a.x;
    v.y = v.y + step * a.y;
    v.z = v.z + step * a.z;
    sbri_store3(velocity, sbri_decayed(t, slot, v, decay, is_to_driver));
  }
}

static inline sbri_contact_rule sbri_contact_rule_of(
    const sbri_island_tick *t, const sbri_body *body, float h) {
  float slack = body->contact.samples ? SBRI_SLACK_FRACTION * body->rest_size_m : 0;
  return (sbri_contact_rule){body->contact.friction, body->contact.restitution, body->contact.frictions, h,
      SBRI_PUSH_M_S * h, slack, SBRI_BOUNCE_FROM_M_S, t->contacts.pressing};
}

/* x += h v for these slots, above the ground planes. */
static inline void sbri_drift_slots(const sbri_island_tick *t, sbri_slot_range range, float h) {
  sbri_wide step = sbri_wide_all(h);
  const sbri_contact_rule rule = sbri_contact_rule_of(t, range.body, h);
  for (uint32_t slot = range.begin; slot < range.end; slot += SBRI_LANES) {
    uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    float *velocity = sbri_triple(t->velocities, slot);
    sbri_wide3 x = sbri_wide_load_points(t->positions + slot), v = sbri_load3(velocity);
    if (t->contacts.near_ground[block]) {
      sbri_contact_move(&x, &v, t->contacts.planes + 4 * (block * SBRI_BLOCK) + lane, &rule, slot);
      sbri_store3(velocity, v);
    } else {
      x.x = x.x + step * v.x;
      x.y = x.y + step * v.y;
      x.z = x.z + step * v.z;
    }
    sbri_wide_store_points(t->positions + slot, x);
  }
}

/* Number of substeps after which a body without pins is damped once, for all of them. Computing the rigid
 * motion takes a seventh of the time of a substep of tetrahedra. The common damping changes the decay by a
 * fraction of alpha h. */
enum { SBRI_SELF_DAMP_EVERY = 4 };

/* Whether loads or contacts act on the body, which need all its velocities at once. */
static inline bool sbri_has_impulses(const sbri_island_tick *t, const sbri_body *body) {
  return sbri_soft_contact_count(t, body) > 0 || sbri_is_loaded(t, body);
}

/* A task that changes the velocities of its slots. */
typedef struct sbri_kick_work {
  const sbri_island_tick *tick;
  const sbri_body *body;
  float h;
  int kind;
  bool are_forces_divided, drifts;
  uint32_t task_count;
  float stretches[SBRI_MAX_PARTS][SBRI_BLOCK];
} sbri_kick_work;

static inline void sbri_kick_task(void *context, uint32_t index) {
  sbri_kick_work *w = context;
  const sbri_island_tick *t = w->tick;
  sbri_slot_range range = sbri_slots_of_task(w->body, index, w->task_count);
  sbri_decay decay = sbri_decay_of(w->body, w->h);
  float *stretches = w->stretches[index];
  if (w->are_forces_divided) sbri_join_forces(t, range.begin, range.end);
#define SBRI_CALL(force_kind) sbri_kick_slots(t, range, w->h, decay, force_kind, stretches, NULL)
  SBRI_FOR_FORCE_KIND(w->kind, SBRI_CALL)
#undef SBRI_CALL
  if (w->are_forces_divided) sbri_clear_forces(t, range.begin, range.end);
  if (w->drifts) sbri_drift_slots(t, range, w->h);
}

/* sbri_kick_slots for a body by several tasks. */
static inline void sbri_kick_by_tasks(
    const sbri_island_tick *t, const sbri_body *body, float h, int kind, bool drifts, float *stretches) {
  sbri_kick_work work = {.tick = t,
      .body = body,
      .h = h,
      .kind = kind,
      .are_forces_divided = sbri_are_forces_divided(t),
      .drifts = drifts,
      .task_count = sbri_count_slot_tasks(t, body)};
  for (uint32_t i = 0; i < work.task_count; i++) memcpy(work.stretches[i], stretches, sizeof *work.stretches);
  sbri_run_tasks(t, sbri_kick_task, &work, work.task_count);
  for (uint32_t i = 0; i < work.task_count; i++)
    for (int lane = 0; lane < SBRI_BLOCK; lane++)
      if (work.stretches[i][lane] > stretches[lane]) stretches[lane] = work.stretches[i][lane];
}

/* Whether no operation between the kick and the drift of a substep needs all points. Then each task does
 * both. */
static inline bool sbri_drifts_with_kick(const sbri_island_tick *t, float self_s) {
  const sbri_body *body = &t->model->bodies[t->island->bodies[0]];
  bool is_self_damped = !body->is_pinned && self_s > 0 && body->damping.alpha_1_s > 0;
  return t->tasks && t->island->body_count == 1 && t->island->springs.count == 0 && !is_self_damped &&
         !sbri_has_impulses(t, body);
}

/* v += h a(x), then damping. Bodies without pins are damped for the last `self_s` seconds; 0: not in this
 * substep. A damping of several substeps acts in the middle of the drift, where positions and velocities
 * belong to the same time. Before the drift, it would add energy to modes whose phase over these substeps is
 * a multiple of pi. With `drifts` (sbri_drifts_with_kick), then x += h v as well. */
static inline void sbri_kick(const sbri_island_tick *t, float h, float self_s, bool is_deferred, bool last,
    bool drifts, float *stretches) {
  float ahead_s = is_deferred ? 0.5f * h : 0;
  int kind = sbri_force_kind(t, last);
  if (t->scratch.external_forces) sbri_compute_external_forces(t, h);
  if (t->island->regions.block_count > 0) sbri_compute_region_forces(t);
  sbri_spring_sums sums = {{{0}}, {{0}}},
                   *spring_sums = t->reactions && sbri_are_spring_sums_complete(t) ? &sums : NULL;
  if (t->reactions && !spring_sums) sbri_react(t, h);
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    sbri_decay decay = sbri_decay_of(body, h);
    if (t->tasks && !t->reactions) {
      sbri_kick_by_tasks(t, body, h, kind, drifts, stretches);
    } else {
#define SBRI_CALL(force_kind)                                                                                \
  sbri_kick_slots(t, sbri_slots_of(body), h, decay, force_kind, stretches, spring_sums)
      SBRI_FOR_FORCE_KIND(kind, SBRI_CALL)
#undef SBRI_CALL
    }
    if (!body->is_pinned && self_s > 0 && body->damping.alpha_1_s > 0)
      sbri_self_damp(t, body, self_s, ahead_s);
  }
  if (sbri_are_forces_divided(t)) { /* forces on pinned points, which are not used */
    sbri_join_forces(t, t->island->free_count, t->island->slot_count);
    sbri_clear_forces(t, t->island->free_count, t->island->slot_count);
  }
  if (spring_sums) sbri_apply_spring_reactions(t, spring_sums, h);
}

/* Applies damping only, over h seconds. */
static inline void sbri_decay_all(const sbri_island_tick *t, float h) {
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    sbri_decay decay = sbri_decay_of(body, h);
    bool is_to_driver = sbri_is_damped_to_driver(t, body, decay);
    for (uint32_t slot = body->slots.begin; (is_to_driver || decay.media < 1) && slot < body->slots.end;
         slot += SBRI_LANES) {
      float *velocity = sbri_triple(t->velocities, slot);
      sbri_store3(velocity, sbri_decayed(t, slot, sbri_load3(velocity), decay, is_to_driver));
    }
    if (!body->is_pinned && decay.frame < 1) sbri_self_damp(t, body, h, 0);
  }
}

SBRI_INLINE void sbri_accelerate_body(
    const sbri_island_tick *t, const sbri_body *body, int kind, float *stretches) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    sbri_wide3 x = sbri_wide_load_points(t->positions + slot);
    sbri_store3(sbri_triple(t->scratch.accelerations, slot), sbri_acceleration(t, slot, x, kind, stretches));
  }
}

/* Writes a(x) of all free points to t->accelerations, for a substep of h seconds. */
static inline void sbri_accelerate(const sbri_island_tick *t, float h, float *stretches) {
  int kind = sbri_force_kind(t, stretches != NULL);
  if (t->scratch.external_forces) sbri_compute_external_forces(t, h);
  if (t->island->tetrahedra.block_count > 0) sbri_tetrahedron_pass(t, stretches != NULL);
  if (t->island->regions.block_count > 0) sbri_compute_region_forces(t);
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
#define SBRI_CALL(force_kind) sbri_accelerate_body(t, body, force_kind, stretches)
    SBRI_FOR_FORCE_KIND(kind, SBRI_CALL)
#undef SBRI_CALL
  }
}

/* Ground planes of a group of lanes. */
static inline sbri_contact_planes sbri_planes_of(const sbri_island_tick *t, uint32_t slot) {
  return sbri_planes_load(t->contacts.planes + 4 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK);
}

/* Applies loads of the host and contact impulses to the velocities of the coming substep. */
static inline void sbri_apply_impulses(
    const sbri_island_tick *t, const sbri_body *body, float *velocities, const sbri_contact_rule *rule) {
  if (t->environment.load_count > 0) sbri_loads_apply(t, body, velocities, rule->step_s);
  if (sbri_contact_block_count(t, body))
    sbri_contact_solve(t, body, velocities, rule);
  else
    sbri_soft_contacts_solve(t, body, velocities, rule);
}

/* A task that moves its slots. */
typedef struct sbri_drift_work {
  const sbri_island_tick *tick;
  const sbri_body *body;
  float h;
  uint32_t task_count;
} sbri_drift_work;

static inline void sbri_drift_task(void *context, uint32_t index) {
  const sbri_drift_work *w = context;
  sbri_drift_slots(w->tick, sbri_slots_of_task(w->body, index, w->task_count), w->h);
}

/* x += h v, above the ground planes. */
static inline void sbri_drift(const sbri_island_tick *t, float h) {
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    const sbri_contact_rule rule = sbri_contact_rule_of(t, body, h);
    sbri_drift_work work = {t, body, h, sbri_count_slot_tasks(t, body)};
    sbri_apply_impulses(t, body, t->velocities, &rule);
    sbri_run_tasks(t, sbri_drift_task, &work, work.task_count);
  }
}

/* Stores the positions of pinned points at the beginning of the tick. */
static inline void sbri_store_pinned_begin(const sbri_island_tick *t) {
  size_t pinned = t->island->slot_count - t->island->free_count;
  memcpy(t->scratch.begins + t->island->free_count, t->positions + t->island->free_count,
      pinned * sizeof *t->scratch.begins);
}

/* Moves pinned points to the given fraction of the straight line from their old to their target positions. */
static inline void sbri_move_pinned(const sbri_island_tick *t, float fraction) {
  size_t pinned = t->island->slot_count - t->island->free_count;
  if (fraction >= 1) { /* exact, without rounding */
    memcpy(t->positions + t->island->free_count, t->targets + t->island->free_count,
        pinned * sizeof *t->positions);
    return;
  }
  const float *from = &t->scratch.begins[t->island->free_count].x, *to = &t->targets[t->island->free_count].x;
  float *at = &t->positions[t->island->free_count].x;
  for (size_t i = 0; i < 4 * pinned; i++) at[i] = from[i] + (to[i] - from[i]) * fraction;
}

static inline bool sbri_soft_contacts_any(const sbri_island_tick *t) {
  bool any = false;
  for (uint32_t b = 0; b < t->island->body_count; b++)
    any = any || sbri_soft_contact_count(t, &t->model->bodies[t->island->bodies[b]]) > 0;
  for (uint32_t block = 0; block < t->island->free_count / SBRI_BLOCK; block++)
    any = any || t->contacts.near_ground[block];
  return any;
}

/* Maximum fraction of an element's edge that the fastest point of a body near the ground covers in a substep.
 * It bounds the substep only for impacts at about the speed of sound of the body or faster. Jelly balls of 20
 * to 100 mm dropped from 3 m have inverted elements in 8 of 20 falls without it, in 1 at 0.125, in none at
 * 0.1. The fall then costs a third to a half more. */
static const float sbri_impact_fraction = 0.1f;

/* Maximum speed of a point relative to the mean of its body, plus the speed of that mean, m/s. */
static inline float sbri_impact_speed(const sbri_island_tick *t) {
  float max = 0;
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    sbf_vec3 sum = {0, 0, 0};
    float square = 0;
    if (body->slots.real_end == body->slots.begin) continue;
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
      sum = sbri_add(sum, sbri_slot_velocity(t, t->velocities, slot));
    sbf_vec3 mean = sbri_scale(sum, 1 / (float)(body->slots.real_end - body->slots.begin));
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
      sbf_vec3 relative = sbri_sub(sbri_slot_velocity(t, t->velocities, slot), mean);
      square = fmaxf(square, sbri_dot(relative, relative));
    }
    max = fmaxf(max, sqrtf(square) + sqrtf(sbri_dot(mean, mean)));
  }
  return max;
}

/* Upper bound of sbri_impact_speed by one pass. The mean is at most the greatest speed, and a velocity
 * relative to the mean at most twice that. The last hundredth is for rounding. */
static inline float sbri_impact_speed_bound(const sbri_island_tick *t) {
  sbri_wide square = sbri_wide_all(0);
  float squares[SBRI_LANES], max = 0;
  for (uint32_t slot = 0; slot < t->island->free_count; slot += SBRI_LANES) {
    sbri_wide3 v = sbri_load3(sbri_const_triple(t->velocities, slot));
    square = sbri_wide_max(sbri_wide3_dot(v, v), square);
  }
  sbri_wide_store(squares, square);
  for (int lane = 0; lane < SBRI_LANES; lane++) max = squares[lane] > max ? squares[lane] : max;
  return 3.03f * sqrtf(max);
}

/* Number of substeps in the coming `time_s` seconds in which no point crosses an element when a solid body
 * strikes the ground; 1 if nothing is near the ground. */
static inline float sbri_impact_substeps(const sbri_island_tick *t, float time_s) {
  const sbri_island *island = t->island;
  if (island->tetrahedra.block_count == 0 || !(island->stability.cell_m > 0) || !sbri_soft_contacts_any(t))
    return 1;
  return time_s * sbri_impact_speed(t) / (sbri_impact_fraction * island->stability.cell_m);
}

/* `substeps`, or as many as such an impact needs if that is more; at most `max`. */
static inline uint32_t sbri_substeps_with_impact(
    const sbri_island_tick *t, float time_s, uint32_t substeps, uint32_t max) {
  float cell = sbri_impact_fraction * t->island->stability.cell_m;
  if (!(cell > 0) || !sbri_soft_contacts_any(t)) return substeps;
  if (time_s * sbri_impact_speed_bound(t) <= cell * (float)substeps) return substeps;
  float crossing = ceilf(fminf(sbri_impact_substeps(t, time_s), (float)max));
  return (float)substeps < crossing ? (uint32_t)crossing : substeps;
}

/* Whether rigid bodies or the asset set the substeps. Those already count impacts, and more substeps of the
 * island alone would keep a pair from coming to rest. */
static inline bool sbri_has_fixed_substeps(const sbri_island_tick *t) {
  return t->island->stepping.substeps || t->fraction < 1;
}

/* Number of substeps in the coming `time_s` seconds, for the present stiffness of springs, tetrahedra and
 * gases. Bounded, because a flat gas would need a million; recovery repairs the result. */
static inline uint32_t sbri_substeps_now(const sbri_island_tick *t, float time_s) {
  uint32_t needed = sbri_scheme_substeps(t->island, sbri_stiffened_time(t, time_s), *t->springs.stretch);
  if (!sbri_has_fixed_substeps(t))
    needed = sbri_substeps_with_impact(t, time_s, needed, SBRI_MAX_STRAINED_SUBSTEPS);
  return needed < SBRI_MAX_STRAINED_SUBSTEPS ? needed : SBRI_MAX_STRAINED_SUBSTEPS;
}

/* Stores the maximum over the lanes. */
static inline void sbri_store_stretch(const sbri_island_tick *t, const float stretches[SBRI_BLOCK]) {
  float greatest = 0;
  for (int lane = 0; lane < SBRI_BLOCK; lane++)
    greatest = stretches[lane] > greatest ? stretches[lane] : greatest;
  *t->springs.stretch = greatest;
}

#endif
