/* Where a foot may stand: not across an edge, not on a slope too steep, not a step too high. Looked for only
 * near where the foot would go anyhow. */
#include "collide/ground.h"
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
  sbf_vec3 corners[4], outline[4];
} footing;

/* Height that the other feet stand at. */
static float level_of(const sbri_rig *rig, const sbri_gait_state *state) {
  float sum = 0, count = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++)
    if (state->feet[i].planted) sum += state->feet[i].ground.y, count += 1;
  return count > 0 ? sum / count : state->position.y;
}

/* A sole on the ground as a board is: tilted as the ground under its corners is, on the highest of what it
 * touches. Returns by how much the ground departs from it; where that is too much, as across an edge, it
 * keeps to the ground under its middle and hangs over. */
static float lay(const sbri_gait_input *input, const sbf_vec3 corners[4], float uneven, ground_spot *spot) {
  float heights[4], rise = 0, worst = 0;
  for (int k = 0; k < 4; k++)
    heights[k] = sbri_ground_below(input, sbri_add(spot->place, corners[k]), NULL).y - spot->place.y;
  /* Corners lie round the middle in pairs, so differences over the two ways give the slopes. */
  sbf_vec3 fore = sbri_sub(sbri_add(corners[2], corners[3]), sbri_add(corners[0], corners[1]));
  sbf_vec3 left = sbri_sub(sbri_add(corners[1], corners[3]), sbri_add(corners[0], corners[2]));
  float along = heights[2] + heights[3] - heights[0] - heights[1];
  float across = heights[1] + heights[3] - heights[0] - heights[2];
  sbf_vec3 slope = sbri_add(
      sbri_scale(fore, along / sbri_dot(fore, fore)), sbri_scale(left, across / sbri_dot(left, left)));
  for (int k = 0; k < 4; k++) {
    float over = heights[k] - sbri_dot(slope, corners[k]);
    worst = fabsf(over) > worst ? fabsf(over) : worst;
    rise = over > rise ? over : rise;
  }
  if (worst <= uneven) {
    spot->normal = sbri_normalize(sbri_vec3(-slope.x, 1, -slope.z), spot->normal);
  } else {
    for (int k = 0; k < 4; k++) {
      float plane = -(spot->normal.x * corners[k].x + spot->normal.z * corners[k].z) / spot->normal.y;
      if (k == 0) rise = worst = 0;
      worst = fabsf(heights[k] - plane) > worst ? fabsf(heights[k] - plane) : worst;
      if (heights[k] - plane > rise) rise = heights[k] - plane;
    }
  }
  spot->place.y += rise;
  return worst;
}

/* Where the ground is round, its highest places may be between the corners. */
static void raise_over_bumps(const sbri_gait_input *input, const sbf_vec3 corners[4], ground_spot *spot) {
  static const int edges[4][2] = {{0, 1}, {1, 3}, {3, 2}, {2, 0}};
  float rise = 0;
  for (int k = 0; k < 4; k++) {
    sbf_vec3 at = sbri_lerp(corners[edges[k][0]], corners[edges[k][1]], 0.5f);
    float plane = -(spot->normal.x * at.x + spot->normal.z * at.z) / spot->normal.y;
    float over = sbri_ground_below(input, sbri_add(spot->place, at), NULL).y - spot->place.y - plane;
    rise = over > rise ? over : rise;
  }
  spot->place.y += rise;
}

/* The corners of a leg's sole, a little larger than it is, as it will stand; and of all of the foot, where
 * asked for. */
