#include "animation/gait/gait.h"

#include <math.h>
#include <string.h>

#include "gait_stage.h"
#include "harness.h"
#include "math/quat.h"
#include "quadruped.h"
#include "sbfmt/asset.h"

enum { MAX_BONES = 32, TICKS_A_SECOND = 60 };

typedef struct walk {
  gait_stage on;
  uint32_t events;
  float worst_slip, worst_stretch, max_lift;
  uint32_t opposite_in_air;
  sbf_vec3 stance[4];
  bool was_planted[4];
} walk;

static double flat(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)x;
  (void)z;
  *normal = (sbf_vec3){0, 1, 0};
  return ground->parameters[0];
}

static double slope(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)x;
  double rise = ground->parameters[0], length = sqrt(1 + rise * rise);
  *normal = (sbf_vec3){0, (float)(1 / length), (float)(-rise / length)};
  return z * rise;
}

static void begin(
    walk *w, double (*height)(const sbr_ground *, double, double, sbf_vec3 *), double parameter) {
  memset(w, 0, sizeof *w);
  gait_stage_begin_on(&w->on, quadruped_asset(), height, parameter);
}

static float length_between(const walk *w, uint32_t a, uint32_t b) {
  return sbri_length(sbri_sub(w->on.pose[a].position, w->on.pose[b].position));
}

/* Steps one tick and updates the measurements that all walks are checked by. */
static void tick(walk *w) {
  sbri_gait_event events[16];
  w->events += sbri_gait_tick(&w->on.rig, w->on.state, &w->on.input, w->on.pose, events, 16);
  sbr_leg_state legs[4];
  ck_assert_uint_eq(sbri_gait_legs(&w->on.rig, w->on.state, 1, legs, 4), 4);
  uint32_t groups = 0;
  for (int l = 0; l < 4; l++) {
    const sbri_leg *leg = &w->on.rig.legs[l];
    sbf_vec3 ankle = w->on.pose[leg->foot].position;
    if (legs[l].planted && !w->was_planted[l]) w->stance[l] = ankle;
    w->was_planted[l] = legs[l].planted;
    if (legs[l].planted) {
      float slip = sbri_length(sbri_sub(ankle, w->stance[l]));
      if (slip > w->worst_slip) w->worst_slip = slip;
    } else {
      groups |= 1u << leg->group;
      if (legs[l].foot.y > w->max_lift) w->max_lift = legs[l].foot.y;
    }
    float upper = length_between(w, (uint32_t)leg->upper, (uint32_t)leg->lower) - leg->length.upper;
    float lower = length_between(w, (uint32_t)leg->lower, (uint32_t)leg->foot) - leg->length.lower;
    w->worst_stretch = fmaxf(w->worst_stretch, fmaxf(fabsf(upper), fabsf(lower)));
  }
  w->opposite_in_air += groups == 3;
  for (uint32_t i = 0; i < w->on.rig.bones.count; i++) {
    ck_assert(isfinite(w->on.pose[i].position.x) && isfinite(w->on.pose[i].rotation.w));
    ck_assert_float_eq_tol(w->on.pose[i].rotation.x * w->on.pose[i].rotation.x +
                               w->on.pose[i].rotation.y * w->on.pose[i].rotation.y +
                               w->on.pose[i].rotation.z * w->on.pose[i].rotation.z +
                               w->on.pose[i].rotation.w * w->on.pose[i].rotation.w,
        1, 1e-4f);
  }
}

static void run(walk *w, double seconds, float forward, float sideways, float turn) {
  w->on.input.forward = forward;
  w->on.input.sideways = sideways;
  w->on.input.turn = turn;
  for (int i = 0; i < (int)(seconds * TICKS_A_SECOND + 0.5); i++) tick(w);
}

static void expect_good_walk(const walk *w, uint32_t steps) {
  sbr_leg_state legs[4];
  sbri_gait_legs(&w->on.rig, w->on.state, 1, legs, 4);
  for (int l = 0; l < 4; l++) ck_assert_uint_ge(legs[l].steps_taken, steps);
  ck_assert_float_le(w->worst_slip, 1e-4f);
  ck_assert_float_le(w->worst_stretch, 1e-5f);
  ck_assert_uint_eq(w->opposite_in_air, 0);
}

