/* Range and speed of feet, from the speed alone: there is no clock.
 *
 * A foot lands `half_m` ahead of its home and lifts off as far behind, so a stance lasts 2 half_m / speed. In
 * that time all other feet, or groups of feet, must step. While there is time for one after the other, they
 * do so, and the body stays balanced. At higher speed the feet of a group step together; at still higher
 * speed steps become shorter in time. */
#include "animation/gait/gait_state.h"
#include "shapes/ground.h"

static const float RANGE_USED = 0.75f;  /* fraction of a foot's range that a stride uses */
static const float MAX_LOWERING = 0.8f; /* fraction of the circle of an upright body; bounds its lowering */
static const float LEANING_HEIGHT =
    0.8f; /* minimum height of the hips of a leaning body, as a fraction of their own */
static const float AVAILABLE_RANGE = 1.0f; /* fraction of the mean range that is always available */
static const float STRIDE_S = 0.5f;        /* time over which the maximum stride is averaged */
static const float MAX_REACH = 0.97f;      /* fraction of the full reach */
static const float MIN_RANGE = 0.05f;      /* fraction of a leg's length: minimum range of a foot */
static const float ONE_BONE_RANGE = 0.25f; /* the same for a leg of one bone */
static const float STEP_INTERVAL = 1.15f;  /* time from step to step, in steps */
static const float LEAN_S = 0.12f;         /* time for the body to lean before a foot lifts off */
static const float LEAN_TWO_S = 0.5f;      /* the same with two legs */
static const float LEAN_SLOW_S = 0.36f;    /* the same at low speed, where it keeps balance */
static const float BALANCED_SPEED = 0.35f; /* reaches per second: maximum speed with balance */
static const float MAX_DURATION = 1.35f;   /* maximum duration of a fast step relative to the usual one */
static const float MIN_DURATION = 0.25f;   /* minimum duration of a step relative to the usual one */
static const float SLOWING_ERROR =
    0.002f; /* fraction of the reach: distance of a sole from its target from which on the body slows down */
static const float STOPPING_ERROR = 0.01f; /* additional distance at which it stops */
static const float BRAKING =
    1; /* reaches per squared duration of a step: deceleration for a foot at its reach */
static const float QUICK_BRAKING = 0.5f; /* factor of that duration for a foot that is about to lift off */
static const float SPEED_GAIN = 0.06f;   /* reaches per duration of a step: speed gained in half a step */
static const float MIN_NARROW = 1.15f;   /* half soles: minimum distance of feet from the middle */
static const uint32_t MANY_LEGS = 6;     /* number of legs from which on half of them suffice for balance */
static const float EVEN = 0.05f;         /* fraction of the reach: maximum height difference of even ground */
static const float STEEP = 0.85f;        /* cosine of the steepest slope that counts as even */
static const float PROBE = 0.5f;  /* fraction of the reach: distance at which the ground's rise is measured */
static const float RISING = 0.1f; /* minimum slope that moves the range of feet */

sbf_vec3 sbri_body_velocity(const sbri_gait_state *state) {
  sbf_vec3 v = sbri_body_to_world(state, sbri_vec3(state->motion.sideways, 0, state->motion.forward));
  if (state->stepping.pivot_leg) { /* rotation about a foot moves the body */
    sbf_vec3 arm = sbri_sub(state->motion.position, state->feet[state->stepping.pivot_leg - 1].ground);
    v.x += state->motion.turn * arm.z, v.z -= state->motion.turn * arm.x;
  }
  return v;
}

/* Bipeds place each foot close to the middle, so that the body need not lean far to be above it. This applies
 * to forward motion only, because sideways the feet would collide. */
static float narrowed(const sbri_rig *rig, const sbri_gait_state *state, uint32_t leg, float x) {
  if (rig->leg_count != 2 || rig->stand.has_one_bone_legs || state->stepping.in_groups) return x;
  float forward_square = state->motion.forward * state->motion.forward,
        sideways_square = state->motion.sideways * state->motion.sideways;
  float rotation_speed = state->motion.turn * rig->stand.spread,
        sum = forward_square + sideways_square + rotation_speed * rotation_speed;
  float min = MIN_NARROW * rig->legs[leg].sole.left;
  if (sum <= 0 || fabsf(x) <= min) return x;
  float min_x = x < 0 ? -min : min;
  return x + forward_square / sum * (min_x - x);
}

