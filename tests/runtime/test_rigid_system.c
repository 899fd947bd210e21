/* Chains of unequal masses, and loops: hard cases for a sweep from joint to joint. */
#include <math.h>

#include "harness.h"
#include "rigid_scenes.h"

static const double PI = 3.14159265358979323846;

static void chain(scene *s, int links, float heavy, float slope) {
  float x = 0.2f * sinf(slope), y = -0.2f * cosf(slope);
  for (int i = 0; i < links; i++) {
    sbf_vec3 center = {x * ((float)i + 0.5f), y * ((float)i + 0.5f), 0};
    rigid_box(s, center, (sbf_vec3){0.06f, 0.06f, 0.06f}, i == links - 1 ? heavy : 1);
    rigid_joint(s, SBF_JOINT_KIND_SPHERICAL, i - 1, (uint32_t)i, (sbf_vec3){x * (float)i, y * (float)i, 0},
        rigid_along_x);
  }
}

static float worst_apart(const scene *s, uint32_t joints) {
  float worst = 0;
  for (uint32_t j = 0; j < joints; j++) worst = fmaxf(worst, rigid_joint_state(s, j).separation);
  return worst;
}

/* Light links carry a heavy bob, at rest and in a swing of half a radian. No joint separates by half a
 * millimetre of two metres, and the energy is conserved. */
START_TEST(light_chains_carry_heavy_bobs)
{
  const float ratios[4] = {1, 10, 100, 1000};
  for (int swings = 0; swings < 2; swings++) {
    scene s = rigid_begin();
    s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
    chain(&s, 10, ratios[_i], swings ? 0.5f : 0);
    scene_start(&s);
    double begin = rigid_energy(&s, 10), mass = 9 + (double)ratios[_i], worst = 0, drift = 0;
    for (int i = 0; i < 600; i++) {
      sbr_world_tick(s.world);
      worst = fmax(worst, (double)worst_apart(&s, 10));
      drift = fmax(drift, fabs(rigid_energy(&s, 10) - begin) / (mass * 9.81 * 2));
    }
    ck_assert_double_le(worst, 5e-4);
    ck_assert_double_le(drift, 0.05);
    scene_free(&s);
  }
}
END_TEST

static void falls_from_level(float ratio, int ticks, double max_apart, double max_drift) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  chain(&s, 10, ratio, (float)(PI / 2));
  scene_start(&s);
  double begin = rigid_energy(&s, 10), mass = 9 + (double)ratio, worst = 0, drift = 0;
  for (int i = 0; i < ticks; i++) {
    sbr_world_tick(s.world);
    worst = fmax(worst, (double)worst_apart(&s, 10));
    drift = fmax(drift, fabs(rigid_energy(&s, 10) - begin) / (mass * 9.81 * 2));
  }
  ck_assert_double_le(worst, max_apart);
  ck_assert_double_le(drift, max_drift);
  scene_free(&s);
}

/* Released from level, they swing down, up on the other side and back in three seconds. No joint separates by
 * a tenth of a millimetre, and the energy changes by less than 1 % of the potential energy of the fall to the
 * lowest point. */
START_TEST(light_chains_fall_from_level)
{
  const float ratios[4] = {1, 10, 100, 1000};
  falls_from_level(ratios[_i], 180, 1e-4, 0.01);
}
END_TEST

/* Ten more seconds, in which the links fold up on the way back and are pulled straight again, as in a
 * cracking whip. */
START_TEST(light_chains_crack)
{
  const float ratios[3] = {10, 100, 1000};
  falls_from_level(ratios[_i], 600, 1e-3, 0.03);
}
END_TEST

/* A parallelogram of hinges with three redundant rows: two cranks of mass m and length l under a coupler M
 * swing with w^2 = g (m + M) l / (2 m l^2 / 3 + M l^2). */