START_TEST(standing_is_the_rest_pose)
{
  walk w;
  begin(&w, flat, 0);
  run(&w, 1, 0, 0, 0);
  for (uint32_t i = 0; i < w.on.rig.bones.count; i++) {
    ck_assert_float_le(sbri_length(sbri_sub(w.on.pose[i].position, w.on.rig.bones.rest[i].position)), 2e-5f);
    sbf_quat a = w.on.pose[i].rotation, b = w.on.rig.bones.rest[i].rotation;
    ck_assert_float_ge(fabsf(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w), 0.99999f);
  }
  ck_assert_uint_eq(w.events, 0);
  gait_stage_end(&w.on);
}
END_TEST

START_TEST(walks_forward_step_by_step)
{
  walk w;
  begin(&w, flat, 0);
  run(&w, 10, 0.3f, 0, 0);
  expect_good_walk(&w, 8);
  sbf_vec3 position;
  float heading;
  sbri_gait_get_placement(w.on.state, &position, &heading);
  ck_assert_float_eq_tol(position.z, 3, 0.1f);
  ck_assert_double_eq_tol(sbri_gait_distance(w.on.state), 3, 0.1);
  ck_assert_float_eq_tol(w.max_lift, 0.04f, 0.002f);
  ck_assert_uint_gt(w.events, 60);
  gait_stage_end(&w.on);
}
END_TEST

START_TEST(walks_backward_sideways_and_in_curves)
{
  const float drives[][3] = {{-0.25f, 0, 0}, {0, 0.15f, 0}, {0, 0, 0.8f}, {0.3f, 0, 0.6f}, {0.3f, 0, -0.6f}};
  for (size_t d = 0; d < sizeof drives / sizeof *drives; d++) {
    walk w;
    begin(&w, flat, 0);
    run(&w, 10, drives[d][0], drives[d][1], drives[d][2]);
    expect_good_walk(&w, 4);
    gait_stage_end(&w.on);
  }
}
END_TEST

START_TEST(feet_return_home_when_it_stops)
{
  walk w;
  begin(&w, flat, 0);
  run(&w, 3, 0.3f, 0, 0.3f);
  run(&w, 4, 0, 0, 0);
  sbf_vec3 position;
  float heading;
  sbri_gait_get_placement(w.on.state, &position, &heading);
  sbr_leg_state legs[4];
  sbri_gait_legs(&w.on.rig, w.on.state, 1, legs, 4);
  for (int l = 0; l < 4; l++) {
    sbf_quat rotation = {0, sinf(heading / 2), 0, cosf(heading / 2)};
    sbf_vec3 home = w.on.rig.legs[l].home.position;
    home.y = 0;
    home = sbri_add(position, sbri_rotate(rotation, home));
    ck_assert(legs[l].planted);
    ck_assert_float_le(sbri_length(sbri_sub(legs[l].foot, home)), 0.012f);
  }
  ck_assert_float_le(w.worst_slip, 1e-4f);
  gait_stage_end(&w.on);
}
END_TEST

START_TEST(feet_stand_on_a_slope_and_the_body_follows)
{
  walk w;
  begin(&w, slope, 0.3);
  run(&w, 8, 0.25f, 0, 0);
  expect_good_walk(&w, 5);
  sbr_leg_state legs[4];
  sbri_gait_legs(&w.on.rig, w.on.state, 1, legs, 4);
  for (int l = 0; l < 4; l++)
    if (legs[l].planted) ck_assert_float_eq_tol(legs[l].foot.y, 0.3f * legs[l].foot.z, 1e-4f);
  sbf_vec3 chest = w.on.pose[3].position, hips = w.on.pose[1].position;
  ck_assert_float_gt(chest.y - hips.y, 0.08f); /* uphill, the chest is higher */
  gait_stage_end(&w.on);
}
END_TEST

