/* Dry friction of joints between bones: an arm that hangs on a trunk, as a limp ball, as a limp hinge, and as
 * a ball that is driven by next to nothing. */
#include <math.h>

#include "harness.h"
#include "rigid_scenes.h"

enum { KINDS = 3, ARM = 1 };
static const float KG = 2, REACH_M = 0.25f, G = 9.81f, FRICTION = 0.04f, TICK_S = 1 / 60.0f;

/* The arm is let go `aside`, rad, of where it hangs; `steps` a tick, 0: as many as it takes by itself. */
static scene arm_in(int kind, float aside, float friction, bool weighs, uint32_t steps) {
  scene s = rigid_begin();
  s.world_definition.has_gravity = !weighs;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  s.model_options.rigid_substeps = steps;
  s.asset->environment.gravity = (sbf_vec3){0, -G, 0};
  sbf_bone *bones = sbf_asset_allocate(s.asset, 2, sizeof *bones);
  ck_assert_ptr_nonnull(bones);
  for (int i = 0; i < 2; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = "bone";
    bones[i].parent = i - 1;
  }
  s.asset->bones = (sbf_bone_list){bones, 2};
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 20);
  sbf_vec3 middle = {REACH_M * sinf(aside), -REACH_M * cosf(aside), 0};
  rigid_box(&s, middle, (sbf_vec3){0.1f, 0.1f, 0.1f}, KG);
  for (uint32_t i = 0; i < 2; i++) rigid_body(&s, i)->bone = (int32_t)i;
  rigid_body(&s, 0)->motion = SBF_BODY_MOTION_KINEMATIC;
  sbf_joint_kind joint = kind == 1 ? SBF_JOINT_KIND_REVOLUTE : SBF_JOINT_KIND_SPHERICAL;
  (void)rigid_joint(&s, joint, 0, ARM, (sbf_vec3){0, 0, 0}, rigid_along_z);
  scene_start(&s);
  sbr_rigid_drive drive = sbr_default_rigid_drive();
  drive.joint_damping_1_s = 0, drive.joint_friction = friction;
  sbr_character_set_rigid_drive(s.world, s.character, &drive);
  sbr_character_set_rigid_mode(s.world, s.character, ARM, kind == 2 ? SBR_RIGID_DRIVEN : SBR_RIGID_PASSIVE);
  sbr_character_set_rigid_drive_fraction(s.world, s.character, ARM, kind == 2 ? 1e-6f : 1);
  return s;
}

static scene arm_of(int kind, float aside, float friction) {
  return arm_in(kind, aside, friction, true, 0);
}

static float angle(const scene *s) {
  return asinf(rigid_state(s, ARM).center.x / REACH_M);
}
static float angular_velocity(const scene *s) {
  return rigid_state(s, ARM).angular_velocity.z;
}

/* From one turning point to the next, friction takes the work of the weight: cos b - cos a = friction (a +
 * b). */
START_TEST(friction_shortens_each_swing)
{
  scene s = arm_of(_i, 0.6f, FRICTION);
  float turned_at = 0.6f, max = 0, before = 0.6f;
  int swings = 0;
  for (int i = 0; i < 600; i++) {
    scene_ticks(&s, 1);
    float now = angle(&s);
    max = fmaxf(max, now * turned_at < 0 ? fabsf(now) : 0);
    if (max > 0.1f && fabsf(now) < max - 1e-4f && fabsf(before) >= max) { /* it turned there */
      ck_assert_float_eq_tol(cosf(max) - cosf(turned_at), FRICTION * (fabsf(turned_at) + max), 4e-3f);
      turned_at = now > 0 ? max : -max;
      max = 0, swings++;
    }
    before = now;
  }
  ck_assert_int_ge(swings, 5);
  ck_assert_int_le(swings, 8);
  ck_assert_float_le(fabsf(angle(&s)), 1.3f * FRICTION);
  ck_assert_float_le(fabsf(angular_velocity(&s)), 1.3e-3f);
  scene_free(&s);
}
END_TEST

/* Loads up to the bound stick, with a creep below a milliradian a second; greater loads slip. */
START_TEST(friction_carries_loads_up_to_its_bound)
{
  bool holds = _i < KINDS;
  float aside = (holds ? 0.9f : 1.5f) * FRICTION;
  scene s = arm_of(_i % KINDS, aside, FRICTION);
  scene_ticks(&s, 180);
  if (holds)
    ck_assert_float_eq_tol(angle(&s), aside, 3e-3f);
  else
    ck_assert_float_le(fabsf(angle(&s)), 0.9f * FRICTION);
  scene_free(&s);
}
END_TEST

/* Turned without weight, it slows down uniformly by a = torque / moment and stops after w^2 / 2a, within the
 * distance of one step at the initial speed, for any number of steps. It then stays there. */
START_TEST(a_rotating_body_decelerates_evenly)
{
  const uint32_t steps[4] = {4, 8, 16, 64};
  const float side = 0.1f, moment = KG * (REACH_M * REACH_M + side * side / 6);
  const float a = FRICTION * KG * G * REACH_M / moment, began = 0.9f;
  for (int i = 0; i < 4; i++) {
    scene s = arm_in(_i, 0, FRICTION, false, steps[i]);
    rigid_push(&s, ARM, (sbf_vec3){0, 0, 0}, (sbf_vec3){began * moment / REACH_M, 0, 0});
    const float tick = TICK_S, off = began * TICK_S / (float)steps[i];
    int half = (int)(0.5f * began / (a * tick));
    scene_ticks(&s, (uint32_t)half);
    float since = (float)half * tick;
    ck_assert_float_eq_tol(
        angular_velocity(&s), began - a * since, 1.5f * a * tick / (float)steps[i] + 1e-3f);
    ck_assert_float_eq_tol(angle(&s), (began - 0.5f * a * since) * since, off);
    scene_ticks(&s, (uint32_t)half + 12);
    float stands = angle(&s);
    ck_assert_float_eq_tol(stands, 0.5f * began * began / a, off);
    scene_ticks(&s, 300);
    ck_assert_float_eq_tol(angle(&s), stands, 1e-5f);
    scene_free(&s);
  }
}
END_TEST

/* A hit on an arm at rest loses no more than friction takes in the tick. */
START_TEST(a_hit_overcomes_friction)
{
  float after[2];
  for (int with = 0; with < 2; with++) {
    scene s = arm_of(_i, 0, with ? FRICTION : 0);
    scene_ticks(&s, 10);
    rigid_push(&s, ARM, (sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0, 0});
    scene_ticks(&s, 1);
    after[with] = angular_velocity(&s);
    scene_free(&s);
  }
  float takes = FRICTION * KG * G * REACH_M * TICK_S / (KG * REACH_M * REACH_M);
  ck_assert_float_ge(after[0], 1);
  ck_assert_float_le(after[1], after[0] - 0.5f * takes);
  ck_assert_float_ge(after[1], after[0] - 2 * takes);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("joint_friction");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, friction_shortens_each_swing, 0, KINDS);
  tcase_add_loop_test(tests, friction_carries_loads_up_to_its_bound, 0, 2 * KINDS);
  tcase_add_loop_test(tests, a_rotating_body_decelerates_evenly, 0, KINDS);
  tcase_add_loop_test(tests, a_hit_overcomes_friction, 0, KINDS);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
