#include <math.h>

#include "harness.h"
#include "scenes.h"

enum { POINTS = 51, SECONDS = 2 };

static scene walker(void) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0.5f, 0});
  scene_body(&s, 0)->attributes.damping_ratio = 0.15f;
  scene_section(&s, 0, (sbf_vec3){0, 0.5f, 0}, (sbf_vec3){0.3f, 0.2f, 0.5f}, 2);
  scene_skin(&s, 0);
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_flat(0);
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 1, 0, 0.8f);
  return s;
}

/* Points at whole seconds, stepped at `fps`. */
static void run(double fps, sbf_vec3 (*points)[POINTS], sbr_double3 *origins) {
  scene s = walker();
  for (int second = 0; second < SECONDS; second++) {
    for (int i = 0; i < (int)fps; i++) sbr_world_step(s.world, 1 / fps);
    scene_read(&s, 0, points[second], POINTS);
    origins[second] = sbr_character_get_origin(s.world, s.character);
  }
  scene_free(&s);
}

START_TEST(every_frame_rate_shows_the_same_motion)
{
  static sbf_vec3 at60[SECONDS][POINTS], other[SECONDS][POINTS];
  sbr_double3 origins60[SECONDS], origins[SECONDS];
  run(60, at60, origins60);
  const double rates[] = {30, 144, 25, 1000};
  for (int r = 0; r < 4; r++) {
    run(rates[r], other, origins);
    for (int k = 0; k < SECONDS; k++)
      for (int i = 0; i < POINTS; i++) {
        double x = other[k][i].x + origins[k].x - at60[k][i].x - origins60[k].x;
        double y = other[k][i].y + origins[k].y - at60[k][i].y - origins60[k].y;
        double z = other[k][i].z + origins[k].z - at60[k][i].z - origins60[k].z;
        ck_assert_double_lt(sqrt(x * x + y * y + z * z), 2e-5);
      }
  }
}
END_TEST

START_TEST(uneven_and_long_frames_change_nothing)
{
  enum { TICKS = 150 };
  uint64_t hashes[TICKS + 32] = {0};
  scene even = walker(), uneven = walker();
  for (int i = 1; i <= TICKS + 31; i++) {
    sbr_world_tick(even.world);
    hashes[i] = sbr_world_get_state_hash(even.world);
  }
  for (uint32_t k = 0; sbr_world_get_tick_count(uneven.world) < TICKS; k++) {
    double jitter = (double)(k * 2654435761u % 1000) / 1000, frame_s = 0.004 + 0.03 * jitter;
    sbr_world_step(uneven.world, k % 40 == 39 ? 0.25 : frame_s);
    ck_assert_uint_eq(sbr_world_get_state_hash(uneven.world), hashes[sbr_world_get_tick_count(uneven.world)]);
  }
  scene_free(&even);
  scene_free(&uneven);
}
END_TEST

START_TEST(poses_between_ticks_are_interpolated_linearly)
{
  scene s = walker();
  scene_ticks(&s, 10);
  sbf_vec3 a = scene_point(&s, 0, 2);
  sbr_transform bone_a, bone;
  sbr_character_get_bones(s.world, s.character, &bone_a, 1);
  sbr_world_step(s.world, 0.25 / 60); /* a quarter into the next tick */
  ck_assert_uint_eq(sbr_world_get_tick_count(s.world), 11);
  sbf_vec3 quarter = scene_point(&s, 0, 2);
  sbr_character_get_bones(s.world, s.character, &bone, 1);
  sbr_world_step(s.world, 0.75 / 60);
  ck_assert_uint_eq(sbr_world_get_tick_count(s.world), 11);
  sbf_vec3 b = scene_point(&s, 0, 2);
  sbr_transform bone_b;
  sbr_character_get_bones(s.world, s.character, &bone_b, 1);
  ck_assert_float_eq_tol(quarter.z, a.z + 0.25f * (b.z - a.z), 1e-6f);
  ck_assert_float_eq_tol(
      bone.position.z, bone_a.position.z + 0.25f * (bone_b.position.z - bone_a.position.z), 1e-6f);
  ck_assert_float_gt(b.z - a.z, 1e-3f);
  scene_free(&s);
}
END_TEST

START_TEST(small_buffers_are_not_overrun)
{
  scene s = walker();
  sbf_vec3 points[3] = {{9, 9, 9}, {9, 9, 9}, {9, 9, 9}}, normals[3] = {{9, 9, 9}, {9, 9, 9}, {9, 9, 9}};
  ck_assert_uint_eq(sbr_character_get_skin(s.world, s.character, 0, points, normals, NULL, 2), 26);
  ck_assert(points[1].x != 9 && points[2].x == 9 && normals[1].x != 9 && normals[2].x == 9);
  ck_assert_uint_eq(sbr_character_get_surface(s.world, s.character, 0, points, 1), 26);
  ck_assert_uint_eq(sbr_character_get_points(s.world, s.character, 0, points, 1), POINTS);
  ck_assert_float_eq(points[2].x, 9);
  ck_assert_uint_eq(sbr_character_get_skin(s.world, s.character, 7, points, normals, NULL, 2), 0);
  ck_assert_uint_eq(sbr_character_get_surface(s.world, s.character, 7, points, 2), 0);
  ck_assert_uint_eq(sbr_character_get_corner_normals(s.world, s.character, 0, normals, 1), 4 * 24);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("sample");
  TCase *c = tcase_create("sample");
  tcase_add_test(c, every_frame_rate_shows_the_same_motion);
  tcase_add_test(c, uneven_and_long_frames_change_nothing);
  tcase_add_test(c, poses_between_ticks_are_interpolated_linearly);
  tcase_add_test(c, small_buffers_are_not_overrun);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
