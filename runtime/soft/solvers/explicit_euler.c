/* The loops are in soft/solvers/explicit_euler.h. */
#include "model/kernels.h"
#include "soft/solvers/scheme.h"

/* Number of substeps for which the springs' own damping makes the scheme stable. Without damping no number
 * does; then the number of symplectic Euler. */
static uint32_t substeps(const sbri_island *island, double tick_s, float stretch) {
  uint32_t stable = sbri_stable_substeps(island, tick_s, stretch);
  double w = island->stability.fastest_rad_s, z = 0.5 * island->springs.stiffness_damping_s * w;
  if (island->stepping.substeps || !(z > 0) || z >= 1) return stable;
  double needed = 1.1 * tick_s * w / (2 * z);
  if (!(needed < SBRI_MAX_SUBSTEPS)) return stable > SBRI_MAX_SUBSTEPS ? stable : SBRI_MAX_SUBSTEPS;
  return needed > stable ? (uint32_t)needed + 1 : stable;
}

static void tick_explicit_euler(const sbri_island_tick *tick) {
  tick->model->kernels->explicit_euler_tick(tick);
}

const sbri_scheme sbri_explicit_euler = {
    .kind = SBF_SCHEME_EXPLICIT_EULER, .substeps = substeps, .tick = tick_explicit_euler};