sbf_vec3 sbri_home_arm(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbf_vec3 home = rig->legs[leg].home.position;
  if (rig->legs[leg].home.chain_bone >= 0) {
    const sbr_transform *bone =
        &sbri_chain_bones(rig, (sbri_gait_state *)(uintptr_t)state)[rig->legs[leg].home.chain_bone].frame;
    home = sbri_rotate(bone->rotation, sbri_scale(rig->legs[leg].home.in_bone, input->scale));
    home = sbri_sub(sbri_add(bone->position, home), state->motion.position);
    return sbri_vec3(home.x, 0, home.z);
  }
  float width = rig->gait->step_width;
  if (state->stepping.standing_s == 0 && width > 0 && home.x != 0) home.x = home.x < 0 ? -width : width;
  if (state->stepping.standing_s == 0 && width == 0) home.x = narrowed(rig, state, leg, home.x);
  home.y = 0;
  return sbri_body_to_world(state, sbri_scale(home, input->scale));
}

sbf_vec3 sbri_home_velocity(const sbri_rig *rig, const sbri_gait_state *state, uint32_t leg, sbf_vec3 arm) {
  int32_t chain_bone = rig->legs[leg].home.chain_bone;
  if (chain_bone >= 0) {
    sbf_vec3 v = sbri_chain_bones(rig, (sbri_gait_state *)(uintptr_t)state)[chain_bone].velocity;
    return sbri_vec3(v.x, 0, v.z);
  }
  sbf_vec3 v = sbri_body_velocity(state);
  return sbri_vec3(v.x + state->motion.turn * arm.z, 0, v.z - state->motion.turn * arm.x);
}

float sbri_wanted_speed(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, const sbri_home *homes) {
  sbri_gait_state wanted = {.motion = {.heading_sine = state->motion.heading_sine,
                                .heading_cosine = state->motion.heading_cosine,
                                .forward = input->forward,
                                .sideways = input->sideways,
                                .turn = input->turn}};
  sbf_vec3 v = sbri_body_velocity(&wanted);
  float max = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    sbf_vec3 arm = homes[i].arm;
    float speed = sbri_length(sbri_vec3(v.x + input->turn * arm.z, 0, v.z - input->turn * arm.x));
    max = speed > max ? speed : max;
  }
  return max;
}

sbf_vec3 sbri_hip_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, const sbr_transform *root) {
  const sbri_leg *l = &rig->legs[leg];
  if (l->home.chain_bone >= 0) {
    const sbr_transform *bone =
        &sbri_chain_bones(rig, (sbri_gait_state *)(uintptr_t)state)[l->home.chain_bone].frame;
    sbf_vec3 own = sbri_scale(rig->bones.rest_local[l->upper].position, input->scale);
    return sbri_add(bone->position, sbri_rotate(bone->rotation, own));
  }
  return sbri_add(root->position, sbri_rotate(root->rotation, state->feet[leg].hip));
}

/* Vector from the hip to the ankle above `sole`, at the foot's height. */
static sbf_vec3 from_hip(const sbri_rig *rig, const sbri_gait_state *state, float scale, uint32_t leg,
    sbf_vec3 hip, sbf_vec3 sole, bool at_home) {
  const sbri_leg *l = &rig->legs[leg];
  const sbri_foot *foot = &state->feet[leg];
  sole.y = foot->ground.y + state->motion.position.y;
  return sbri_sub(
      at_home ? sbri_ankle_at_home(l, foot, sole, scale) : sbri_ankle_over(l, foot, sole, scale), hip);
}

/* Radius of the circle over the ground, about the hip, that a leg's foot can reach while its ankle is at
 * `from` relative to the hip; `offset` receives the horizontal offset of the ankle from the centre, and
 * `hip_height` the hip's height above it. */
