/* Position-based with compliance, in small steps: one sweep over all springs and tetrahedra per substep.
 *
 * Points move freely (x + h v). Then each spring in turn moves its ends to where an implicit Euler step of
 * that spring alone would. With w = w_a + w_b the inverse masses of its ends, and C its elongation:
 *
 *     shift along it, times the inverse mass:   (k h^2 C + c h (C - C_before)) / (1 + w (k h^2 + c h))
 *
 * Velocities change by the shifts per second. Nothing is accumulated over sweeps or substeps. (Macklin and
 * others, Small Steps in Physics Simulation, 2019, explain why one sweep of many substeps is better than many
 * sweeps of one.) Springs are visited in colours, eight at a time, then tetrahedra (tetrahedron_sweep.h).
 *
 * A single spring is stable at any step; tetrahedra that share points need substeps that resolve their
 * fastest mode (position_based.c). Bias against the energy, of a mode of frequency w: a damping ratio of w h
 * / 2, and a period longer by (w h)^2 / 3, exactly as by implicit Euler. Springs that share points are too
 * soft at rest by about k/m h^2, since each is solved while the others wait (measured: 0.8 % in a hanging
 * chain whose fastest mode has a phase of 0.19 per substep). A body that rotates at w loses w^2 h of its
 * angular velocity per second.
 *
 * A sweep works on displacements since the beginning of the tick, `moves`, with the inverse mass as the
 * fourth number. These are small, so small corrections are not rounded away, wherever the body is.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_POSITION_BASED_H
#define SBRI_POSITION_BASED_H

#include "soft/solvers/finish.h"
#include "soft/solvers/motion.h"
#include "soft/solvers/tetrahedron_sweep.h"

/* Stores the positions at the beginning of the tick, and the vector of each spring there. */
static inline void sbri_moves_begin(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  memcpy(t->scratch.begins, t->positions, island->slot_count * sizeof *t->scratch.begins);
  for (uint32_t slot = 0; slot < island->slot_count; slot++)
    t->scratch.moves[slot] =
        (sbri_point){0, 0, 0, slot < island->free_count ? island->inverse_masses[slot] : 0};
  for (uint32_t block = 0; block < island->links.block_count; block++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide3 p = sbri_wide_gather(t->scratch.begins, island->links.blocks[block].a + lane);
      sbri_wide3 q = sbri_wide_gather(t->scratch.begins, island->links.blocks[block].b + lane);
      sbri_store3(t->springs.edges + 3 * SBRI_BLOCK * (size_t)block + lane,
          (sbri_wide3){q.x - p.x, q.y - p.y, q.z - p.z});
    }
}

/* Moves pinned points through the tick. */
static inline void sbri_moves_move_pinned(const sbri_island_tick *t, float fraction) {
  for (uint32_t slot = t->island->free_count; slot < t->island->slot_count; slot++) {
    const sbri_point *from = &t->scratch.begins[slot], *to = &t->targets[slot];
    t->scratch.moves[slot] = (sbri_point){
        (to->x - from->x) * fraction, (to->y - from->y) * fraction, (to->z - from->z) * fraction, 0};
  }
}

/* Adds gravity, external forces and damping to the velocities, then adds these to the moves. Stores the moves
 * before the sweep in t->accelerations. */
static inline void sbri_moves_predict(const sbri_island_tick *t, float h, float fraction) {
  static const uint32_t in_order[SBRI_BLOCK] = {0, 1, 2, 3, 4, 5, 6, 7};
  const sbri_island *island = t->island;
  sbri_wide step = sbri_wide_all(h);
  if (t->scratch.external_forces) sbri_compute_external_forces(t, h);
  sbri_decay_all(t, h); /* before gravity, so that a resting body feels its full weight */
  for (uint32_t slot = 0; slot < island->free_count; slot += SBRI_LANES) {
    float *velocity = sbri_triple(t->velocities, slot);
    sbri_wide3 v = sbri_load3(velocity);
    sbri_wide g = sbri_wide_load(island->gravity_scales + slot);
    sbri_wide3 a = {g * sbri_wide_all(t->environment.gravity.x), g * sbri_wide_all(t->environment.gravity.y),
        g * sbri_wide_all(t->environment.gravity.z)};
    if (t->scratch.external_forces) {
      sbri_wide3 f = sbri_wide_load_points(t->scratch.external_forces + slot);
      sbri_wide w = sbri_wide_load(island->inverse_masses + slot);
      a.x = a.x + f.x * w, a.y = a.y + f.y * w, a.z = a.z + f.z * w;
    }
    v.x = v.x + step * a.x, v.y = v.y + step * a.y, v.z = v.z + step * a.z;
    sbri_store3(velocity, v);
    sbri_wide4 u = sbri_wide_gather4(t->scratch.moves + slot, in_order);
    u.x = u.x + step * v.x, u.y = u.y + step * v.y, u.z = u.z + step * v.z;
    sbri_store3(sbri_triple(t->scratch.accelerations, slot), (sbri_wide3){u.x, u.y, u.z});
    sbri_wide_scatter4(t->scratch.moves + slot, in_order, u);
  }
  sbri_moves_move_pinned(t, fraction);
}

