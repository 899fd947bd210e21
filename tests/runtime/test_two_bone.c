#include "animation/ik/two_bone.h"

#include "animation/ik/ik.h"

#include <math.h>

#include "harness.h"
#include "math/vec3.h"
#include "random.h"

static float distance(sbf_vec3 a, sbf_vec3 b) {
  return sbri_length(sbri_sub(a, b));
}

/* In separate statements: the compiler chooses the order of a call's arguments. */
static sbf_vec3 next_point(uint32_t *seed, float scale) {
  float x = random_between(seed, -1, 1), y = random_between(seed, -1, 1), z = random_between(seed, -1, 1);
  return sbri_vec3(scale * x, scale * y, scale * z);
}

START_TEST(reachable_targets_are_reached)
{
  uint32_t seed = 1;
  int hits = 0;
  for (int i = 0; i < 20000; i++) {
    sbf_vec3 hip = next_point(&seed, 1), target = sbri_add(hip, next_point(&seed, 1));
    sbf_vec3 pole = next_point(&seed, 3);
    float upper = 0.5f, lower = 0.7f, away = distance(target, hip);
    sbri_two_bone_result r = sbri_two_bone(hip, target, pole, sbri_vec3(9, 9, 9), upper, lower, 0);
    ck_assert_float_le(fabsf(distance(r.knee, hip) - upper), 2e-6f);
    ck_assert_float_le(fabsf(distance(r.knee, r.ankle) - lower), 4e-6f);
    if (away >= 0.2f && away <= 1.2f) {
      hits++;
      ck_assert(r.reached);
      ck_assert_float_le(distance(r.ankle, target), 2e-6f);
    } else {
      ck_assert(!r.reached);
    }
  }
  ck_assert_int_gt(hits, 5000);
}
END_TEST

START_TEST(the_knee_points_towards_the_pole)
{
  uint32_t seed = 7;
  for (int i = 0; i < 5000; i++) {
    sbf_vec3 hip = {0, 1, 0}, target = next_point(&seed, 0.3f), pole = next_point(&seed, 2);
    sbri_two_bone_result r = sbri_two_bone(hip, target, pole, sbri_vec3(0, 0, 5), 0.8f, 0.8f, 0);
    sbf_vec3 along = sbri_normalize(sbri_sub(target, hip), sbri_vec3(0, 1, 0));
    sbf_vec3 knee = sbri_sub(r.knee, hip), to_pole = sbri_sub(pole, hip);
    knee = sbri_add_scaled(knee, along, -sbri_dot(knee, along));
    to_pole = sbri_add_scaled(to_pole, along, -sbri_dot(to_pole, along));
    ck_assert_float_ge(sbri_dot(sbri_normalize(knee, along), sbri_normalize(to_pole, along)), 0.999f);
  }
}
END_TEST

START_TEST(extension_is_eased_without_a_jump)
{
  float last = 0, last_step = 0;
  for (int i = 0; i <= 1400; i++) {
    sbf_vec3 target = {0, -0.001f * (float)i, 0};
    sbri_two_bone_result r =
        sbri_two_bone(sbri_vec3(0, 0, 0), target, sbri_vec3(0, 0, 1), sbri_vec3(1, 0, 0), 0.6f, 0.6f, 0.05f);
    float out = sbri_length(r.ankle), step = out - last;
    if (i > 1) {
      ck_assert_float_ge(step, -1e-6f);                     /* never back */
      ck_assert_float_le(fabsf(step - last_step), 2.5e-5f); /* no kink in the speed */
    }
    ck_assert_float_le(out, 1.2f + 1e-6f);
    if (i <= 1140) ck_assert_float_eq_tol(out, 0.001f * (float)i, 1e-6f);
    last = out;
    last_step = step;
  }
  ck_assert_float_eq_tol(last, 1.2f, 1e-5f);
}
END_TEST

