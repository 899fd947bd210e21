/* A person of 14 boxes among the rest of a character: it falls, comes to rest, follows its pose. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "rigid_person.h"
#include "sbrun/soft_body.h"

static float larger(float a, float b) {
  return a > b ? a : b;
}

/* At rest within 5 s after any throw: no joint separates, no limit is exceeded by a degree in motion or a
 * tenth of one at rest, and nothing moves by more than 1 mm/s. */
START_TEST(a_person_falls_and_comes_to_rest)
{
  static const sbf_vec3 shoves[4] = {{0, 0, 60}, {80, 0, -40}, {-30, 100, 0}, {0, -50, -120}};
  scene s = person();
  scene_start(&s);
  person_shove(&s, 1, shoves[_i]);
  float separation = 0, beyond = 0;
  for (int i = 0; i < 300; i++) {
    sbr_world_tick(s.world);
    for (uint32_t j = 0; j < PARTS - 1; j++) {
      sbr_joint_state now = rigid_joint_state(&s, j);
      separation = larger(separation, now.separation), beyond = larger(beyond, now.angle_violation);
    }
  }
  ck_assert_float_le(separation, 1e-3f);
  ck_assert_float_le(beyond, 0.0175f);
  float trembling = 0;
  beyond = 0;
  for (int i = 0; i < 60; i++) {
    sbr_world_tick(s.world);
    trembling = larger(trembling, person_fastest(&s));
    for (uint32_t j = 0; j < PARTS - 1; j++)
      beyond = larger(beyond, rigid_joint_state(&s, j).angle_violation);
  }
  ck_assert_float_le(trembling, 1e-3f);
  ck_assert_float_le(beyond, 0.00175f);
  scene_free(&s);
}
END_TEST

/* Bones are where their bodies are. */
START_TEST(bones_follow_their_bodies)
{
  scene s = person();
  scene_start(&s);
  person_shove(&s, 2, (sbf_vec3){10, 0, 10});
  scene_ticks(&s, 40);
  sbr_transform bones[PARTS];
  sbr_character_get_bones(s.world, s.character, bones, PARTS);
  for (uint32_t b = 0; b < PARTS; b++) {
    sbr_rigid_state now = rigid_state(&s, b);
    /* At rest the bone's axes are those of asset space, like the body's. */
    ck_assert_float_eq_tol(fabsf(bones[b].rotation.w), fabsf(now.frame.rotation.w), 1e-5f);
    sbf_vec3 d = {bones[b].position.x - now.center.x, bones[b].position.y - now.center.y,
        bones[b].position.z - now.center.z};
    sbf_vec3 r = {person_parts[b].head.x - 0.5f * (person_parts[b].head.x + person_parts[b].tail.x),
        person_parts[b].head.y - 0.5f * (person_parts[b].head.y + person_parts[b].tail.y),
        person_parts[b].head.z - 0.5f * (person_parts[b].head.z + person_parts[b].tail.z)};
    ck_assert_float_eq_tol(d.x * d.x + d.y * d.y + d.z * d.z, r.x * r.x + r.y * r.y + r.z * r.z, 1e-4f);
  }
  scene_free(&s);
}
END_TEST

/* The hips are kinematic, all others driven: gravity bends it slightly. Without strength it hangs. */
START_TEST(drives_keep_the_pose)
{
  float bent[2];
  for (int passive = 0; passive < 2; passive++) {
    scene s = person();
    scene_start(&s);
    sbr_character_set_rigid_mode(s.world, s.character, -1, passive ? SBR_RIGID_PASSIVE : SBR_RIGID_DRIVEN);
    sbr_character_set_rigid_mode(s.world, s.character, 0, SBR_RIGID_KINEMATIC);
    scene_ticks(&s, 180);
    bent[passive] = 0;
    for (uint32_t j = 0; j < PARTS - 1; j++)
      bent[passive] = larger(bent[passive], rigid_joint_state(&s, j).coordinates[SBF_JOINT_AXIS_SWING]);
    scene_free(&s);
  }
  ck_assert_float_le(bent[0], 0.1f);
  ck_assert_float_ge(bent[1], 0.5f);
}
END_TEST