static void find_corners(const sbri_rig *rig, const sbri_gait_state *state, float scale, uint32_t leg,
    sbf_vec3 corners[4], sbf_vec3 *outline) {
  const sbri_sole *sole = &rig->legs[leg].sole;
  const sbri_foot *foot = &state->feet[leg];
  float turned = foot->planted ? 0 : state->turn * state->pace * (1 - foot->phase) * foot->duration_s;
  for (int k = 0; k < 4; k++) {
    sbf_vec3 corner = {k & 1 ? sole->left : sole->right, 0, k & 2 ? sole->toe : sole->heel};
    if (turned != 0) corner = sbri_turned(corner, turned); /* as the body will be when it comes down */
    corners[k] = sbri_headed(state, sbri_scale(corner, AROUND * scale));
    if (!outline) continue;
    corner = sbri_vec3(sole->outline[k & 1 ? 0 : 1], 0, sole->outline[k & 2 ? 2 : 3]);
    if (turned != 0) corner = sbri_turned(corner, turned);
    outline[k] = sbri_headed(state, sbri_scale(corner, scale));
  }
}

void sbri_lay_sole(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 *place, sbf_vec3 *normal) {
  ground_spot spot;
  sbf_vec3 corners[4];
  double level;
  spot.place = sbri_ground_below(input, *place, &spot.normal);
  find_corners(rig, state, input->scale, leg, corners, NULL);
  if (!sbri_ground_is_flat(input->ground, &level)) {
    float uneven = UNEVEN * rig->reach * input->scale;
    bool even = lay(input, corners, uneven, &spot) <= uneven;
    if (even) raise_over_bumps(input, corners, &spot);
  }
  *place = spot.place;
  *normal = spot.normal;
}

/* 2: good, 1: uneven, 0: not to stand on. */
static int quality(
    const sbri_rig *rig, const sbri_gait_input *input, const footing *f, sbf_vec3 wanted, ground_spot *spot) {
  float reach = rig->reach * input->scale;
  double level;
  spot->place = sbri_ground_below(input, wanted, &spot->normal);
  if (spot->normal.y < STEEPEST || fabsf(spot->place.y - f->level) > HIGHEST * reach) return 0;
  if (sbri_ground_is_flat(input->ground, &level)) return 2;
  if (lay(input, f->corners, UNEVEN * reach, spot) > UNEVEN * reach) return 1;
  for (int k = 0; k < 4; k++) { /* nothing beside it that the rest of the foot would be in */
    float plane = -(spot->normal.x * f->outline[k].x + spot->normal.z * f->outline[k].z) / spot->normal.y;
    float high = sbri_ground_below(input, sbri_add(spot->place, f->outline[k]), NULL).y - spot->place.y;
    if (high - plane > 2 * UNEVEN * reach) return 1;
  }
  return 2;
}

bool sbri_stands(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 place, bool well) {
  footing f = {.level = level_of(rig, state)};
  ground_spot spot;
  find_corners(rig, state, input->scale, leg, f.corners, f.outline);
  return quality(rig, input, &f, place, &spot) >= (well ? 2 : 1);
}

bool sbri_footing(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 wanted, sbf_vec3 *place, sbf_vec3 *normal) {
  footing f = {.level = level_of(rig, state)};
  find_corners(rig, state, input->scale, leg, f.corners, f.outline);
  float step = SPACING * rig->reach * input->scale;
  ground_spot spot, other;
  int best = quality(rig, input, &f, wanted, &spot), found;
  sbf_vec3 way = sbri_sub(wanted, state->feet[leg].planted ? state->feet[leg].ground : state->feet[leg].from);
  way.y = 0;
  float length = sbri_length(way);
  way = sbri_normalize(way, sbri_headed(state, sbri_vec3(0, 0, 1)));
  /* Nearer and farther along its way, then back to where it came from. */
  for (int k = 1; best < 2 && k <= 6; k++) {
    float offset = step * (float)((k + 1) / 2) * (k % 2 ? -1.0f : 1.0f);
    if (-offset > length) continue;
    found = quality(rig, input, &f, sbri_add_scaled(wanted, way, offset), &other);
    if (found > best) best = found, spot = other;
  }
  for (int k = 1; best == 0 && k <= 4; k++) {
    found = quality(rig, input, &f, sbri_add_scaled(wanted, way, -length * 0.25f * (float)k), &other);
    if (found > best) best = found, spot = other;
  }
  *place = spot.place;
  *normal = spot.normal;
  return best > 0;
}
