/* How many substeps the explicit scheme needs.
 *
 * A mode of angular frequency w is stable with substeps h while h w < 2 (sqrt(1 + z^2) - z), z its damping
 * ratio by forces taken at the beginning of the substep (here that of the springs' own damping, beta w / 2;
 * damping against the body's frame is exact and bounds nothing). w is that of the fastest mode at rest, plus
 * what tension adds: a spring stretched to length l resists sideways with k (1 - l0 / l), no more than that
 * share of k in all directions at once, of which `bound_rad_s` is the fastest mode. */
#include "model/runtime_model.h"

/* Springs that turn against each other under large strains change the fastest mode a little. Tetrahedra are
 * watched while they run (solvers/symplectic.h) and stiffen between two looks. Substeps whose number changes
 * from tick to tick also pump modes next to the limit: with 1.04 an undamped cube that fell came to three
 * times its energy. */
static const double MARGIN = 1.1;

/* More than any model may have, and far from where counts of them overflow. */
enum { MAX_COUNTED = 1 << 20 };

uint32_t sbri_stable_substeps(const sbri_island *island, double tick_s, float stretch) {
  if (island->substeps) return island->substeps;
  double rest = MARGIN * island->fastest_rad_s, max = 1.02 * island->bound_rad_s;
  double across = stretch > 0 ? stretch : 0;
  double w = sqrt(rest * rest + across * max * max);
  if (w > max) w = max;
  w = sqrt(w * w + MARGIN * MARGIN * island->external_rad_s * island->external_rad_s);
  double z = 0.5 * island->stiffness_damping_s * w;
  double needed = tick_s * w / (2 * (sqrt(1 + z * z) - z));
  if (!(needed < MAX_COUNTED)) return MAX_COUNTED;
  return needed < 1 ? 1 : (uint32_t)needed + ((double)(uint32_t)needed < needed);
}
