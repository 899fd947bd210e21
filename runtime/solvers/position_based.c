/* Its loops are in solvers/position_based.h. */
#include "kernels/kernels.h"

/* Few enough to be cheap, many enough that a sweep settles most of what a substep brings. Tetrahedra, whose
 * points belong to many, need twice as many to rest within a few per cent of where they should. */
enum { LEAST_SUBSTEPS = 8, MOST_SUBSTEPS = 32, SOLID_FACTOR = 2 };

static const double MARGIN = 1.1;

uint32_t sbri_position_substeps(const sbri_island *island, double tick_s) {
  if (island->substeps) return island->substeps;
  uint32_t stable = sbri_stable_substeps(island, tick_s, island->rest_stretch);
  double outer = MARGIN * tick_s * island->outer_rad_s / 2; /* gas and bending are not swept */
  uint32_t factor = island->tetrahedron_count ? SOLID_FACTOR : 1, most = factor * MOST_SUBSTEPS;
  stable *= factor;
  if (outer > most) most = (uint32_t)outer + 1;
  if (most > SBRI_MOST_SUBSTEPS) most = SBRI_MOST_SUBSTEPS;
  return stable < LEAST_SUBSTEPS ? LEAST_SUBSTEPS : stable > most ? most : stable;
}

static uint32_t substeps(const sbri_island *island, double tick_s, float stretch) {
  (void)stretch;
  return sbri_position_substeps(island, tick_s);
}

static void tick_position_based(const sbri_island_tick *tick) {
  tick->model->kernels->position_based_tick(tick);
}

const sbri_scheme sbri_position_based = {.word = SBF_SCHEME_POSITION_BASED,
    .sweeps = true,
    .refuse = sbri_refuse_regions,
    .substeps = substeps,
    .tick = tick_position_based};