START_TEST(degenerate_input_stays_finite)
{
  sbf_vec3 zero = {0, 0, 0};
  sbri_two_bone_result r = sbri_two_bone(zero, zero, zero, zero, 1, 1, 0.02f);
  ck_assert(isfinite(r.knee.x) && isfinite(r.knee.y) && isfinite(r.knee.z));
  r = sbri_two_bone(zero, sbri_vec3(0, -1, 0), sbri_vec3(0, -3, 0), sbri_vec3(0, 4, 0), 1, 0.3f, 0);
  ck_assert(isfinite(r.knee.x) && isfinite(r.ankle.y));
  ck_assert_float_eq_tol(distance(r.knee, zero), 1, 1e-6f);
}
END_TEST

/* A thigh and a shin of 1 m, the knee a hinge about X that bends from 0.1 to `most` rad. */
static sbri_ik_result solve_hinged(
    sbri_ik_joint *joints, sbri_joint_limit *hinge, float max, sbf_vec3 target, sbf_quat rotation) {
  *hinge = (sbri_joint_limit){
      .before = {0, 0, 0, 1}, .after = {0, 0, 0, 1}, .twist = {0.1f, max}, .cone = 0, .active = true};
  for (int i = 0; i < 3; i++)
    joints[i] = (sbri_ik_joint){.offset = {0, i ? 1.0f : 0, 0}, .rotation = {0, 0, 0, 1}};
  joints[1].rotation = sbri_quat_about(sbri_vec3(1, 0, 0), 0.5f * max);
  joints[1].limit = hinge;
  sbri_ik_chain chain = {.base = {{0, 0, 0}, {0, 0, 0, 1}},
      .joints = joints,
      .count = 3,
      .target = target,
      .target_rotation = rotation,
      .copy_rotation = 1,
      .tolerance = 1e-4f,
      .iterations = 200};
  return sbri_ik_two_bone(&chain);
}

START_TEST(a_knee_keeps_its_limit_and_the_foot_its_rotation)
{
  uint32_t seed = 13;
  int reached = 0, folded = 0;
  for (int i = 0; i < 200; i++) {
    sbri_ik_joint joints[3];
    sbri_joint_limit hinge;
    sbf_vec3 target = next_point(&seed, 1.1f);
    sbf_quat wanted = sbri_quat_normalize((sbf_quat){target.y, target.z, target.x, 0.5f});
    float away = sbri_length(target);
    sbri_ik_result r = solve_hinged(joints, &hinge, 1.5f, target, wanted);
    ck_assert_float_le(sbri_joint_limit_excess(&hinge, joints[1].rotation), 2e-5f);
    sbri_ik_chain chain = {.base = {{0, 0, 0}, {0, 0, 0, 1}}, .joints = joints, .count = 3};
    sbr_transform frames[3];
    sbri_ik_compute_frames(&chain, frames);
    ck_assert_float_eq_tol(sbri_length(sbri_sub(frames[2].position, target)), r.error, 1e-4f);
    sbf_quat off = sbri_quat_multiply(frames[2].rotation, sbri_quat_conjugate(wanted));
    ck_assert_float_le(sbri_length(sbri_quat_log(off)), 1e-3f);
    /* Bent by at most 1.5 rad, the ankle is at least 1.46 m from the hip; bent by at least 0.1, at most 1.998
     * m. */
    if (away > 1.5f && away < 1.99f) reached += r.reached, folded++;
    if (away < 1.4f) ck_assert_float_ge(r.error, 1.45f - away);
  }
  ck_assert_int_gt(folded, 10);
  ck_assert_int_eq(reached, folded);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("two_bone");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, reachable_targets_are_reached);
  tcase_add_test(tests, the_knee_points_towards_the_pole);
  tcase_add_test(tests, extension_is_eased_without_a_jump);
  tcase_add_test(tests, degenerate_input_stays_finite);
  tcase_add_test(tests, a_knee_keeps_its_limit_and_the_foot_its_rotation);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
