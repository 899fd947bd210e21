/* Number of substeps of the explicit integrators.
 *
 * A mode of angular frequency w is stable with substeps h while h w < 2 (sqrt(1 + z^2) - z). z is its damping
 * ratio by forces from the beginning of the substep, here the springs' own damping, beta w / 2; damping
 * relative to the body's frame is exact and needs no bound. w is the highest frequency at rest plus the
 * effect of tension: a spring stretched to length l resists transversal motion with k (1 - l0 / l), at most
 * that fraction of k in all directions at once, and `bound_rad_s` is the highest frequency with k in all
 * directions. */
#include "model/runtime_model.h"

/* Springs that rotate against each other under large strains change the highest frequency a little.
 * Tetrahedra are monitored during the tick (soft/solvers/symplectic.h) and stiffen between two checks.
 * Substep counts that change from tick to tick also excite modes near the limit: with 1.04, an undamped cube
 * that fell reached three times its energy. */
static const double MARGIN = 1.1;

/* Above the needs of any model, and far below overflow. */
enum { MAX_COUNTED = 1 << 20 };

uint32_t sbri_stable_substeps(const sbri_island *island, double tick_s, float stretch) {
  if (island->stepping.substeps) return island->stepping.substeps;
  double rest = MARGIN * island->stability.fastest_rad_s, max = 1.02 * island->stability.bound_rad_s;
  double across = stretch > 0 ? stretch : 0;
  double w = sqrt(rest * rest + across * max * max);
  if (w > max) w = max;
  w = sqrt(w * w + MARGIN * MARGIN * island->stability.external_rad_s * island->stability.external_rad_s);
  double z = 0.5 * island->springs.stiffness_damping_s * w;
  double needed = tick_s * w / (2 * (sqrt(1 + z * z) - z));
  if (!(needed < MAX_COUNTED)) return MAX_COUNTED;
  return needed < 1 ? 1 : (uint32_t)needed + ((double)(uint32_t)needed < needed);
}