START_TEST(a_loop_of_four_bars_closes)
{
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  rigid_box(&s, (sbf_vec3){0, -0.5f, 0}, (sbf_vec3){0.01f, 1, 0.01f}, 1);
  rigid_box(&s, (sbf_vec3){1, -0.5f, 0}, (sbf_vec3){0.01f, 1, 0.01f}, 1);
  rigid_box(&s, (sbf_vec3){0.5f, -1, 0}, (sbf_vec3){1, 0.01f, 0.01f}, 2);
  rigid_joint(&s, SBF_JOINT_KIND_REVOLUTE, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_z);
  rigid_joint(&s, SBF_JOINT_KIND_REVOLUTE, -1, 1, (sbf_vec3){1, 0, 0}, rigid_along_z);
  rigid_joint(&s, SBF_JOINT_KIND_REVOLUTE, 0, 2, (sbf_vec3){0, -1, 0}, rigid_along_z);
  rigid_joint(&s, SBF_JOINT_KIND_REVOLUTE, 1, 2, (sbf_vec3){1, -1, 0}, rigid_along_z);
  scene_start(&s);
  sbr_double3 o = sbr_character_get_origin(s.world, s.character);
  sbr_character_apply_rigid_impulse(
      s.world, s.character, 2, (sbr_double3){o.x + 0.5, o.y - 1, o.z}, (sbf_vec3){0.4f, 0, 0});
  double last = 0, first = 0, end = 0, worst = 0;
  int count = -1;
  for (int i = 0; i < 1200; i++) {
    sbr_world_tick(s.world);
    double x = (double)rigid_joint_state(&s, 0).coordinates[SBF_JOINT_AXIS_TWIST];
    if (i > 0 && last < 0 && x >= 0) {
      end = i - x / (x - last);
      if (++count == 0) first = end;
    }
    last = x;
    for (uint32_t j = 0; j < 4; j++)
      worst =
          fmax(worst, (double)(rigid_joint_state(&s, j).separation + rigid_joint_state(&s, j).angular_error));
  }
  double w = sqrt(9.81 * (1 + 2) / (2.0 / 3 + 2));
  ck_assert_double_eq_tol((end - first) / (60.0 * count) * w / (2 * PI), 1, 2e-3);
  ck_assert_double_le(worst, 2e-5);
  scene_free(&s);
}
END_TEST

/* A chain fixed at both ends to the world: from a V it swings into the curve of a rope, whose ends carry
 * it. */
START_TEST(a_chain_fixed_at_both_ends_hangs)
{
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  const float step = 0.14142136f;
  sbf_vec3 at = {0, 0, 0};
  for (int i = 0; i < 8; i++) {
    sbf_vec3 next = {at.x + step, at.y + (i < 4 ? -step : step), 0};
    rigid_box(&s, (sbf_vec3){0.5f * (at.x + next.x), 0.5f * (at.y + next.y), 0},
        (sbf_vec3){0.05f, 0.05f, 0.05f}, 1);
    sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, i - 1, (uint32_t)i, at, rigid_along_x);
    for (int axis = SBF_JOINT_AXIS_TWIST; axis <= SBF_JOINT_AXIS_SWING_Z; axis++)
      rigid_drive(&s, joint, (sbf_drive){.target = (sbf_joint_axis)axis, .damping = 0.3f});
    at = next;
  }
  rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, -1, 7, at, rigid_along_x);
  scene_start(&s);
  scene_ticks(&s, 600);
  ck_assert_float_le(worst_apart(&s, 9), 1e-5f);
  sbf_vec3 a = rigid_joint_state(&s, 0).force, b = rigid_joint_state(&s, 8).force;
  ck_assert_float_eq_tol(a.y + b.y, 8 * 9.81f, 0.5f);
  ck_assert_float_eq_tol(a.y, b.y, 0.5f);
  ck_assert_float_eq_tol(a.x, -b.x, 0.5f);
  scene_free(&s);
}
END_TEST

/* Five by five boxes on ball joints, attached at a corner box and released from level: 51 rows close loops.
 */
START_TEST(a_net_carries_its_load)
{
  enum { SIDE = 5 };
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  s.character_definition.position.y = 1000;
  for (uint32_t i = 0; i < SIDE * SIDE; i++) {
    float x = 0.1f * (float)(i / SIDE), z = 0.1f * (float)(i % SIDE);
    (void)rigid_box(&s, (sbf_vec3){x, 0, z}, (sbf_vec3){0.08f, 0.02f, 0.08f}, 0.1f);
    if (i >= SIDE)
      rigid_joint(
          &s, SBF_JOINT_KIND_SPHERICAL, (int32_t)i - SIDE, i, (sbf_vec3){x - 0.05f, 0, z}, rigid_along_x);
    if (i % SIDE)
      rigid_joint(
          &s, SBF_JOINT_KIND_SPHERICAL, (int32_t)i - 1, i, (sbf_vec3){x, 0, z - 0.05f}, rigid_along_x);
  }
  rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_x);
  scene_start(&s);
  float separation = 0;
  double began = rigid_energy(&s, SIDE * SIDE), max = 0;
  for (int i = 0; i < 300; i++) {
    sbr_world_tick(s.world);
    for (uint32_t j = 0; j < s.asset->joints.count; j++)
      separation = fmaxf(separation, rigid_joint_state(&s, j).separation);
    max = fmax(max, fabs(rigid_energy(&s, SIDE * SIDE) - began));
  }
  ck_assert_float_le(separation, 2e-4f);
  ck_assert_double_le(max, 2); /* of 7 J, by which it falls until its middle hangs below */
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rigid_system");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, light_chains_carry_heavy_bobs, 0, 4);
  tcase_add_loop_test(tests, light_chains_fall_from_level, 0, 4);
  tcase_add_loop_test(tests, light_chains_crack, 0, 3);
  tcase_add_test(tests, a_loop_of_four_bars_closes);
  tcase_add_test(tests, a_net_carries_its_load);
  tcase_add_test(tests, a_chain_fixed_at_both_ends_hangs);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