START_TEST(tail_lags_and_overshoots)
{
  walk w;
  begin(&w, flat, 0);
  float behind = 0, beyond = 0;
  run(&w, 1.5, 0, 0, 1.2f);
  sbf_vec3 forward = {0, 0, 1};
  for (int phase = 0; phase < 2; phase++) {
    for (int i = 0; i < 120; i++) {
      if (phase == 1) w.on.input.turn = 0;
      tick(&w);
      sbf_vec3 position, tip = sbri_sub(w.on.pose[7].position, w.on.pose[5].position);
      float heading;
      sbri_gait_get_placement(w.on.state, &position, &heading);
      sbf_quat back = {0, sinf(-heading / 2), 0, cosf(-heading / 2)};
      sbf_vec3 local = sbri_rotate(back, tip); /* straight: (0, 0, -) */
      if (phase == 0)
        behind = fmaxf(behind, local.x);
      else
        beyond = fminf(beyond, local.x);
    }
  }
  (void)forward;
  ck_assert_float_gt(behind, 0.01f);   /* turning left, the tip hangs out on one side */
  ck_assert_float_lt(beyond, -0.005f); /* and swings over to the other when the turn ends */
  run(&w, 6, 0, 0, 0);
  ck_assert_float_le(fabsf(sbri_sub(w.on.pose[7].position, w.on.pose[5].position).y), 0.01f);
  gait_stage_end(&w.on);
}
END_TEST

START_TEST(the_head_leads_a_rotation_and_returns)
{
  walk w;
  begin(&w, flat, 0);
  run(&w, 1, 0, 0, 1);
  sbf_vec3 position;
  float heading;
  sbri_gait_get_placement(w.on.state, &position, &heading);
  sbf_vec3 looks = sbri_rotate(w.on.pose[4].rotation, (sbf_vec3){0, 0, 1});
  float ahead = atan2f(looks.x, looks.z) - heading;
  ck_assert_float_gt(ahead, 0.25f);
  ck_assert_float_le(ahead, 0.75f);
  run(&w, 4, 0, 0, 0);
  sbri_gait_get_placement(w.on.state, &position, &heading);
  looks = sbri_rotate(w.on.pose[4].rotation, (sbf_vec3){0, 0, 1});
  ck_assert_float_eq_tol(remainderf(atan2f(looks.x, looks.z) - heading, 6.2831853f), 0, 0.02f);
  gait_stage_end(&w.on);
}
END_TEST

START_TEST(a_knee_rotates_with_the_bone_of_its_pole)
{
  walk with_hips, with_head;
  begin(&with_hips, flat, 0);
  begin(&with_head, flat, 0);
  ck_assert_int_eq(with_hips.on.rig.legs[QUADRUPED_HIND_L].pole.bone, 1); /* the thigh hangs on it */
  sbri_leg *leg = &with_head.on.rig.legs[QUADRUPED_HIND_L];
  leg->pole.bone = 4;
  leg->pole.position = sbri_sub(leg->pole.direction, with_head.on.rig.bones.rest[4].position);
  run(&with_hips, 0.1, 0, 0, 0);
  run(&with_head, 0.1, 0, 0, 0);
  ck_assert_float_le(
      sbri_length(sbri_sub(with_hips.on.pose[9].position, with_head.on.pose[9].position)), 1e-5f);
  run(&with_hips, 1, 0, 0, 1); /* the head leads */
  run(&with_head, 1, 0, 0, 1);
  ck_assert_float_gt(
      sbri_length(sbri_sub(with_hips.on.pose[9].position, with_head.on.pose[9].position)), 1e-3f);
  ck_assert_float_le(
      sbri_length(sbri_sub(with_hips.on.pose[10].position, with_head.on.pose[10].position)), 1e-5f);
  gait_stage_end(&with_hips.on);
  gait_stage_end(&with_head.on);
}
END_TEST

START_TEST(knees_bend_in_both_directions_and_point_at_their_poles)
{
  walk w;
  begin(&w, flat, 0);
  w.on.input.forward = 0.3f;
  for (int i = 0; i < 300; i++) {
    tick(&w);
    sbr_leg_state legs[4];
    sbri_gait_legs(&w.on.rig, w.on.state, 1, legs, 4);
    for (int l = 0; l < 4; l++) {
      const sbri_leg *leg = &w.on.rig.legs[l];
      sbf_vec3 hip = w.on.pose[leg->upper].position, ankle = w.on.pose[leg->foot].position;
      sbf_vec3 knee = sbri_sub(w.on.pose[leg->lower].position, hip), pole = sbri_sub(legs[l].pole, hip);
      sbf_vec3 along = sbri_normalize(sbri_sub(ankle, hip), sbri_vec3(0, -1, 0));
      knee = sbri_add_scaled(knee, along, -sbri_dot(knee, along));
      pole = sbri_add_scaled(pole, along, -sbri_dot(pole, along));
      ck_assert_float_ge(sbri_dot(knee, pole), 0.999f * sbri_length(knee) * sbri_length(pole));
      if (leg->hind)
        ck_assert_float_gt(knee.z, 0); /* hind knees bend forward */
      else
        ck_assert_float_lt(knee.z, 0); /* elbows backward */
    }
  }
  gait_stage_end(&w.on);
}
END_TEST