/* One sweep over all springs; see soft/solvers/spring_forces.h for the kinds. */
static inline void sbri_sweep_springs(const sbri_island_tick *t, float h, int kind, float *stretches) {
  const sbri_island *island = t->island;
  const bool damped = kind & SBRI_DAMPED, track = kind & SBRI_TRACKED, flowing = kind & SBRI_FLOWING;
  sbri_wide one = sbri_wide_all(1), square_step = sbri_wide_all(h * h), step = sbri_wide_all(h);
  for (uint32_t block = 0; block < island->links.block_count; block++) {
    const sbri_link_block *link = &island->links.blocks[block];
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide4 p = sbri_wide_gather4(t->scratch.moves, link->a + lane),
                 q = sbri_wide_gather4(t->scratch.moves, link->b + lane);
      sbri_wide3 edge = sbri_load3(t->springs.edges + 3 * SBRI_BLOCK * (size_t)block + lane);
      sbri_wide x = edge.x + (q.x - p.x), y = edge.y + (q.y - p.y), z = edge.z + (q.z - p.z);
      sbri_wide length = sbri_wide_sqrt(x * x + y * y + z * z + sbri_wide_all(SBRI_LENGTH_FLOOR));
      sbri_wide k = sbri_wide_load(link->stiffness + lane), strength = one;
      sbri_wide rest = sbri_wide_load((flowing ? t->springs.rests + block * SBRI_BLOCK : link->rest) + lane);
      if (flowing) strength = sbri_wide_load(t->springs.strengths + block * SBRI_BLOCK + lane);
      if (flowing) k = k * strength;
      sbri_wide elongation = length - rest;
      if (damped && island->links.slack) {
        sbri_wide slack = sbri_wide_load(island->links.slack + block * SBRI_BLOCK + lane);
        k = k - sbri_wide_select(elongation < sbri_wide_all(0), k * slack, sbri_wide_all(0));
      }
      sbri_wide stiffness = k * square_step, pull = stiffness * elongation;
      if (damped) {
        sbri_wide3 a = sbri_wide_gather(t->positions, link->a + lane);
        sbri_wide3 b = sbri_wide_gather(t->positions, link->b + lane);
        sbri_wide ox = b.x - a.x, oy = b.y - a.y, oz = b.z - a.z;
        sbri_wide before = sbri_wide_sqrt(ox * ox + oy * oy + oz * oz + sbri_wide_all(SBRI_LENGTH_FLOOR));
        sbri_wide damping =
            sbri_wide_load(island->links.damping + block * SBRI_BLOCK + lane) * strength * step;
        pull = pull + damping * (length - before);
        stiffness = stiffness + damping;
      }
      if (track) {
        float *at = stretches + lane;
        sbri_wide fraction = elongation / length, old = sbri_wide_load(at), zero = sbri_wide_all(0);
        sbri_wide_store(at, sbri_wide_select((k > zero) & (rest > zero), sbri_wide_max(fraction, old), old));
      }
      sbri_wide s = pull / ((one + (p.w + q.w) * stiffness) * length), a = s * p.w, b = s * q.w;
      p.x = p.x + a * x, p.y = p.y + a * y, p.z = p.z + a * z;
      q.x = q.x - b * x, q.y = q.y - b * y, q.z = q.z - b * z;
      sbri_wide_scatter4(t->scratch.moves, link->a + lane, p);
      sbri_wide_scatter4(t->scratch.moves, link->b + lane, q);
    }
  }
}

/* Lanes in which two triples differ. */
static inline sbri_mask sbri_differ(sbri_wide3 a, sbri_wide3 b) {
  return (a.x != b.x) | (a.y != b.y) | (a.z != b.z);
}

/* sbri_moves_end_body for a body with an embedded surface that may be in contact. Its contacts need all
 * velocities at once, at the positions before the substep. */
