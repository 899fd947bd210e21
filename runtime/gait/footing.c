/* Where a foot may stand: not across an edge, not on a slope too steep, not a step too high. Looked for only
 * near where the foot would go anyhow. */
#include "gait/gait_state.h"

static const float STEEPEST = 0.6f; /* cosine of the slope */
static const float HIGHEST = 0.6f;  /* of the reach: up or down from where the other feet stand */
static const float AROUND = 1.15f;  /* of the sole: what is looked at */
static const float UNEVEN = 0.03f;  /* of the reach: how far the ground may depart from a plane there */
static const float SPACING = 0.1f;  /* of the reach: between the places tried */

typedef struct ground_spot {
  sbf_vec3 place, normal;
} ground_spot;

/* What is looked for: about how high, and under which corners. */
typedef struct footing {
  float level;
  sbf_vec3 corners[4];
} footing;

/* Height that the other feet stand at. */
static float level_of(const sbri_rig *rig, const sbri_gait_state *state) {
  float sum = 0, count = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++)
    if (state->feet[i].planted) sum += state->feet[i].ground.y, count += 1;
  return count > 0 ? sum / count : state->position.y;
}

/* 2: good, 1: uneven, 0: not to stand on. */
static int quality(
    const sbri_rig *rig, const sbri_gait_input *input, const footing *f, sbf_vec3 wanted, ground_spot *spot) {
  float reach = rig->reach * input->scale;
  spot->place = sbri_ground_below(input, wanted, &spot->normal);
  if (spot->normal.y < STEEPEST || fabsf(spot->place.y - f->level) > HIGHEST * reach) return 0;
  for (int k = 0; k < 4; k++) {
    sbf_vec3 beside = sbri_add(spot->place, f->corners[k]);
    float plane = spot->place.y -
                  (spot->normal.x * f->corners[k].x + spot->normal.z * f->corners[k].z) / spot->normal.y;
    if (fabsf(sbri_ground_below(input, beside, NULL).y - plane) > UNEVEN * reach) return 1;
  }
  return 2;
}

bool sbri_footing(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 wanted, sbf_vec3 *place, sbf_vec3 *normal) {
  const sbri_sole *sole = &rig->legs[leg].sole;
  footing f = {.level = level_of(rig, state)};
  for (int k = 0; k < 4; k++) {
    sbf_vec3 corner = {k & 1 ? sole->left : sole->right, 0, k & 2 ? sole->toe : sole->heel};
    f.corners[k] = sbri_headed(state, sbri_scale(corner, AROUND * input->scale));
  }
  float step = SPACING * rig->reach * input->scale;
  ground_spot spot, uneven;
  int best = quality(rig, input, &f, wanted, &spot);
  uneven = spot;
  sbf_vec3 way = sbri_sub(wanted, state->feet[leg].planted ? state->feet[leg].ground : state->feet[leg].from);
  way.y = 0;
  float length = sbri_length(way);
  way = sbri_normalize(way, sbri_headed(state, sbri_vec3(0, 0, 1)));
  /* Nearer and farther along its way, then back to where it came from. */
  for (int k = 1; best < 2 && k <= 6; k++) {
    float offset = step * (float)((k + 1) / 2) * (k % 2 ? -1.0f : 1.0f);
    ground_spot other;
    if (-offset > length) continue;
    int found = quality(rig, input, &f, sbri_add_scaled(wanted, way, offset), &other);
    if (found > best) best = found, *(found == 2 ? &spot : &uneven) = other;
  }
  for (int k = 1; best == 0 && k <= 4; k++) {
    int found = quality(rig, input, &f, sbri_add_scaled(wanted, way, -length * 0.25f * (float)k), &uneven);
    if (found) best = found;
  }
  if (best == 0) return false;
  *place = best == 2 ? spot.place : uneven.place;
  *normal = best == 2 ? spot.normal : uneven.normal;
  return true;
}