static float reachable_circle(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 from, float lowered, sbf_vec3 *offset, float *hip_height) {
  const sbri_leg *l = &rig->legs[leg];
  float reach = MAX_REACH * (1 - l->length.soft_reach) * l->length.reach * input->scale;
  float upright = state->posture.lowered - from.y, level = reach * reach - upright * upright;
  float height = -lowered * from.y; /* the body is lowered for its feet */
  float min = upright - MAX_LOWERING * (level > 0 ? sqrtf(level) : 0);
  if (min > lowered * upright) min = lowered * upright;
  if (height < min) height = min;
  if (height < upright - state->balance.clearance.value)
    height = upright - state->balance.clearance.value; /* and at most to the belly's clearance */
  if (from.y > 0) height = from.y;
  *offset = sbri_vec3(from.x, 0, from.z);
  *hip_height = height;
  float square = reach * reach - height * height;
  return square > 0 ? sqrtf(square) : 0;
}

/* Distance from a point in a circle to its edge along a unit direction. */
static float distance_to_edge(sbf_vec3 offset, float radius, sbf_vec3 direction) {
  float along = sbri_dot(offset, direction),
        square = along * along - sbri_dot(offset, offset) + radius * radius;
  return (square > 0 ? sqrtf(square) : 0) - along;
}

/* The same on ground that rises: where a foot on it is as far from the hip as the leg reaches. */
static float distance_to_rising_edge(const sbri_foot_circle *circle, sbf_vec3 direction) {
  float rise = sbri_dot(circle->rise, direction);
  if (rise == 0) return distance_to_edge(circle->center, circle->radius, direction);
  float along = sbri_dot(circle->center, direction) - rise * circle->height, factor = 1 + rise * rise;
  float square =
      along * along + factor * (circle->radius * circle->radius - sbri_dot(circle->center, circle->center));
  return ((square > 0 ? sqrtf(square) : 0) - along) / factor;
}

/* How the ground rises along the body's velocity near a foot's home; `height` receives that of the ground at
 * the home. False on ground that is nearly level. */
static bool ground_rises(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    sbf_vec3 home, sbf_vec3 *rise, float *height) {
  double unused;
  float half = PROBE * rig->stand.reach * input->scale;
  if (sbri_ground_is_flat(input->ground, &unused)) return false;
  sbf_vec3 direction =
      sbri_normalize(sbri_body_velocity(state), sbri_body_to_world(state, sbri_vec3(0, 0, 1)));
  float front = sbri_ground_below(input, sbri_add_scaled(home, direction, half), NULL).y;
  float back = sbri_ground_below(input, sbri_add_scaled(home, direction, -half), NULL).y;
  float slope = (front - back) / (2 * half);
  *rise = sbri_scale(direction, slope);
  *height = 0.5f * (front + back);
  return fabsf(slope) > RISING;
}

sbri_foot_circle sbri_foot_circle_of(const sbri_rig *rig, const sbri_gait_state *state,
    const sbri_gait_input *input, uint32_t leg, sbf_vec3 arm) {
  const sbri_leg *l = &rig->legs[leg];
  sbri_foot_circle circle;
  sbf_vec3 hip = sbri_hip_of(rig, state, input, leg, &state->posture.root), rise;
  sbf_vec3 home = sbri_add(state->motion.position, arm);
  float ground;
  bool rises = rig->leg_count == 2 && ground_rises(rig, state, input, home, &rise, &ground);
  sbf_vec3 from = from_hip(rig, state, input->scale, leg, hip, home, true);
  if (rises) from.y += ground - state->feet[leg].ground.y;
  float radius = reachable_circle(rig, state, input, leg, from, SBRI_LOWERED, &circle.center, &circle.height);
  circle.rise = rises ? rise : sbri_vec3(0, 0, 0);
  float length = (l->length.upper + l->length.lower) * input->scale, offset = sbri_length(circle.center);
  if (l->lower < 0) radius = offset + ONE_BONE_RANGE * length;
  circle.radius = radius < offset + MIN_RANGE * length ? offset + MIN_RANGE * length : radius;
  return circle;
}

/* Maximum distance of a foot ahead of its home and behind, m. */
typedef struct foot_range {
  float ahead, behind;
} foot_range;
static foot_range foot_range_of(const sbri_foot_circle *circle, sbf_vec3 direction) {
  return (foot_range){RANGE_USED * distance_to_rising_edge(circle, direction),
      RANGE_USED * distance_to_rising_edge(circle, sbri_scale(direction, -1))};
}