/* Released bodies keep moving; bodies that become kinematic take their pose at once. */
START_TEST(modes_change_in_motion)
{
  scene s = person();
  scene_start(&s);
  sbr_character_set_rigid_mode(s.world, s.character, -1, SBR_RIGID_KINEMATIC);
  scene_ticks(&s, 30);
  ck_assert_float_eq_tol(rigid_state(&s, 2).center.y, 1.625f + 0.02f, 1e-5f);
  sbr_character_set_rigid_mode(s.world, s.character, 2, SBR_RIGID_PASSIVE);
  scene_ticks(&s, 60);
  ck_assert_float_le(rigid_joint_state(&s, 1).separation, 1e-5f);
  sbr_character_set_rigid_mode(s.world, s.character, -1, SBR_RIGID_KINEMATIC);
  scene_ticks(&s, 2);
  ck_assert_float_eq_tol(rigid_state(&s, 2).center.y, 1.625f + 0.02f, 1e-5f);
  scene_free(&s);
}
END_TEST

/* The same bits from a snapshot. In the end it sleeps until an impulse wakes it. */
START_TEST(snapshots_and_sleep)
{
  scene s = person();
  s.world_definition.sleep_after_s = 0.5;
  scene_start(&s);
  person_shove(&s, 1, (sbf_vec3){0, 0, 60});
  scene_ticks(&s, 30);
  size_t size = sbr_world_get_snapshot_size(s.world);
  void *kept = malloc(size);
  ck_assert_int_eq(sbr_world_save_snapshot(s.world, kept, size), SBF_OK);
  scene_ticks(&s, 60);
  uint64_t first = sbr_world_get_state_hash(s.world);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, kept, size), SBF_OK);
  scene_ticks(&s, 60);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), first);
  free(kept);
  scene_ticks(&s, 400);
  ck_assert_float_eq(person_fastest(&s), 0);
  sbf_vec3 before = rigid_state(&s, 1).center;
  person_shove(&s, 1, (sbf_vec3){100, 100, 0});
  scene_ticks(&s, 10);
  sbf_vec3 after = rigid_state(&s, 1).center;
  ck_assert_float_ge(
      fabsf(after.x - before.x) + fabsf(after.y - before.y) + fabsf(after.z - before.z), 0.02f);
  scene_free(&s);
}
END_TEST

/* A body of twice the size falls as physics predicts: the same shape after sqrt 2 times as long. */
START_TEST(a_larger_person_falls_equally)
{
  sbr_joint_state small, large;
  for (int i = 0; i < 2; i++) {
    scene s = person();
    s.character_definition.scale = i ? 4 : 1;
    s.character_definition.position.y *= i ? 4 : 1;
    scene_start(&s);
    person_shove(&s, 1, (sbf_vec3){0, 0, 20.0f * (i ? 128 : 1)}); /* mass 64, speed 2 */
    scene_ticks(&s, i ? 60 : 30);
    *(i ? &large : &small) = rigid_joint_state(&s, 5);
    scene_free(&s);
  }
  ck_assert_float_eq_tol(
      small.coordinates[SBF_JOINT_AXIS_SWING], large.coordinates[SBF_JOINT_AXIS_SWING], 0.02f);
  ck_assert_float_ge(small.coordinates[SBF_JOINT_AXIS_SWING], 0.02f);
}
END_TEST

