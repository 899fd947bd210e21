/* Springs that support a body's weight in its authored shape.
 *
 * The small displacements u under the weight f, K u = f, change the tension of a spring of direction n by k
 * n.(u_b - u_a). With rest lengths shorter by n.(u_b - u_a) the springs have this tension at the authored
 * positions, so the authored shape is at rest. (This is the inverse of a static solve, exact to first order,
 * the problem of Twigg and Kacic-Alesic, Optimization for Sag-Free Simulations, 2011.) */
#include "prepare/island_maker.h"
#include "soft/solvers/scheme.h"

static const double TOLERANCE = 1e-4, ENOUGH = 1e-2;

/* Minimum rest length as a fraction of the distance at rest, for any mass of the body. */
static const float MIN_FRACTION = 0.05f;

bool sbri_island_preload(sbri_island_maker *m, const sbf_spring_network *network) {
  sbri_island *island = m->island;
  uint32_t points = island->slot_count;
  bool wanted = !m->states_rest_lengths && !island->scheme->forceless;
  for (uint32_t b = 0; b < island->body_count; b++)
    wanted = wanted && sbri_maker_body(m, b)->source->attributes.sag_free;
  if (!wanted || points == 0) return true;
  sbf_vec3 g = m->options->has_gravity ? m->options->gravity : m->model->asset->environment.gravity;
  double *forces = sbri_scratch(m, 3 * (size_t)points, sizeof *forces);
  double *u = sbri_scratch(m, 3 * (size_t)points, sizeof *u);
  double *scratch = sbri_scratch(m, 10 * (size_t)points, sizeof *scratch);
  if (!forces || !u || !scratch) return false;
  for (uint32_t i = 0; i < island->free_count; i++) {
    double weight = (double)island->masses[i] * (double)island->gravity_scales[i];
    forces[3 * (size_t)i] = weight * (double)g.x;
    forces[3 * (size_t)i + 1] = weight * (double)g.y;
    forces[3 * (size_t)i + 2] = weight * (double)g.z;
  }
  if (sbf_network_static(network, forces, TOLERANCE, 10 * points + 100, u, scratch) > ENOUGH) return true;
  for (uint32_t i = 0; i < island->springs.count; i++) {
    sbfi_spring *s = &m->listed[i];
    sbri_point *p = &m->rest[s->a], *q = &m->rest[s->b];
    const double *ua = u + 3 * (size_t)s->a, *ub = u + 3 * (size_t)s->b;
    double x = (double)q->x - p->x, y = (double)q->y - p->y, z = (double)q->z - p->z;
    double length = sqrt(x * x + y * y + z * z);
    if (s->rest_length_m > 0) {
      if (!(length > 0)) continue;
      double change = (x * (ub[0] - ua[0]) + y * (ub[1] - ua[1]) + z * (ub[2] - ua[2])) / length;
      if (change < 0 && s->slack < 1) change /= 1 - (double)s->slack; /* under compression, with its slack */
      float loaded = (float)(s->rest_length_m - change), min = MIN_FRACTION * s->rest_length_m;
      s->rest_length_m = loaded > min ? loaded : min;
    } else if (s->b >= island->free_count) { /* goal: moves its pinned end instead */
      q->x -= (float)ua[0], q->y -= (float)ua[1], q->z -= (float)ua[2];
    }
  }
  return true;
}
