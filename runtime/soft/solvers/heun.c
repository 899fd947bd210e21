/* The loops are in soft/solvers/heun.h. */
#include "model/kernels.h"
#include "soft/solvers/scheme.h"

/* Minimum number of substeps: no mode has a phase of more than half a radian per substep, which is four times
 * the number that is stable for symplectic Euler. A number set by the asset replaces the error control; it is
 * raised to the next power of two. */
static uint32_t substeps(const sbri_island *island, double tick_s, float stretch) {
  uint32_t stable = sbri_stable_substeps(island, tick_s, stretch);
  return island->stepping.substeps ? stable : stable < SBRI_MAX_SUBSTEPS / 4 ? 4 * stable : SBRI_MAX_SUBSTEPS;
}

static void tick_heun(const sbri_island_tick *tick) {
  tick->model->kernels->heun_tick(tick);
}

const sbri_scheme sbri_heun = {.kind = SBF_SCHEME_HEUN, .substeps = substeps, .tick = tick_heun};