float sbri_landing_distance(const sbri_foot_circle *circle, sbf_vec3 direction, float half) {
  foot_range max = foot_range_of(circle, direction);
  float middle = 0.5f * (max.ahead - max.behind), widest = 0.5f * (max.ahead + max.behind);
  if (half >= widest) return max.ahead;
  float ahead = half + middle * sbri_smooth(2 * half / widest - 1); /* wide strides are centred at the hip */
  if (ahead > max.ahead) return max.ahead;
  return 2 * half - ahead > max.behind ? 2 * half - max.behind : ahead;
}

/* Velocity of each leg's home and the range of its foot. Returns half of the widest stride that all legs can
 * take, m. */
static float compute_homes(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, sbri_stride *s) {
  float max = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    sbri_home *home = &s->homes[i];
    home->arm = sbri_home_arm(rig, state, input, i);
    home->velocity = sbri_home_velocity(rig, state, i, home->arm);
    home->speed = sbri_length(home->velocity);
    home->circle = sbri_foot_circle_of(rig, state, input, i, home->arm);
    s->speed = home->speed > s->speed ? home->speed : s->speed;
    sbf_vec3 direction = sbri_normalize(home->velocity, sbri_body_to_world(state, sbri_vec3(0, 0, 1)));
    foot_range own = foot_range_of(&home->circle, direction);
    float half = 0.5f * (own.ahead + own.behind);
    max = i == 0 || half < max ? half : max;
  }
  return max;
}

/* A plane through the ground below the body. */
typedef struct ground_plane {
  sbf_vec3 position, normal;
} ground_plane;

static float height_above(const ground_plane *plane, sbf_vec3 point) {
  return sbri_dot(sbri_sub(point, plane->position), plane->normal) / plane->normal.y;
}

/* Whether all feet stand at one height above the plane, or go there. */
static bool feet_stand_on(
    const sbri_rig *rig, const sbri_gait_state *state, float scale, const ground_plane *plane) {
  float low = 1e30f, high = -1e30f;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    const sbri_foot *foot = &state->feet[i];
    float height = height_above(plane, foot->planted ? foot->ground : foot->step.to);
    low = height < low ? height : low, high = height > high ? height : high;
  }
  return high - low < EVEN * rig->stand.reach * scale;
}

bool sbri_are_feet_level(const sbri_rig *rig, const sbri_gait_state *state, float scale) {
  ground_plane level = {.normal = {0, 1, 0}};
  return feet_stand_on(rig, state, scale, &level);
}

/* Whether the ground is the plane from one leg's length behind to two ahead. */
static bool ground_goes_on(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const ground_plane *plane) {
  float reach = rig->stand.reach * input->scale;
  sbf_vec3 direction =
      sbri_normalize(sbri_body_velocity(state), sbri_body_to_world(state, sbri_vec3(0, 0, 1)));
  for (int k = -1; k <= 2; k++) {
    sbf_vec3 at = sbri_add_scaled(state->motion.position, direction, (float)k * reach);
    if (fabsf(height_above(plane, sbri_ground_below(input, at, NULL))) > EVEN * reach) return false;
  }
  return true;
}

/* Whether it stands on a large area of even ground: level or, with two legs, sloped. */
static bool is_even(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  double unused;
  if (sbri_ground_is_flat(input->ground, &unused)) return true;
  ground_plane level = {.normal = {0, 1, 0}}, slope;
  for (uint32_t i = 0; i < rig->leg_count; i++)
    level.position.y += state->feet[i].ground.y / (float)rig->leg_count;
  if (ground_goes_on(rig, state, input, &level) && feet_stand_on(rig, state, input->scale, &level))
    return true;
  if (rig->leg_count != 2) return false;
  slope.position = sbri_ground_below(input, state->motion.position, &slope.normal);
  return slope.normal.y > STEEP && slope.normal.y < 1 && ground_goes_on(rig, state, input, &slope) &&
         feet_stand_on(rig, state, input->scale, &slope);
}

