/* Poses keyed by the distance walked, below the gait: the walk for the speed, or a blend of the two nearest
 * ones. */
#include "animation/gait/gait_state.h"

static const float FULL_AT =
    0.5f; /* fraction of the walking speed from which on a walk has its full weight */
static const float CATCH_UP =
    4; /* rate of phase correction per cycle: most of an error is corrected in half a cycle */
static const float MAX_CATCH = 0.5f; /* maximum correction as a fraction of the phase's own progress: it never
                                        runs backwards or twice as fast */
static const float MIN_STEP = 0.4f,
                   MAX_STEP = 2.5f; /* accepted length of a step, in half cycles of the poses */

/* The walks below and above a speed, and the weight of the second. */
static float find_walks(const sbri_walks *walks, float speed, const sbri_walk **low, const sbri_walk **high) {
  uint32_t k = 0;
  while (k + 1 < walks->walk_count && walks->walks[k + 1].speed <= speed) k++;
  *low = &walks->walks[k];
  *high = &walks->walks[k + 1 < walks->walk_count ? k + 1 : k];
  float span = (*high)->speed - (*low)->speed;
  return span > 0 ? sbri_clamp((speed - (*low)->speed) / span, 0, 1) : 0;
}

/* In asset metres per second. */
static float speed_of(const sbri_gait_state *state, float scale) {
  return sqrtf(state->motion.forward * state->motion.forward +
               state->motion.sideways * state->motion.sideways) *
         state->stepping.speed_fraction / scale;
}

/* At a landing: updates the phase error of the walk, and the length of half a cycle. */
static void synchronise(const sbri_walks *walks, sbri_gait_state *state, float half_cycle_m) {
  const int32_t legs[2] = {walks->first_leg, walks->other_leg};
  for (int half = 0; half < 2 && legs[half] >= 0; half++) {
    const sbri_foot *foot = &state->feet[legs[half]];
    if (!foot->planted || foot->was_planted) continue;
    state->walk.lead = sbri_wrap(state->walk.phase - 0.5f * (float)half + 0.5f, 1) - 0.5f;
    float walked = state->walk.since_m;
    bool other = state->walk.landed_leg == (uint32_t)(2 - half); /* steps alternate */
    state->walk.half_m =
        other && walked > MIN_STEP * half_cycle_m && walked < MAX_STEP * half_cycle_m ? walked : 0;
    state->walk.landed_leg = (uint32_t)half + 1;
    state->walk.since_m = 0;
  }
}

void sbri_walk_tick(const sbri_rig *rig, sbri_gait_state *state, float walked_m, float scale) {
  const sbri_walks *walks = &rig->walks;
  if (!walks->walk_count) return;
  const sbri_walk *low, *high;
  float t = find_walks(walks, speed_of(state, scale), &low, &high);
  float cycle = low->cycle_m + t * (high->cycle_m - low->cycle_m);
  bool backwards = state->motion.forward < 0 && -state->motion.forward > fabsf(state->motion.sideways);
  walked_m /= scale;
  state->walk.since_m += walked_m;
  if (low->mirrored) synchronise(walks, state, 0.5f * cycle);
  if (state->stepping.standing_s > 0) state->walk.half_m = 0, state->walk.landed_leg = 0;
  float fraction = walked_m / (low->mirrored && state->walk.half_m > 0 ? 2 * state->walk.half_m : cycle);
  if (low->mirrored && !backwards) {
    float max = MAX_CATCH * fraction,
          correction = sbri_clamp(CATCH_UP * state->walk.lead * fraction, -max, max);
    fraction -= correction;
    state->walk.lead -= correction;
  }
  state->walk.phase = sbri_wrap(state->walk.phase + (backwards ? -fraction : fraction), 1);
}

/* Four frames about a phase with their weights. */
typedef struct sbri_between {
  const sbri_walk_frame *frames[4];
  float weights[4];
} sbri_between;

/* Cubic through the frames with the slopes of Catmull and Rom (1974), so that hips and shoulders move
 * smoothly. */
static sbri_between frames_at(const sbri_walk *walk, float phase) {
  sbri_between b;
  float times[4];
  int32_t count = (int32_t)walk->frame_count, k = 0;
  while (k + 1 < count && walk->frames[k].at <= phase) k++;
  for (int32_t i = 0; i < 4; i++) {
    int32_t index = k - 2 + i, turns = 0;
    while (index < 0) index += count, turns--;
    while (index >= count) index -= count, turns++;
    b.frames[i] = &walk->frames[index];
    times[i] = b.frames[i]->at + (float)turns;
  }
  float span = times[2] - times[1], t = sbri_clamp((phase - times[1]) / span, 0, 1), u = 1 - t;
  float incoming = t * u * u * span / (times[2] - times[0]),
        outgoing = -t * t * u * span / (times[3] - times[1]);
  float later = t * t * (3 - 2 * t);
  b.weights[0] = -incoming, b.weights[1] = 1 - later - outgoing, b.weights[2] = later + incoming,
  b.weights[3] = outgoing;
  return b;
}

static sbri_posed_bone posed_at(const sbri_between *b, uint32_t bone) {
  sbf_quat first = b->frames[1]->bones[bone].rotation;
  sbri_posed_bone sum = {{0, 0, 0}, {0, 0, 0, 0}};
  for (int i = 0; i < 4; i++) {
    const sbri_posed_bone *at = &b->frames[i]->bones[bone];
    sbf_quat q = at->rotation;
    float along = q.x * first.x + q.y * first.y + q.z * first.z + q.w * first.w;
    float weight = along < 0 ? -b->weights[i] : b->weights[i];
    sum.translation = sbri_add_scaled(sum.translation, at->translation, b->weights[i]);
    sum.rotation = (sbf_quat){sum.rotation.x + weight * q.x, sum.rotation.y + weight * q.y,
        sum.rotation.z + weight * q.z, sum.rotation.w + weight * q.w};
  }
  sum.rotation = sbri_quat_normalize(sum.rotation);
  return sum;
}

void sbri_walk_pose(const sbri_rig *rig, const sbri_gait_state *state, float scale, sbr_transform *locals) {
  const sbri_walks *walks = &rig->walks;
  float usual = (rig->gait ? rig->gait->walk_speed : 0.5f) * FULL_AT, speed = speed_of(state, scale);
  float weight = sbri_clamp(speed / usual, 0, 1);
  if (!walks->walk_count || weight <= 0) return;
  const sbri_walk *pair[2];
  sbri_between frames[2];
  float upper = find_walks(walks, speed, &pair[0], &pair[1]);
  for (int i = 0; i < 2; i++) frames[i] = frames_at(pair[i], state->walk.phase);
  for (uint32_t j = 0; j < walks->bone_count; j++) {
    sbri_posed_bone at[2];
    for (int i = 0; i < 2; i++) at[i] = posed_at(&frames[i], j);
    uint32_t bone = walks->bones[j];
    sbf_quat rotation = sbri_quat_blend(at[0].rotation, at[1].rotation, upper);
    sbf_vec3 direction = sbri_lerp(at[0].translation, at[1].translation, upper);
    const sbr_transform *rest = &rig->bones.base_local[bone];
    sbr_transform *local = &locals[bone];
    local->position = sbri_lerp(local->position, sbri_add(rest->position, direction), weight);
    local->rotation = sbri_quat_blend(local->rotation, sbri_quat_multiply(rest->rotation, rotation), weight);
  }
}
