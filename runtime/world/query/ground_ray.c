#include "world/query/ground_ray.h"

#include <math.h>

#include "shapes/ground.h"

static const double SPACING = 0.05; /* m */
enum { MAX_PARTS = 4096, HALVINGS = 40 };

typedef struct ray {
  const sbr_ground *ground;
  sbr_double3 from;
  double x, y, z; /* m: length of the ray */
} ray;

/* Height of a point of the ray above the ground, m. */
static double clearance(const ray *r, double fraction, sbf_vec3 *normal) {
  return r->from.y + fraction * r->y -
         sbri_ground_height(r->ground, r->from.x + fraction * r->x, r->from.z + fraction * r->z, normal);
}

bool sbri_ground_ray(
    const sbr_ground *ground, sbr_double3 from, sbf_vec3 along, double *fraction, sbf_vec3 *normal) {
  ray r = {ground, from, (double)along.x, (double)along.y, (double)along.z};
  double length = sqrt(r.x * r.x + r.z * r.z), wanted = length / SPACING + 1;
  int parts = wanted < MAX_PARTS ? (int)wanted : MAX_PARTS;
  double level, above = 0, below = 0;
  if (sbri_ground_is_flat(ground, &level)) parts = 1;
  if (clearance(&r, 0, NULL) < 0) return false;
  for (int k = 1; k <= parts && below == 0; k++) {
    double at = (double)k / parts;
    if (clearance(&r, at, NULL) < 0)
      below = at;
    else
      above = at;
  }
  if (below == 0) return false;
  for (int i = 0; i < HALVINGS; i++) {
    double at = 0.5 * (above + below);
    if (clearance(&r, at, NULL) < 0)
      below = at;
    else
      above = at;
  }
  (void)clearance(&r, above, normal);
  *fraction = above;
  return true;
}