sbri_stride sbri_stride_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  sbri_stride s = {0};
  float max = compute_homes(rig, state, input, &s);
  if (state->stepping.max_half_m > 0)
    max = state->stepping.max_half_m + (max - state->stepping.max_half_m) * input->tick_s / STRIDE_S;
  s.max_half_m = max;
  max *= AVAILABLE_RANGE;
  float usual = rig->gait->step_duration,
        needed_s = state->stepping.step_s > usual ? state->stepping.step_s : usual;
  float groups = (float)(rig->stand.group_count > 1 ? rig->stand.group_count : 2);
  float turns = rig->leg_count < MANY_LEGS ? (float)rig->leg_count : groups;
  float wanted = sbri_wanted_speed(rig, state, input, s.homes), fastest = wanted > s.speed ? wanted : s.speed;
  bool quick = fastest > BALANCED_SPEED * rig->stand.reach * input->scale,
       slow = !quick && rig->leg_count < MANY_LEGS;
  float lean_two_s = slow ? LEAN_SLOW_S : LEAN_TWO_S;
  float lean_s = rig->leg_count == 2 ? lean_two_s : rig->leg_count < MANY_LEGS ? LEAN_S : 0;
  float turn_time_s = 0.5f * (turns - 1) * (STEP_INTERVAL * needed_s + lean_s),
        sequential_half = turn_time_s * s.speed;
  s.in_groups = (turns > groups || rig->leg_count == 2) &&
                turn_time_s * fastest > (state->stepping.in_groups ? 0.62f : 0.74f) * max;
  s.balanced = slow;
  s.running = quick && rig->leg_count >= MANY_LEGS && !rig->chains.count &&
              sbri_are_feet_level(rig, state, input->scale);
  if (slow) s.in_groups = false;
  if (rig->stand.has_one_bone_legs) s.in_groups = true; /* rigid legs cannot follow a leaning body */
  float step_s = usual < 0.4f ? usual : 0.4f,
        soon = s.speed + SPEED_GAIN * rig->stand.reach * input->scale / step_s;
  float aimed = state->stepping.step_limit * fastest;
  if (soon > aimed) soon = s.speed > aimed ? s.speed : aimed;
  s.even = is_even(rig, state, input);
  if (!s.even) soon = s.speed;
  float half_per_second =
      0.5f * s.speed * (groups - 1) * STEP_INTERVAL; /* half a stride per second of a step's duration */
  s.available_s = half_per_second > 0 ? max / half_per_second : 1e6f;
  s.duration_s = usual;
  float needed = sequential_half;
  if (slow && !s.in_groups) { /* prefers low speed to loss of balance */
    float half_per_step = 0.5f * s.speed * (turns - 1);
    if (half_per_step > 0) s.available_s = max / half_per_step - lean_s;
    if (needed > max) needed = max;
  } else if (s.in_groups || needed > max) { /* uses all available time: quick steps are harder */
    float longest = MAX_DURATION * usual > needed_s ? MAX_DURATION * usual : needed_s;
    float widest = SBRI_WIDEST * rig->stand.reach * input->scale /
                   (1 + (groups - 1) * STEP_INTERVAL); /* during a step */
    if (s.even && longest * soon > widest) longest = widest / soon;
    float speed_ratio = s.speed > 0 ? soon / s.speed : 1;
    s.duration_s = sbri_clamp(0.9f * s.available_s / speed_ratio, MIN_DURATION * usual, longest);
    needed = half_per_second * speed_ratio * s.duration_s;
    if (needed > max) needed = max;
  }
  float trigger = rig->gait->step_trigger * input->scale;
  s.half_m = needed > trigger ? needed : trigger < max ? trigger : max;
  s.spacing_m = (2 * s.half_m + s.speed * s.duration_s) / (s.in_groups ? groups : turns);
  return s;
}

float sbri_home_distance_fraction(const sbri_gait_state *state, const sbri_home *home, uint32_t leg) {
  sbf_vec3 offset = sbri_sub(state->feet[leg].ground, sbri_add(state->motion.position, home->arm));
  offset.y = 0;
  float distance = sbri_length(offset);
  if (distance <= 0) return 0;
  float circle = distance_to_edge(home->circle.center, home->circle.radius, sbri_scale(offset, 1 / distance));
  return distance / (circle > 1e-6f ? circle : 1e-6f);
}