START_TEST(the_same_speed_at_any_size)
{
  double distance[3], stride[3];
  const float scales[3] = {1, 2, 4};
  for (int k = 0; k < 3; k++) {
    walk w;
    begin(&w, flat, 0);
    w.on.input.scale = scales[k];
    sbri_gait_reset(&w.on.rig, w.on.state, &w.on.input, (sbf_vec3){0, 0, 0}, 0);
    w.on.input.forward = 0.3f;
    uint32_t before = 0, after = 0;
    for (int i = 0; i < 900; i++) {
      sbri_gait_event events[16];
      sbri_gait_tick(&w.on.rig, w.on.state, &w.on.input, w.on.pose, events, 16);
      sbr_leg_state leg;
      sbri_gait_legs(&w.on.rig, w.on.state, 1, &leg, 1);
      *(i < 300 ? &before : &after) = leg.steps_taken;
    }
    distance[k] = sbri_gait_distance(w.on.state);
    stride[k] = 3.0 / (after - before); /* of the last ten seconds */
    gait_stage_end(&w.on);
  }
  for (int k = 1; k < 3; k++) {
    ck_assert_double_eq_tol(distance[k], distance[0], 0.2);
    /* It takes shorter steps because of its legs, not its scale. */
    ck_assert_double_lt(stride[k], 0.9 * (double)scales[k] * stride[0]);
  }
}
END_TEST

START_TEST(a_body_far_from_its_feet_repositions_them)
{
  walk w;
  begin(&w, flat, 0);
  run(&w, 1, 0.3f, 0, 0);
  sbri_gait_rebase(&w.on.rig, w.on.state, (sbf_vec3){0, 0, 0});
  sbri_gait_reset(&w.on.rig, w.on.state, &w.on.input, (sbf_vec3){50, 0, 0}, 1);
  run(&w, 1, 0.3f, 0, 0);
  ck_assert_float_le(w.worst_stretch, 1e-4f);
  gait_stage_end(&w.on);
}
END_TEST

START_TEST(moving_the_origin_changes_nothing)
{
  walk a, b;
  begin(&a, flat, 0);
  begin(&b, flat, 0);
  run(&a, 2, 0.3f, 0, 0.2f);
  run(&b, 2, 0.3f, 0, 0.2f);
  sbf_vec3 shift = {4, 0, -8};
  sbri_gait_rebase(&b.on.rig, b.on.state, shift);
  b.on.input.origin = (sbr_double3){4, 0, -8};
  for (int l = 0; l < 4; l++) b.stance[l] = sbri_sub(b.stance[l], shift);
  run(&a, 2, 0.3f, 0, 0.2f);
  run(&b, 2, 0.3f, 0, 0.2f);
  for (uint32_t i = 0; i < a.on.rig.bones.count; i++)
    ck_assert_float_le(
        sbri_length(sbri_sub(a.on.pose[i].position, sbri_add(b.on.pose[i].position, shift))), 2e-4f);
  gait_stage_end(&a.on);
  gait_stage_end(&b.on);
}
END_TEST

START_TEST(a_taller_copy_walks_at_the_same_speed)
{
  walk w;
  begin(&w, flat, 0);
  w.on.input.scale = 3;
  sbri_gait_reset(&w.on.rig, w.on.state, &w.on.input, (sbf_vec3){0, 0, 0}, 0);
  w.on.input.forward = 0.5f;
  for (int i = 0; i < 600; i++) {
    sbri_gait_event events[16];
    sbri_gait_tick(&w.on.rig, w.on.state, &w.on.input, w.on.pose, events, 16);
  }
  ck_assert_double_eq_tol(sbri_gait_distance(w.on.state), 5, 0.15);
  ck_assert_float_eq_tol(w.on.pose[3].position.y, 0.9f, 0.02f);
  gait_stage_end(&w.on);
}
END_TEST

/* Turns on the spot, more than twice round. Followers of the heading continue smoothly where the angle
 * wraps. */
