/* Its loops are in solvers/heun.h. */
#include "model/kernels.h"
#include "solvers/scheme.h"

/* At least so many that no mode turns by more than half a radian in one: twice two times what is stable for
 * symplectic Euler. A count that is asked for takes the place of the error's say; it is raised to the next
 * power of two. */
static uint32_t substeps(const sbri_island *island, double tick_s, float stretch) {
  uint32_t stable = sbri_stable_substeps(island, tick_s, stretch);
  return island->substeps ? stable : stable < SBRI_MAX_SUBSTEPS / 4 ? 4 * stable : SBRI_MAX_SUBSTEPS;
}

static void tick_heun(const sbri_island_tick *tick) {
  tick->model->kernels->heun_tick(tick);
}

const sbri_scheme sbri_heun = {.kind = SBF_SCHEME_HEUN, .substeps = substeps, .tick = tick_heun};
