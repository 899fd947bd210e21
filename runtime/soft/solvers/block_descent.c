/* The loops are in soft/solvers/block_descent.h. */
#include "model/kernels.h"
#include "soft/solvers/descent_table.h"
#include "soft/solvers/scheme.h"

/* Independent of the stiffness. More substeps follow motion better. */
enum { SUBSTEPS = 5 };

static uint32_t substeps(const sbri_island *island, double tick_s, float stretch) {
  (void)tick_s;
  (void)stretch;
  return island->stepping.substeps ? island->stepping.substeps : SUBSTEPS;
}

/* The tables of this scheme hold constant rest lengths and strengths. */
static const char *refuse(const sbr_model *model, const sbri_island *island) {
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &model->bodies[island->bodies[b]];
    const sbf_attributes *is = &body->source->attributes;
    bool flows = is->yield_strain > 0 || is->tear_strain > 0;
    for (uint32_t s = 0; s < body->level->springs.count; s++)
      flows =
          flows || body->level->springs.at[s].yield_strain > 0 || body->level->springs.at[s].tear_strain > 0;
    if (flows) return "whose elements yield or tear";
  }
  return sbri_refuse_regions(model, island);
}

static void tick_block_descent(const sbri_island_tick *tick) {
  tick->model->kernels->block_descent_tick(tick);
}

const sbri_scheme sbri_block_descent = {.kind = SBF_SCHEME_BLOCK_DESCENT,
    .refuse = refuse,
    .prepare = sbri_descent_make,
    .substeps = substeps,
    .tick = tick_block_descent};
