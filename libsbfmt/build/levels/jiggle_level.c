#include "build/levels/jiggle_level.h"

#include <math.h>
#include <string.h>

/* Corners of a positively oriented tetrahedron around the unit cube. */
static const float corners[4][3] = {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}};

static float component(sbf_vec3 v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

bool sbfi_jiggle_level_make(
    sbf_level *level, const sbf_soft_body *body, double frequency, int32_t derivation, sbf_asset *asset) {
  const sbf_vec3_list *surface = &body->surface.positions;
  uint32_t sources = surface->count + body->interior.count;
  sbf_vec3 *positions = sbf_asset_allocate(asset, 4, sizeof *positions);
  sbf_jiggle *jiggle = sbf_asset_allocate(asset, 1, sizeof *jiggle);
  uint32_t *new_from_old = sbf_asset_allocate(asset, (size_t)sources + 1, sizeof *new_from_old);
  sbf_level_init(level);
  level->name = sbf_asset_copy_text(asset, "jiggle");
  if (!positions || !jiggle || !new_from_old || !level->name) return false;
  float middle[3], reach = 0;
  for (int k = 0; k < 3; k++) {
    float low = component(surface->at[0], k), high = low;
    for (uint32_t i = 1; i < surface->count; i++) {
      low = fminf(low, component(surface->at[i], k));
      high = fmaxf(high, component(surface->at[i], k));
    }
    middle[k] = low + (high - low) / 2;
    reach = fmaxf(reach, (high - low) / 2);
  }
  if (!(reach > 0)) reach = 0.01f;
  for (int i = 0; i < 4; i++)
    positions[i] = (sbf_vec3){middle[0] + reach * corners[i][0], middle[1] + reach * corners[i][1],
        middle[2] + reach * corners[i][2]};
  memset(new_from_old, 0xff, ((size_t)sources + 1) * sizeof *new_from_old);
  sbf_jiggle_init(jiggle);
  if (frequency > 0 && frequency < 1e6) jiggle->frequency = (float)frequency;
  jiggle->damping_ratio = body->attributes.damping_ratio;
  jiggle->response = 2; /* damps motion relative to the bone: no lag at constant velocity */
  level->model = SBF_ELASTIC_MODEL_JIGGLE;
  level->derived = derivation;
  level->positions = (sbf_vec3_list){positions, 4};
  level->new_from_old = (sbf_u32_list){new_from_old, sources};
  level->jiggle = jiggle;
  return true;
}
