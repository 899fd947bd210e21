/* Footholds. A foot does not stand across an edge, on a steep slope or on a step that is too high. Searches
 * near the wanted position only. */
#include "animation/gait/gait_state.h"
#include "shapes/ground.h"

static const float STEEPEST = 0.6f; /* minimum cosine of the slope */
static const float HIGHEST = 0.6f;  /* fraction of the reach: maximum height difference to the other feet */
static const float AROUND = 1.15f;  /* checked area as a multiple of the sole */
static const float UNEVEN = 0.03f;  /* fraction of the reach: maximum distance of the ground from a plane */
static const float SPACING = 0.1f;  /* fraction of the reach: distance of candidates */

typedef struct ground_spot {
  sbf_vec3 position, normal;
} ground_spot;

/* Query of a foothold: approximate height and the corners of the sole. */
typedef struct footing {
  float level;
  sbf_vec3 corners[4], outline[4];
} footing;

/* Mean height of the other feet. */
static float level_of(const sbri_rig *rig, const sbri_gait_state *state) {
  float sum = 0, count = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++)
    if (state->feet[i].planted) sum += state->feet[i].ground.y, count += 1;
  return count > 0 ? sum / count : state->motion.position.y;
}

/* Fits a sole to the ground like a board: tilted to the slope under its corners, on the highest point below
 * it. Returns the distance of the ground from that plane. If it is above `uneven`, as across an edge, the
 * sole follows the ground under its middle. */
static float fit_sole(
    const sbri_gait_input *input, const sbf_vec3 corners[4], float uneven, ground_spot *spot) {
  float heights[4], rise = 0, worst = 0;
  for (int k = 0; k < 4; k++)
    heights[k] = sbri_ground_below(input, sbri_add(spot->position, corners[k]), NULL).y - spot->position.y;
  /* Corners surround the middle in pairs, so differences along both axes give the slopes. */
  sbf_vec3 fore = sbri_sub(sbri_add(corners[2], corners[3]), sbri_add(corners[0], corners[1]));
  sbf_vec3 left = sbri_sub(sbri_add(corners[1], corners[3]), sbri_add(corners[0], corners[2]));
  float forward = heights[2] + heights[3] - heights[0] - heights[1];
  float right = heights[1] + heights[3] - heights[0] - heights[2];
  sbf_vec3 slope = sbri_add(
      sbri_scale(fore, forward / sbri_dot(fore, fore)), sbri_scale(left, right / sbri_dot(left, left)));
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
  spot->position.y += rise;
  return worst;
}

/* On curved ground the highest points may lie between the corners. */
static void raise_to_highest(const sbri_gait_input *input, const sbf_vec3 corners[4], ground_spot *spot) {
  static const int edges[4][2] = {{0, 1}, {1, 3}, {3, 2}, {2, 0}};
  float rise = 0;
  for (int k = 0; k < 4; k++) {
    sbf_vec3 at = sbri_lerp(corners[edges[k][0]], corners[edges[k][1]], 0.5f);
    float plane = -(spot->normal.x * at.x + spot->normal.z * at.z) / spot->normal.y;
    float over = sbri_ground_below(input, sbri_add(spot->position, at), NULL).y - spot->position.y - plane;
    rise = over > rise ? over : rise;
  }
  spot->position.y += rise;
}

/* Corners of a leg's sole, slightly enlarged, in the landing pose; and of the whole foot if requested. */
static void find_corners(const sbri_rig *rig, const sbri_gait_state *state, float scale, uint32_t leg,
    sbf_vec3 corners[4], sbf_vec3 *outline) {
  const sbri_sole *sole = &rig->legs[leg].sole;
  const sbri_foot *foot = &state->feet[leg];
  float rotation = foot->planted ? 0
                                 : state->motion.turn * state->stepping.speed_fraction *
                                       (1 - foot->step.phase) * foot->step.duration_s;
  for (int k = 0; k < 4; k++) {
    sbf_vec3 corner = {k & 1 ? sole->left : sole->right, 0, k & 2 ? sole->toe : sole->heel};
    if (rotation != 0) corner = sbri_rotate_yaw(corner, rotation); /* with the body's heading at landing */
    corners[k] = sbri_body_to_world(state, sbri_scale(corner, AROUND * scale));
    if (!outline) continue;
    corner = sbri_vec3(sole->outline[k & 1 ? 0 : 1], 0, sole->outline[k & 2 ? 2 : 3]);
    if (rotation != 0) corner = sbri_rotate_yaw(corner, rotation);
    outline[k] = sbri_body_to_world(state, sbri_scale(corner, scale));
  }
}

