#include "soft/solvers/router.h"

#include "base/assert.h"
#include "math/vec3.h"
#include "soft/solvers/tetrahedron_forces.h"

static uint32_t max_strained(const sbri_island *island, double tick_s) {
  uint32_t min = island->tetrahedra.count ? SBRI_TROUBLED_SOLID_SUBSTEPS : SBRI_TROUBLED_SUBSTEPS;
  uint32_t at_rest = sbri_stable_substeps(island, tick_s, island->springs.rest_stretch),
           max = at_rest + at_rest / 2;
  if (max < min) return min;
  return max < SBRI_MAX_STRAINED_SUBSTEPS ? max : SBRI_MAX_STRAINED_SUBSTEPS;
}

bool sbri_router_begins_explicit(const sbri_island *island) {
  return sbri_stable_substeps(island, 1.0 / 60, island->springs.rest_stretch) <= SBRI_MAX_SUBSTEPS;
}

static sbf_vec3 velocity_at(const sbri_island_tick *t, uint32_t slot) {
  const float *v = t->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
  return sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]);
}

/* Square of the greatest speed of a point relative to the mean of its body, m^2/s^2. */
static float greatest_square(const sbri_island_tick *t) {
  float greatest = 0;
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    sbf_vec3 sum = {0, 0, 0};
    if (body->slots.real_end == body->slots.begin) continue;
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
      sum = sbri_add(sum, velocity_at(t, slot));
    sbf_vec3 mean = sbri_scale(sum, 1 / (float)(body->slots.real_end - body->slots.begin));
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
      sbf_vec3 relative = sbri_sub(velocity_at(t, slot), mean);
      float square = sbri_dot(relative, relative);
      greatest = square > greatest ? square : greatest;
    }
  }
  return greatest;
}

const sbri_scheme *sbri_router_scheme(const sbri_island *island, const sbri_recovery *recovery) {
  if (recovery->rigid_ticks > 0) return &sbri_rigid_shape;
  return island->stepping.is_routed && recovery->ticks > 0 ? &sbri_position_based : island->scheme;
}

static bool is_in_trouble(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  uint32_t substeps = sbri_stable_substeps(island, sbri_stiffened_time(t, t->tick_s), *t->springs.stretch);
  float reach = island->stability.cell_m * (float)substeps / t->tick_s;
  bool strained = island->stepping.is_routed && substeps > max_strained(island, t->tick_s);
  return strained || !(*t->solids.min_ratio > 0) || (reach > 0 && greatest_square(t) > reach * reach);
}

const sbri_scheme *sbri_router_choose(const sbri_island_tick *t, sbri_recovery *recovery) {
  SBF_ASSERT(t->island->free_count <= t->island->slot_count && t->island->free_count % SBRI_BLOCK == 0);
  if (t->island->scheme->forceless) return t->island->scheme;
  if (recovery->rigid_ticks == 0 && is_in_trouble(t))
    recovery->ticks = SBRI_RECOVERING_TICKS;
  else if (recovery->ticks > 0)
    --recovery->ticks;
  return sbri_router_scheme(t->island, recovery);
}