static inline void sbri_moves_end_embedded(const sbri_island_tick *t, const sbri_body *body, float h) {
  static const uint32_t in_order[SBRI_BLOCK] = {0, 1, 2, 3, 4, 5, 6, 7};
  sbri_wide rate = sbri_wide_all(1 / h), step = sbri_wide_all(h);
  const sbri_contact_rule rule = sbri_contact_rule_of(t, body, h);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    sbri_wide3 free = sbri_load3(sbri_const_triple(t->scratch.accelerations, slot));
    sbri_wide3 v = sbri_load3(sbri_const_triple(t->velocities, slot));
    sbri_wide4 u = sbri_wide_gather4(t->scratch.moves + slot, in_order);
    v.x = v.x + (u.x - free.x) * rate, v.y = v.y + (u.y - free.y) * rate, v.z = v.z + (u.z - free.z) * rate;
    sbri_store3(sbri_triple(t->velocities, slot), v);
  }
  sbri_apply_impulses(t, body, t->velocities, &rule);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    sbri_wide3 v = sbri_load3(sbri_const_triple(t->velocities, slot));
    sbri_wide3 x = sbri_wide_load_points(t->positions + slot),
               begin = sbri_wide_load_points(t->scratch.begins + slot);
    sbri_wide4 u = sbri_wide_gather4(t->scratch.moves + slot, in_order);
    if (t->contacts.near_ground[slot / SBRI_BLOCK]) {
      sbri_contact_move(
          &x, &v, t->contacts.planes + 4 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK, &rule, slot);
      sbri_store3(sbri_triple(t->velocities, slot), v);
    } else {
      x.x = x.x + step * v.x, x.y = x.y + step * v.y, x.z = x.z + step * v.z;
    }
    u.x = x.x - begin.x, u.y = x.y - begin.y, u.z = x.z - begin.z;
    sbri_wide_scatter4(t->scratch.moves + slot, in_order, u);
    sbri_wide_store_points(t->positions + slot, x);
  }
}

/* Adds the displacements of the sweep to the velocities, bounds both by the ground, and updates positions. */
static inline void sbri_moves_end_body(const sbri_island_tick *t, const sbri_body *body, float h) {
  static const uint32_t in_order[SBRI_BLOCK] = {0, 1, 2, 3, 4, 5, 6, 7};
  sbri_wide rate = sbri_wide_all(1 / h), step = sbri_wide_all(h);
  const sbri_contact_rule rule = sbri_contact_rule_of(t, body, h);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    float *velocity = sbri_triple(t->velocities, slot);
    sbri_wide3 free = sbri_load3(sbri_const_triple(t->scratch.accelerations, slot)), v = sbri_load3(velocity);
    sbri_wide3 begin = sbri_wide_load_points(t->scratch.begins + slot);
    sbri_wide4 u = sbri_wide_gather4(t->scratch.moves + slot, in_order);
    v.x = v.x + (u.x - free.x) * rate, v.y = v.y + (u.y - free.y) * rate, v.z = v.z + (u.z - free.z) * rate;
    if (t->contacts.near_ground[block]) {
      sbri_wide3 x = sbri_wide_load_points(t->positions + slot), w = v, on = x;
      sbri_contact_move(&x, &w, t->contacts.planes + 4 * (block * SBRI_BLOCK) + lane, &rule, slot);
      on.x = on.x + step * w.x, on.y = on.y + step * w.y, on.z = on.z + step * w.z;
      sbri_mask touched = sbri_differ(v, w) | sbri_differ(x, on);
      u.x = sbri_wide_select(touched, x.x - begin.x, u.x);
      u.y = sbri_wide_select(touched, x.y - begin.y, u.y);
      u.z = sbri_wide_select(touched, x.z - begin.z, u.z);
      v = w;
    }
    sbri_store3(velocity, v);
    sbri_wide_scatter4(t->scratch.moves + slot, in_order, u);
    sbri_wide_store_points(t->positions + slot, (sbri_wide3){begin.x + u.x, begin.y + u.y, begin.z + u.z});
  }
}

/* Whether nothing reads or changes positions between substeps. Then the end of a substep and the beginning of
 * the next are one pass over the points, and positions stay at the beginning of the tick. */
static inline bool sbri_moves_alone(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  bool alone = !t->scratch.external_forces && !t->springs.rests && !t->reactions && !island->links.limits &&
               !island->tetrahedra.limits && !island->links.damping && !island->tetrahedra.damping &&
               !sbri_is_compressed(t);
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[island->bodies[b]];
    alone = alone && !body->volume.is_preserved && (body->is_pinned || !(body->damping.alpha_1_s > 0)) &&
            !sbri_has_impulses(t, body);
  }
  for (uint32_t block = 0; block < island->free_count / SBRI_BLOCK; block++)
    alone = alone && !t->contacts.near_ground[block];
  return alone;
}

/* The same as sbri_moves_end_body and sbri_moves_predict, bit for bit, except that positions are not updated.
 */