START_TEST(nothing_jumps_where_headings_wrap_around)
{
  walk w;
  begin(&w, flat, 0);
  run(&w, 2, 0, 0, 1.4f);
  sbr_transform before[MAX_BONES];
  for (int i = 0; i < 10 * TICKS_A_SECOND; i++) {
    memcpy(before, w.on.pose, w.on.rig.bones.count * sizeof *before);
    tick(&w);
    for (uint32_t b = 0; b < 8; b++) { /* body, head and tail */
      sbf_quat moved = sbri_quat_multiply(w.on.pose[b].rotation, sbri_quat_conjugate(before[b].rotation));
      ck_assert_float_le(2 * acosf(fminf(1, fabsf(moved.w))), 2.5f * 1.4f / TICKS_A_SECOND);
    }
  }
  expect_good_walk(&w, 10);
  gait_stage_end(&w.on);
}
END_TEST

/* A foot within its margin steps home by itself. One farther away is placed home at once. */
START_TEST(a_foot_beyond_its_margin_is_placed_again)
{
  for (int far = 0; far < 2; far++) {
    walk w;
    begin(&w, flat, 0);
    run(&w, 0.5, 0, 0, 0);
    const sbri_leg *leg = &w.on.rig.legs[QUADRUPED_FORE_L];
    float margin = w.on.asset->gaits.at[0].legs.at[QUADRUPED_FORE_L].jump_margin;
    ck_assert_float_gt(margin, 0);
    float lost = leg->length.upper + leg->length.lower + margin;
    sbri_foot *foot = &w.on.state->feet[QUADRUPED_FORE_L];
    foot->ground.z += far ? lost + 0.02f : lost - 0.02f;
    uint32_t steps = foot->steps_taken;
    sbf_vec3 home = {leg->home.position.x, 0, leg->home.position.z};
    sbri_gait_tick(&w.on.rig, w.on.state, &w.on.input, w.on.pose, NULL, 0);
    ck_assert_int_eq(sbri_length(sbri_sub(foot->ground, home)) < 1e-4f, far);
    for (int i = 0; i < 180; i++) sbri_gait_tick(&w.on.rig, w.on.state, &w.on.input, w.on.pose, NULL, 0);
    ck_assert_float_le(sbri_length(sbri_sub(foot->ground, home)), 0.012f);
    ck_assert_int_eq(foot->steps_taken > steps, !far);
    gait_stage_end(&w.on);
  }
}
END_TEST

/* A leg's length a second, with steps as long as its legs would swing: it reaches the speed and keeps it. */
START_TEST(large_bodies_reach_their_speed_and_keep_it)
{
  static const float scales[3] = {2, 8, 16};
  walk w;
  begin(&w, flat, 0);
  sbf_gait *gait = (sbf_gait *)(uintptr_t)&w.on.asset->gaits.at[0];
  float scale = scales[_i], reach = scale * w.on.rig.stand.reach;
  gait->step_duration = 0.42f * sqrtf(reach);
  w.on.input.scale = scale;
  gait_stage_remake(&w.on);
  w.on.input.forward = reach;
  double slowest = 1, shortened = 1;
  float begun[4] = {0};
  for (int t = 0; t < 360; t++) {
    double before = sbri_gait_distance(w.on.state);
    gait_stage_ticks(&w.on, 1);
    for (int i = 0; i < 4; i++) { /* the step during the start ends earlier than planned */
      const sbri_foot *foot = &w.on.state->feet[i];
      if (foot->planted) begun[i] = 0;
      if (!foot->planted && begun[i] == 0) begun[i] = foot->step.duration_s;
      if (!foot->planted) shortened = fmin(shortened, (double)(foot->step.duration_s / begun[i]));
    }
    if (t >= 240) slowest = fmin(slowest, 60 * (sbri_gait_distance(w.on.state) - before) / (double)reach);
  }
  ck_assert_double_gt(sbri_gait_distance(w.on.state) / (6 * (double)reach), 0.8);
  ck_assert_double_gt(slowest, 0.97);
  if (_i > 0) ck_assert_double_lt(shortened, 0.9);
  gait_stage_end(&w.on);
}
END_TEST

