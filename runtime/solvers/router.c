#include "solvers/router.h"

#include "math/vec3.h"
#include "solvers/tetrahedron_forces.h"

static uint32_t most_strained(const sbri_island *island, double tick_s) {
  uint32_t least = island->tetrahedron_count ? SBRI_TROUBLED_SOLID_SUBSTEPS : SBRI_TROUBLED_SUBSTEPS;
  uint32_t at_rest = sbri_stable_substeps(island, tick_s, island->rest_stretch), most = at_rest + at_rest / 2;
  if (most < least) return least;
  return most < SBRI_MOST_STRAINED_SUBSTEPS ? most : SBRI_MOST_STRAINED_SUBSTEPS;
}

bool sbri_router_begins_explicit(const sbri_island *island) {
  return sbri_stable_substeps(island, 1.0 / 60, island->rest_stretch) <= SBRI_MOST_SUBSTEPS;
}

static sbf_vec3 velocity_at(const sbri_island_tick *t, uint32_t slot) {
  const float *v = t->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
  return sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]);
}

/* Square of the greatest speed of a point against the mean of its body's, m^2/s^2. */
static float greatest_square(const sbri_island_tick *t) {
  float greatest = 0;
  for (uint32_t b = 0; b < t->island->body_count; b++) {
    const sbri_body *body = &t->model->bodies[t->island->bodies[b]];
    sbf_vec3 sum = {0, 0, 0};
    if (body->slot_real_end == body->slot_begin) continue;
    for (uint32_t slot = body->slot_begin; slot < body->slot_real_end; slot++)
      sum = sbri_add(sum, velocity_at(t, slot));
    sbf_vec3 mean = sbri_scale(sum, 1 / (float)(body->slot_real_end - body->slot_begin));
    for (uint32_t slot = body->slot_begin; slot < body->slot_real_end; slot++) {
      sbf_vec3 off = sbri_sub(velocity_at(t, slot), mean);
      float square = sbri_dot(off, off);
      greatest = square > greatest ? square : greatest;
    }
  }
  return greatest;
}

const sbri_scheme *sbri_router_scheme(const sbri_island *island, uint32_t recovering) {
  return island->routed && recovering > 0 ? &sbri_position_based : island->scheme;
}

const sbri_scheme *sbri_router_choose(const sbri_island_tick *t, uint32_t *recovering) {
  const sbri_island *island = t->island;
  if (!island->routed) return island->scheme;
  uint32_t substeps = sbri_stable_substeps(island, sbri_stiffened_time(t, t->tick_s), *t->stretch);
  float reach = island->cell_m * (float)substeps / t->tick_s;
  bool trouble = substeps > most_strained(island, t->tick_s) || !(*t->least_ratio > 0) ||
                 (reach > 0 && greatest_square(t) > reach * reach);
  if (trouble)
    *recovering = SBRI_RECOVERING_TICKS;
  else if (*recovering > 0)
    --*recovering;
  return sbri_router_scheme(island, *recovering);
}
