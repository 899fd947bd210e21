/* The steps that explicit schemes are put together from: velocities changed by forces (a kick), places by
 * velocities (a drift) within the bounds of the ground, and held points carried along.
 *
 * Damping acts on what a point's velocity differs by from that of its frame: of what holds it, or of the body
 * as a whole where nothing does. It neither slows a fall nor drags behind a walk. It is applied as the exact
 * decay exp(-alpha h), that of the springs' own as a force from the velocities before the substep.
 *
 * Written for the lanes of the file that includes it; see kernels/kernels.h. */
#ifndef SBRI_MOTION_H
#define SBRI_MOTION_H

#include <string.h>

#include "collide/contact.h"
#include "math/trig.h"
#include "solvers/rigid_motion.h"
#include "solvers/spring_forces.h"

/* Penetration is undone at up to this speed. Contacts slower than that do not bounce. */
#define SBRI_PUSH_M_S 2.0f
#define SBRI_BOUNCE_FROM_M_S 0.05f

typedef struct sbri_decay {
  float frame; /* share of the velocity against the frame that a substep keeps */
  float media; /* and against the medium */
} sbri_decay;

static inline void sbri_kick_body(const sbri_island_tick *t, const sbri_body *body, float h, sbri_decay keep,
    bool damped, bool track, float *stretches) {
  const sbri_island *island = t->island;
  sbri_wide step = sbri_wide_all(h), kept = sbri_wide_all(keep.frame), drifting = sbri_wide_all(keep.media);
  bool guided = body->held && keep.frame < 1;
  for (uint32_t slot = body->slot_begin; slot < body->slot_end; slot += SBRI_LANES) {
    float *velocity = t->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbri_wide3 x = sbri_wide_load_points(t->positions + slot), v = sbri_load3(velocity);
    sbri_wide3 f = sbri_spring_forces(t, slot, x, damped, track, stretches);
    sbri_wide w = sbri_wide_load(island->inverse_masses + slot);
    sbri_wide g = sbri_wide_load(island->gravity_scales + slot);
    v.x = v.x + step * (f.x * w + g * sbri_wide_all(t->gravity.x));
    v.y = v.y + step * (f.y * w + g * sbri_wide_all(t->gravity.y));
    v.z = v.z + step * (f.z * w + g * sbri_wide_all(t->gravity.z));
    if (guided) {
      sbri_wide3 u =
          sbri_load3(t->guide_velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK);
      v.x = u.x + (v.x - u.x) * kept;
      v.y = u.y + (v.y - u.y) * kept;
      v.z = u.z + (v.z - u.z) * kept;
    }
    if (keep.media < 1) {
      sbri_wide3 u = {sbri_wide_all(t->wind.x), sbri_wide_all(t->wind.y), sbri_wide_all(t->wind.z)};
      sbri_mask real = w > sbri_wide_all(0);
      v.x = sbri_wide_select(real, u.x + (v.x - u.x) * drifting, v.x);
      v.y = sbri_wide_select(real, u.y + (v.y - u.y) * drifting, v.y);
      v.z = sbri_wide_select(real, u.z + (v.z - u.z) * drifting, v.z);
    }
    sbri_store3(velocity, v);
  }
}

/* The velocities as points, for the springs' damping; `rate` is one over the tick's length. */
static inline void sbri_spread_velocities(const sbri_island_tick *t, float rate) {
  const sbri_island *island = t->island;
  for (uint32_t slot = 0; slot < island->free_count; slot += SBRI_LANES)
    sbri_wide_store_points(t->velocity_points + slot,
        sbri_load3(t->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK));
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++) {
    const sbri_point *from = &t->begins[slot], *to = &t->targets[slot];
    t->velocity_points[slot] =
        (sbri_point){(to->x - from->x) * rate, (to->y - from->y) * rate, (to->z - from->z) * rate, 0};
  }
}

static inline void sbri_drift_body(const sbri_island_tick *t, const sbri_body *body, float h) {
  sbri_wide step = sbri_wide_all(h);
  const sbri_contact_rule rule = {
      body->friction, body->restitution, h, SBRI_PUSH_M_S * h, SBRI_BOUNCE_FROM_M_S};
  for (uint32_t slot = body->slot_begin; slot < body->slot_end; slot += SBRI_LANES) {
    uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    float *velocity = t->velocities + 3 * (block * SBRI_BLOCK) + lane;
    sbri_wide3 x = sbri_wide_load_points(t->positions + slot), v = sbri_load3(velocity);
    if (t->near_ground[block]) {
      sbri_contact_move(&x, &v, t->planes + 4 * (block * SBRI_BLOCK) + lane, &rule);
      sbri_store3(velocity, v);
    } else {
      x.x = x.x + step * v.x;
      x.y = x.y + step * v.y;
      x.z = x.z + step * v.z;
    }
    sbri_wide_store_points(t->positions + slot, x);
  }
}

/* Held points on the straight way from where they were to where they shall be. */
static inline void sbri_carry_held(const sbri_island_tick *t, float share) {
  size_t held = t->island->slot_count - t->island->free_count;
  if (share >= 1) { /* without rounding */
    memcpy(t->positions + t->island->free_count, t->targets + t->island->free_count,
        held * sizeof *t->positions);
    return;
  }
  const float *from = &t->begins[t->island->free_count].x, *to = &t->targets[t->island->free_count].x;
  float *at = &t->positions[t->island->free_count].x;
  for (size_t i = 0; i < 4 * held; i++) at[i] = from[i] + (to[i] - from[i]) * share;
}

static inline void sbri_kick(const sbri_island_tick *t, float h, bool last, float *stretches) {
  bool damped = t->island->cell_damping != NULL;
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    sbri_decay keep = {body->alpha_1_s > 0 ? sbri_exp(-body->alpha_1_s * h) : 1,
        body->media_friction_1_s > 0 ? sbri_exp(-body->media_friction_1_s * h) : 1};
    /* Four copies of the loop, so that the common one carries no more than it needs. */
    if (damped && last)
      sbri_kick_body(t, body, h, keep, true, true, stretches);
    else if (damped)
      sbri_kick_body(t, body, h, keep, true, false, stretches);
    else if (last)
      sbri_kick_body(t, body, h, keep, false, true, stretches);
    else
      sbri_kick_body(t, body, h, keep, false, false, stretches);
    if (!body->held && keep.frame < 1)
      sbri_rigid_motion_damp(t->island, body, t->positions, t->velocities, keep.frame);
  }
}

#endif