/* Faster than it can walk one foot at a time. */
START_TEST(steps_are_quicker_at_higher_speed)
{
  walk w;
  begin(&w, flat, 0);
  run(&w, 0.5, 0.1f, 0, 0);
  sbri_gait_state *state = w.on.state;
  float last = 1, last_half = 0;
  for (float speed = 0.6f; speed < 2; speed += 0.2f) {
    state->motion.forward = speed;
    sbri_stride stride = sbri_stride_of(&w.on.rig, state, &w.on.input);
    ck_assert(stride.in_groups);
    ck_assert_float_le(stride.duration_s, last);
    ck_assert_float_ge(stride.half_m, last_half - 1e-6f);
    last = stride.duration_s, last_half = stride.half_m;
  }
  ck_assert_float_lt(last, 0.8f * w.on.asset->gaits.at[0].step_duration);
  state->motion.forward = 0.1f;
  ck_assert(!sbri_stride_of(&w.on.rig, state, &w.on.input).in_groups);
  gait_stage_end(&w.on);
}
END_TEST

/* Twist bones of a leg and a guard on its shin: not solved, but moved with the leg. */
START_TEST(children_of_a_leg_follow_it)
{
  enum { PLAIN = 20, ALL = 22 };
  static const int32_t parents[2] = {8, 9};
  walk plain, w;
  begin(&plain, flat, 0);
  begin(&w, flat, 0);
  sbf_asset *asset = w.on.asset;
  sbf_bone *bones = sbf_asset_allocate(asset, ALL, sizeof *bones);
  memcpy(bones, asset->bones.at, PLAIN * sizeof *bones);
  for (int i = 0; i < 2; i++) {
    bones[PLAIN + i] = bones[parents[i]];
    bones[PLAIN + i].parent = parents[i];
    bones[PLAIN + i].head.y -= 0.05f;
  }
  asset->bones = (sbf_bone_list){bones, ALL};
  gait_stage_remake(&w.on);
  plain.on.input.forward = w.on.input.forward = 0.3f;
  for (int i = 0; i < 300; i++) {
    tick(&plain), tick(&w);
    for (int k = 0; k < 2; k++) {
      const sbr_transform *on = &w.on.pose[parents[k]], *is = &w.on.pose[PLAIN + k];
      const sbr_transform *rest = &w.on.rig.bones.rest_local[PLAIN + k];
      sbf_vec3 there = sbri_add(on->position, sbri_rotate(on->rotation, rest->position));
      ck_assert_float_le(sbri_length(sbri_sub(is->position, there)), 1e-5f);
      sbf_quat turned = sbri_quat_multiply(on->rotation, rest->rotation);
      sbf_quat off = sbri_quat_multiply(is->rotation, sbri_quat_conjugate(turned));
      ck_assert_float_ge(fabsf(off.w), 1 - 1e-6f);
    }
    for (int b = 0; b < PLAIN; b++)
      ck_assert_float_le(sbri_length(sbri_sub(w.on.pose[b].position, plain.on.pose[b].position)), 1e-5f);
  }
  gait_stage_end(&w.on);
  gait_stage_end(&plain.on);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("gait");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, standing_is_the_rest_pose);
  tcase_add_test(tests, walks_forward_step_by_step);
  tcase_add_test(tests, walks_backward_sideways_and_in_curves);
  tcase_add_test(tests, feet_return_home_when_it_stops);
  tcase_add_test(tests, feet_stand_on_a_slope_and_the_body_follows);
  tcase_add_test(tests, tail_lags_and_overshoots);
  tcase_add_test(tests, the_head_leads_a_rotation_and_returns);
  tcase_add_test(tests, a_knee_rotates_with_the_bone_of_its_pole);
  tcase_add_test(tests, knees_bend_in_both_directions_and_point_at_their_poles);
  tcase_add_test(tests, the_same_speed_at_any_size);
  tcase_add_test(tests, a_body_far_from_its_feet_repositions_them);
  tcase_add_test(tests, moving_the_origin_changes_nothing);
  tcase_add_test(tests, a_taller_copy_walks_at_the_same_speed);
  tcase_add_test(tests, nothing_jumps_where_headings_wrap_around);
  tcase_add_test(tests, a_foot_beyond_its_margin_is_placed_again);
  tcase_add_loop_test(tests, large_bodies_reach_their_speed_and_keep_it, 0, 3);
  tcase_add_test(tests, steps_are_quicker_at_higher_speed);
  tcase_add_test(tests, children_of_a_leg_follow_it);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
