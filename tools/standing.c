#include "standing.h"

#include <stdbool.h>

#include "sbfmt/mechanics.h"

static bool is_pinned(const sbf_soft_body *body) {
  for (uint32_t i = 0; i < body->levels.count; i++)
    if (body->levels.at[i].pins.count) return true;
  return body->pins.count > 0;
}

static bool is_loose(const sbf_asset *asset) {
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    if (is_pinned(&asset->soft_bodies.at[i])) return false;
  return asset->bones.count == 0 && asset->soft_bodies.count > 0;
}

/* Highest ground below the box, sampled on a grid. */
static double highest(const sbr_ground *ground, sbf_vec3 low, sbf_vec3 high) {
  enum { GRID_POINTS = 33 };
  double top = 0;
  for (int i = 0; i < GRID_POINTS * GRID_POINTS; i++) {
    int column = i % GRID_POINTS, row = i / GRID_POINTS;
    double u = column / (GRID_POINTS - 1.0), v = row / (GRID_POINTS - 1.0);
    sbf_vec3 normal;
    double here = ground->height(
        ground, low.x + u * ((double)high.x - low.x), low.z + v * ((double)high.z - low.z), &normal);
    if (i == 0 || here > top) top = here;
  }
  return top;
}

double standing_lift(const sbf_asset *asset, const sbr_ground *ground) {
  sbf_asset_measures measures;
  if (!is_loose(asset)) return 0;
  sbf_asset_measure(asset, &measures);
  if (!measures.bounded) return 0;
  double lift = highest(ground, measures.low, measures.high) - measures.low.y;
  return lift > 0 ? lift : 0;
}
