/* The loops are in soft/solvers/position_based.h. */
#include "model/kernels.h"
#include "soft/solvers/scheme.h"

/* A sweep leaves a network too soft: by a third in bending with the number of substeps that is stable for
 * symplectic Euler, and by a quarter of that with each doubling. Four times as many are within 3 %.
 * Tetrahedra, which are corrected as a whole, are within 2 % with twice as many.
 *
 * Tetrahedra always get at least the number that is stable for symplectic Euler. Elements share points, and a
 * sweep over them is not symmetric: where it does not resolve the fastest mode, it turns the errors of some
 * modes into motion. A cube of 64 kg dropped by 1 m reached 1.5e8 J with 0.6 times as many (nu = 0.499), and
 * 7 times its energy with 0.07 times as many (nu = 0.3). */
enum { MIN_SUBSTEPS = 8, SPRING_FACTOR = 4, SOLID_FACTOR = 2 };
enum { MAX_SPRING_SUBSTEPS = 128, MAX_DOUBLED_SUBSTEPS = 64 };

/* Limits for springs that recover for some ticks and are otherwise stepped explicitly, and for springs so
 * stiff that even the maximum leaves them several times too soft. */
enum { FEW_SUBSTEPS = 32, HOPELESS_SUBSTEPS = 512 };

static const double MARGIN = 1.1;

uint32_t sbri_position_substeps(const sbri_island *island, double tick_s) {
  if (island->stepping.substeps) return island->stepping.substeps;
  uint32_t stable = sbri_stable_substeps(island, tick_s, island->springs.rest_stretch);
  double outer =
      MARGIN * tick_s * island->stability.external_rad_s / 2; /* sweeps do not cover gas and bending */
  bool solid = island->tetrahedra.count > 0;
  bool few = island->scheme != &sbri_position_based || stable > HOPELESS_SUBSTEPS;
  uint32_t factor = SPRING_FACTOR, max = MAX_SPRING_SUBSTEPS;
  if (solid) factor = SOLID_FACTOR, max = stable > MAX_DOUBLED_SUBSTEPS ? stable : MAX_DOUBLED_SUBSTEPS;
  if (solid && max > SBRI_MAX_SUBSTEPS) max = SBRI_MAX_SUBSTEPS;
  if (!solid && few) factor = 1, max = FEW_SUBSTEPS;
  stable *= factor;
  if (outer > max) max = outer < SBRI_MAX_SUBSTEPS ? (uint32_t)outer + 1 : SBRI_MAX_SUBSTEPS;
  return stable < MIN_SUBSTEPS ? MIN_SUBSTEPS : stable > max ? max : stable;
}

static uint32_t substeps(const sbri_island *island, double tick_s, float stretch) {
  (void)stretch;
  return sbri_position_substeps(island, tick_s);
}

static void tick_position_based(const sbri_island_tick *tick) {
  tick->model->kernels->position_based_tick(tick);
}

const sbri_scheme sbri_position_based = {.kind = SBF_SCHEME_POSITION_BASED,
    .sweeps = true,
    .refuse = sbri_refuse_regions,
    .substeps = substeps,
    .tick = tick_position_based};