static inline void sbri_moves_advance(const sbri_island_tick *t, const sbri_body *body, float h) {
  static const uint32_t in_order[SBRI_BLOCK] = {0, 1, 2, 3, 4, 5, 6, 7};
  sbri_wide rate = sbri_wide_all(1 / h), step = sbri_wide_all(h);
  sbri_wide gx = sbri_wide_all(t->environment.gravity.x), gy = sbri_wide_all(t->environment.gravity.y),
            gz = sbri_wide_all(t->environment.gravity.z);
  sbri_decay decay = sbri_decay_of(body, h);
  bool is_to_driver = sbri_is_damped_to_driver(t, body, decay);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    float *velocity = sbri_triple(t->velocities, slot),
          *unswept = sbri_triple(t->scratch.accelerations, slot);
    sbri_wide3 free = sbri_load3(unswept), v = sbri_load3(velocity);
    sbri_wide4 u = sbri_wide_gather4(t->scratch.moves + slot, in_order);
    v.x = v.x + (u.x - free.x) * rate, v.y = v.y + (u.y - free.y) * rate, v.z = v.z + (u.z - free.z) * rate;
    if (is_to_driver || decay.media < 1) v = sbri_decayed(t, slot, v, decay, is_to_driver);
    sbri_wide g = sbri_wide_load(t->island->gravity_scales + slot);
    v.x = v.x + step * (g * gx), v.y = v.y + step * (g * gy), v.z = v.z + step * (g * gz);
    sbri_store3(velocity, v);
    u.x = u.x + step * v.x, u.y = u.y + step * v.y, u.z = u.z + step * v.z;
    sbri_store3(unswept, (sbri_wide3){u.x, u.y, u.z});
    sbri_wide_scatter4(t->scratch.moves + slot, in_order, u);
  }
}

/* Adds the corrections of volumes and limits to the moves. */
static inline void sbri_moves_follow(const sbri_island_tick *t) {
  for (uint32_t slot = 0; slot < t->island->free_count; slot++) {
    const sbri_point *x = &t->positions[slot], *from = &t->scratch.begins[slot];
    sbri_point *u = &t->scratch.moves[slot];
    u->x += x->x - (from->x + u->x), u->y += x->y - (from->y + u->y), u->z += x->z - (from->z + u->z);
  }
}

/* Strained tetrahedra are stiffer than at rest, and a sweep must resolve those too. */
static inline uint32_t sbri_position_substeps_now(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  uint32_t at_rest = sbri_position_substeps(island, t->tick_s);
  if (island->stepping.substeps || island->tetrahedra.block_count == 0) return at_rest;
  uint32_t now =
      sbri_stable_substeps(island, sbri_stiffened_time(t, t->tick_s), island->springs.rest_stretch);
  now = now < SBRI_MAX_SUBSTEPS ? now : SBRI_MAX_SUBSTEPS;
  if (!sbri_has_fixed_substeps(t)) now = sbri_substeps_with_impact(t, t->tick_s, now, SBRI_MAX_SUBSTEPS);
  return now > at_rest ? now : at_rest;
}

static inline void sbri_lanes_position_based_tick(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  uint32_t substeps = sbri_position_substeps_now(t);
  float h = t->tick_s / (float)substeps, stretches[SBRI_BLOCK] = {0};
  bool followed = island->links.limits || island->tetrahedra.limits;
  for (uint32_t b = 0; b < island->body_count; b++)
    followed = followed || t->model->bodies[island->bodies[b]].volume.is_preserved;
  sbri_moves_begin(t);
  sbri_mark_all_compressed(t);
  bool solid = island->tetrahedra.block_count > 0, alone = sbri_moves_alone(t);
  if (solid) sbri_solid_edges_begin(t);
  for (uint32_t s = 0; s < substeps; s++) {
    bool last = s + 1 == substeps;
    float fraction = last ? 1 : (float)(s + 1) / (float)substeps;
    if (alone && s > 0)
      sbri_moves_move_pinned(t, fraction);
    else
      sbri_moves_predict(t, h, fraction);
#define SBRI_CALL(known) sbri_sweep_springs(t, h, known, stretches)
    SBRI_FOR_FORCE_KIND(sbri_force_kind(t, last), SBRI_CALL)
#undef SBRI_CALL
    if (solid) sbri_sweep_tetrahedra(t, h, s % 2 != 0);
    for (uint32_t b = 0; b < island->body_count; b++) {
      const sbri_body *body = &t->model->bodies[island->bodies[b]];
      if (alone && !last)
        sbri_moves_advance(t, body, h);
      else if (sbri_has_impulses(t, body))
        sbri_moves_end_embedded(t, body, h);
      else
        sbri_moves_end_body(t, body, h);
    }
    sbri_move_pinned(t, fraction);
    if (solid && !alone && s % SBRI_CHECK_INTERVAL == 0) sbri_update_compression(t);
    sbri_count_element_visits(t, 1);
    sbri_finish_substep(t, h);
    if (t->reactions) sbri_react_at_end(t, h);
    if ((followed || sbri_is_compressed(t)) && !last) sbri_moves_follow(t);
  }
  sbri_store_stretch(t, stretches);
  if (solid) sbri_tetrahedron_pass(t, true);
}

#endif