/* The circle of allowed positions of a leg's foot. */
static sbri_foot_circle stance_circle(const sbri_rig *rig, const sbri_gait_state *state,
    const sbri_gait_input *input, uint32_t leg, sbf_vec3 arm, float lowered) {
  const sbri_leg *l = &rig->legs[leg];
  sbri_foot_circle stance;
  sbf_vec3 home = sbri_add(state->motion.position, arm);
  sbf_vec3 hip = sbri_hip_of(rig, state, input, leg, &state->posture.root);
  sbf_vec3 from = from_hip(rig, state, input->scale, leg, hip, state->feet[leg].ground, false);
  float radius = reachable_circle(rig, state, input, leg, from, lowered, &stance.center, &stance.height);
  stance.rise = sbri_vec3(0, 0, 0);
  sbf_vec3 offset = from_hip(rig, state, input->scale, leg, hip, home, true);
  offset.y = 0;
  float length = (l->length.upper + l->length.lower) * input->scale, rest = sbri_length(offset);
  if (l->lower < 0) radius = rest + ONE_BONE_RANGE * length;
  stance.radius = radius < rest + MIN_RANGE * length ? rest + MIN_RANGE * length : radius;
  return stance;
}

float sbri_remaining_reach(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 direction) {
  sbf_vec3 arm = sbri_home_arm(rig, state, input, leg);
  sbri_foot_circle stance = stance_circle(rig, state, input, leg, arm, LEANING_HEIGHT);
  return distance_to_edge(stance.center, stance.radius, sbri_scale(direction, -1));
}

/* Remaining travel of a planted leg until the end of its reach, if its home moves at `speed`; m. */
static float remaining_travel(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, float *speed) {
  sbf_vec3 arm = sbri_home_arm(rig, state, input, leg), v = sbri_home_velocity(rig, state, leg, arm);
  *speed = sbri_length(v);
  if (*speed <= 0) return 0;
  sbf_vec3 displacement = sbri_scale(v, 1 / *speed);
  sbri_foot_circle stance = stance_circle(rig, state, input, leg, arm, SBRI_LOWERED);
  float left = distance_to_edge(stance.center, stance.radius, sbri_scale(displacement, -1));
  float rotation =
      left > 0 ? sbri_clamp(state->motion.turn * left / *speed, -2, 2) : 0; /* rotation until then */
  if (rotation != 0)
    left = distance_to_edge(
        stance.center, stance.radius, sbri_scale(sbri_rotate_yaw(displacement, 0.5f * rotation), -1));
  return left > 0 ? left : 0;
}

float sbri_sustainable_fraction(const sbri_rig *rig, const sbri_gait_state *state,
    const sbri_gait_input *input, uint32_t leg, float in_s) {
  float min = 1, speed;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (!state->feet[i].planted) continue;
    if ((state->stepping.in_groups || state->stepping.quick) &&
        rig->legs[i].group == rig->legs[leg].group) { /* this foot steps too, if it is behind */
      sbf_vec3 arm = sbri_home_arm(rig, state, input, i);
      sbf_vec3 behind = sbri_sub(sbri_add(state->motion.position, arm), state->feet[i].ground);
      if (sbri_dot(behind, sbri_home_velocity(rig, state, i, arm)) > 0) continue;
    }
    float left = remaining_travel(rig, state, input, i, &speed);
    if (left < min * speed * in_s) min = left / (speed * in_s);
  }
  return min;
}

float sbri_max_speed_fraction(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, float *sustainable) {
  float min = 1, speed, in_air_s = 0, step_s = rig->leg_count ? rig->gait->step_duration : 1;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    float left_s =
        state->feet[i].planted ? 0 : (1 - state->feet[i].step.phase) * state->feet[i].step.duration_s;
    in_air_s = left_s > in_air_s ? left_s : in_air_s;
  }
  /* Feet that step together lift off as soon as the others have landed. */
  float braking_s = state->stepping.quick ? QUICK_BRAKING * step_s : step_s;
  float braking = BRAKING * rig->stand.reach * input->scale / (braking_s * braking_s);
  *sustainable = 1;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (!state->feet[i].planted) continue;
    float left = remaining_travel(rig, state, input, i, &speed), missed = state->feet[i].reach_error;
    if (speed <= 0) continue;
    missed /= rig->stand.reach * input->scale;
    if (missed > SLOWING_ERROR && 1 - (missed - SLOWING_ERROR) / STOPPING_ERROR < min)
      min = 1 - (missed - SLOWING_ERROR) / STOPPING_ERROR;
    float max = sqrtf(2 * braking * left);
    if (max < min * speed) min = max / speed;
    if (left < *sustainable * speed * in_air_s) *sustainable = left / (speed * in_air_s);
  }
  return min > 0 ? min : 0;
}
