#include "mechanics/bearing_modulus.h"

#include <math.h>

static const double GRAVITY = 9.81; /* m/s^2 */
static const double MAX_STRAIN = 0.05;

/* Rounds up to two digits, so that an estimate looks like one. */
static double rounded_up(double value) {
  double unit = 1;
  while (value / unit >= 100) unit *= 10;
  return ceil(value / unit) * unit;
}

double sbfi_modulus_to_bear(double modulus, double density, double height, double strain) {
  double needed = density * GRAVITY * height / strain;
  return needed > modulus && needed <= 1e30 ? rounded_up(needed) : modulus;
}

double sbfi_bearing_modulus(const sbf_attributes *attributes, const sbf_vec3_list *surface) {
  double modulus = (double)attributes->young_modulus;
  if (surface->count == 0) return modulus;
  sbf_vec3 low = surface->at[0], high = surface->at[0];
  for (uint32_t i = 1; i < surface->count; i++) {
    sbf_vec3 p = surface->at[i];
    low = (sbf_vec3){fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z)};
    high = (sbf_vec3){fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z)};
  }
  double height = fmax(fmax((double)high.x - low.x, (double)high.y - low.y), (double)high.z - low.z);
  return sbfi_modulus_to_bear(modulus, (double)attributes->density, height, MAX_STRAIN);
}

/* ---- Bodies on thin supports ---- */

/* Heights of the cross-sections. Those within a twelfth of the ends are skipped, because rounded ends have
 * tiny cross-sections. */
enum { CUTS = 96, FIRST_CUT = 8, END_CUT = 88 };

static sbf_vec3 at_height(sbf_vec3 a, sbf_vec3 b, float y) {
  float t = (y - a.y) / (b.y - a.y);
  return (sbf_vec3){a.x + (b.x - a.x) * t, y, a.z + (b.z - a.z) * t};
}

/* Twice the area that the triangle adds to the cross-section at a height. */
static double cut_of(const sbf_vec3 corners[3], float y) {
  sbf_vec3 up = {0, 0, 0}, down = {0, 0, 0};
  int count = 0;
  for (int k = 0; k < 3; k++) {
    sbf_vec3 a = corners[k], b = corners[(k + 1) % 3];
    if ((a.y > y) == (b.y > y)) continue;
    *(a.y > y ? &down : &up) = at_height(a, b, y);
    count++;
  }
  return count == 2 ? (double)down.z * (double)up.x - (double)down.x * (double)up.z : 0;
}

static void add_cuts(const sbf_vec3 corners[3], float low, float step, double areas[CUTS]) {
  float min = fminf(corners[0].y, fminf(corners[1].y, corners[2].y));
  float max = fmaxf(corners[0].y, fmaxf(corners[1].y, corners[2].y));
  int first = (int)fmaxf(0, (min - low) / step - 1), end = (int)fminf(CUTS, (max - low) / step + 1);
  for (int k = first; k < end; k++) areas[k] += 0.5 * cut_of(corners, low + ((float)k + 0.5f) * step);
}

/* Largest height of a uniform column with the same stress at its base as some cross-section of the surface
 * has from the mass above it; 0 if the surface encloses nothing there. */
static double column_of(const sbf_polygon_mesh *mesh) {
  double areas[CUTS] = {0}, above = 0, column = 0;
  const sbf_vec3 *x = mesh->positions.at;
  float low = x[0].y, high = x[0].y;
  for (uint32_t i = 1; i < mesh->positions.count; i++) low = fminf(low, x[i].y), high = fmaxf(high, x[i].y);
  float step = (high - low) / CUTS;
  if (!(step > 0) || !(step < 1e30f)) return 0;
  const uint32_t *points = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; points += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
      const sbf_vec3 corners[3] = {x[points[0]], x[points[k - 1]], x[points[k]]};
      add_cuts(corners, low, step, areas);
    }
  for (int k = CUTS; k-- > FIRST_CUT;) {
    above += areas[k] * (double)step;
    if (k < END_CUT && areas[k] > 0) column = fmax(column, above / areas[k]);
  }
  return column;
}

/* Above this multiple of the column the object is assumed not to stand on its thin parts: strands, or
 * overlapping pieces. */
static const double MAX_TIMES = 5;

double sbfi_standing_modulus(const sbf_attributes *attributes, const sbf_polygon_mesh *surface) {
  double as_column = sbfi_bearing_modulus(attributes, &surface->positions);
  if (surface->positions.count == 0) return as_column;
  double needed =
      sbfi_modulus_to_bear(as_column, (double)attributes->density, column_of(surface), MAX_STRAIN);
  return fmin(needed, rounded_up(MAX_TIMES * as_column));
}