START_TEST(invalid_impulses_are_ignored)
{
  scene s = person();
  scene_start(&s);
  scene_ticks(&s, 5);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  sbr_rigid_drive drive = sbr_default_rigid_drive();
  sbr_fall_definition fall = sbr_default_fall_definition();
  drive.strength = fall.rest_s = INFINITY;
  sbr_character_apply_rigid_impulse(s.world, s.character, 1, (sbr_double3){0, 1, 0}, (sbf_vec3){0, NAN, 0});
  sbr_character_apply_rigid_impulse(
      s.world, s.character, 1, (sbr_double3){INFINITY, 1, 0}, (sbf_vec3){0, 1, 0});
  sbr_character_set_rigid_drive_fraction(s.world, s.character, -1, NAN);
  sbr_character_set_rigid_drive(s.world, s.character, &drive);
  sbr_character_knock_over(s.world, s.character, &fall);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hash);
  person_shove(&s, 1, (sbf_vec3){0, 1, 0});
  ck_assert_uint_ne(sbr_world_get_state_hash(s.world), hash);
  scene_free(&s);
}
END_TEST

/* A zeroed definition is refused; a default one is not. */
START_TEST(definitions_begin_with_the_default)
{
  scene s = person();
  scene_start(&s);
  scene_ticks(&s, 5);
  const sbr_fall_definition zeros = {.rest_s = 0}, fall = sbr_default_fall_definition();
  sbr_character_knock_over(s.world, s.character, &zeros);
  ck_assert_int_eq(sbr_character_get_posture(s.world, s.character), SBR_POSTURE_UPRIGHT);
  sbr_character_knock_over(s.world, s.character, &fall);
  ck_assert_int_eq(sbr_character_get_posture(s.world, s.character), SBR_POSTURE_FALLING);
  scene_free(&s);
}
END_TEST

START_TEST(bodies_and_joints_are_found_by_name)
{
  scene s = person();
  scene_start(&s);
  int first, second;
  const uint32_t last = s.asset->rigid_bodies.count - 1, joints = s.asset->joints.count;
  ck_assert(sbr_character_has_rigid_body(s.world, s.character, last));
  ck_assert(!sbr_character_has_rigid_body(s.world, s.character, last + 1));
  ck_assert(sbr_character_has_joint(s.world, s.character, joints - 1));
  ck_assert(!sbr_character_has_joint(s.world, s.character, joints));
  ck_assert_ptr_null(sbr_character_get_rigid_user_data(s.world, s.character, last));
  sbr_character_set_rigid_user_data(s.world, s.character, 0, &first);
  sbr_character_set_rigid_user_data(s.world, s.character, last, &second);
  sbr_character_set_rigid_user_data(s.world, s.character, last + 1, &first);
  for (uint32_t b = 0; b < s.asset->soft_bodies.count; b++) {
    ck_assert(sbr_character_has_soft_body(s.world, s.character, b));
    ck_assert_ptr_null(sbr_character_get_soft_user_data(s.world, s.character, b));
    sbr_character_set_soft_user_data(s.world, s.character, b, &s);
  }
  scene_ticks(&s, 3);
  ck_assert_ptr_eq(sbr_character_get_rigid_user_data(s.world, s.character, 0), &first);
  ck_assert_ptr_eq(sbr_character_get_rigid_user_data(s.world, s.character, last), &second);
  ck_assert_ptr_null(sbr_character_get_rigid_user_data(s.world, s.character, last + 1));
  for (uint32_t b = 0; b < s.asset->soft_bodies.count; b++)
    ck_assert_ptr_eq(sbr_character_get_soft_user_data(s.world, s.character, b), &s);
  sbr_character_destroy(s.world, s.character);
  ck_assert(!sbr_character_has_rigid_body(s.world, s.character, 0));
  ck_assert(!sbr_character_has_joint(s.world, s.character, 0));
  ck_assert(!sbr_character_has_soft_body(s.world, s.character, 0));
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rigid_parts");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, a_person_falls_and_comes_to_rest, 0, 4);
  tcase_add_test(tests, bones_follow_their_bodies);
  tcase_add_test(tests, drives_keep_the_pose);
  tcase_add_test(tests, modes_change_in_motion);
  tcase_add_test(tests, snapshots_and_sleep);
  tcase_add_test(tests, a_larger_person_falls_equally);
  tcase_add_test(tests, invalid_impulses_are_ignored);
  tcase_add_test(tests, definitions_begin_with_the_default);
  tcase_add_test(tests, bodies_and_joints_are_found_by_name);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