void sbri_set_sole_on_ground(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 *position, sbf_vec3 *normal) {
  ground_spot spot;
  sbf_vec3 corners[4];
  double level;
  spot.position = sbri_ground_below(input, *position, &spot.normal);
  find_corners(rig, state, input->scale, leg, corners, NULL);
  if (!sbri_ground_is_flat(input->ground, &level)) {
    float uneven = UNEVEN * rig->stand.reach * input->scale;
    bool even = fit_sole(input, corners, uneven, &spot) <= uneven;
    if (even) raise_to_highest(input, corners, &spot);
  }
  *position = spot.position;
  *normal = spot.normal;
}

/* Quality of a foothold: 2 good, 1 uneven, 0 unusable. */
static int quality(
    const sbri_rig *rig, const sbri_gait_input *input, const footing *f, sbf_vec3 wanted, ground_spot *spot) {
  float reach = rig->stand.reach * input->scale;
  double level;
  spot->position = sbri_ground_below(input, wanted, &spot->normal);
  if (spot->normal.y < STEEPEST || fabsf(spot->position.y - f->level) > HIGHEST * reach) return 0;
  if (sbri_ground_is_flat(input->ground, &level)) return 2;
  if (fit_sole(input, f->corners, UNEVEN * reach, spot) > UNEVEN * reach) return 1;
  for (int k = 0; k < 4; k++) { /* no obstacle beside the sole that the rest of the foot would penetrate */
    float plane = -(spot->normal.x * f->outline[k].x + spot->normal.z * f->outline[k].z) / spot->normal.y;
    float high = sbri_ground_below(input, sbri_add(spot->position, f->outline[k]), NULL).y - spot->position.y;
    if (high - plane > 2 * UNEVEN * reach) return 1;
  }
  return 2;
}

bool sbri_can_stand(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 position, bool is_good) {
  footing f = {.level = level_of(rig, state)};
  ground_spot spot;
  find_corners(rig, state, input->scale, leg, f.corners, f.outline);
  return quality(rig, input, &f, position, &spot) >= (is_good ? 2 : 1);
}

bool sbri_find_foothold(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 wanted, sbf_vec3 *position, sbf_vec3 *normal) {
  footing f = {.level = level_of(rig, state)};
  find_corners(rig, state, input->scale, leg, f.corners, f.outline);
  float step = SPACING * rig->stand.reach * input->scale;
  ground_spot spot, other;
  int best = quality(rig, input, &f, wanted, &spot), found;
  sbf_vec3 direction =
      sbri_sub(wanted, state->feet[leg].planted ? state->feet[leg].ground : state->feet[leg].step.from);
  direction.y = 0;
  float length = sbri_length(direction);
  direction = sbri_normalize(direction, sbri_body_to_world(state, sbri_vec3(0, 0, 1)));
  /* Candidates along the path, nearer and farther, then back to the start. */
  for (int k = 1; best < 2 && k <= 6; k++) {
    float offset = step * (float)((k + 1) / 2) * (k % 2 ? -1.0f : 1.0f);
    if (-offset > length) continue;
    found = quality(rig, input, &f, sbri_add_scaled(wanted, direction, offset), &other);
    if (found > best) best = found, spot = other;
  }
  for (int k = 1; best == 0 && k <= 4; k++) {
    found = quality(rig, input, &f, sbri_add_scaled(wanted, direction, -length * 0.25f * (float)k), &other);
    if (found > best) best = found, spot = other;
  }
  *position = spot.position;
  *normal = spot.normal;
  return best > 0;
}
