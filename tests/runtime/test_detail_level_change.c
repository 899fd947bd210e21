#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "detail_scenes.h"
#include "harness.h"
#include "soft/solvers/rigid_motion.h"
#include "tape.h"
#include "world/detail/detail_levels.h"

/* Half a pixel of a screen of 1080, 60 degrees high, two metres away. */
static const double HALF_PIXEL_M = 0.5 * 2 * 2 * 0.57735 / 1080;

/* From each detail level to each other one, except the offscreen level. */
enum { CHANGES = DETAIL_OFFSCREEN * (DETAIL_OFFSCREEN - 1) };
static uint32_t from_of(int i) {
  return (uint32_t)i / (DETAIL_OFFSCREEN - 1);
}
static uint32_t to_of(int i) {
  uint32_t to = (uint32_t)i % (DETAIL_OFFSCREEN - 1);
  return to + (to >= from_of(i));
}

/* Extra distance that each vertex moves in the tick of the change and in the next ones, compared with a
 * character that stays on either level. */
START_TEST(the_skin_does_not_jump)
{
  scene s = detail_scene_walking(from_of(_i)), stays = detail_scene_walking(from_of(_i));
  static sbf_vec3 was[RUNG_VERTICES], is[RUNG_VERTICES], stay_was[RUNG_VERTICES], stay_is[RUNG_VERTICES];
  uint32_t count = detail_scene_skin(&s, was);
  detail_scene_skin(&stays, stay_was);
  sbr_character_set_detail_level(s.world, s.character, to_of(_i));
  ck_assert_uint_eq(sbr_character_get_detail_level(s.world, s.character), to_of(_i));
  detail_scene_skin(&s, is);
  ck_assert(detail_scene_farthest(was, is, count) == 0);
  sbr_world_step(s.world, 1e-4); /* no visible difference a moment later either */
  ck_assert(sbr_character_get_detail_fade(s.world, s.character) > 0.9f);
  detail_scene_skin(&s, is);
  ck_assert(detail_scene_farthest(was, is, count) < HALF_PIXEL_M / 10);
  sbr_world_step(s.world, 2.0 / 60 - 1e-4);
  scene_ticks(&stays, 2);
  ck_assert(sbr_character_get_detail_fade(s.world, s.character) < 1);
  detail_scene_skin(&s, is);
  detail_scene_skin(&stays, stay_is);
  ck_assert_msg(detail_scene_farthest(is, stay_is, count) < HALF_PIXEL_M, "%u to %u: %g m", from_of(_i),
      to_of(_i), detail_scene_farthest(is, stay_is, count));
  for (int t = 0; t < 300 && sbr_character_get_detail_fade(s.world, s.character) > 0; t++) scene_ticks(&s, 1);
  ck_assert(sbr_character_get_detail_fade(s.world, s.character) == 0);
  scene_free(&s);
  scene_free(&stays);
}
END_TEST

START_TEST(energy_does_not_rise_and_the_motion_continues)
{
  const uint32_t from = (uint32_t)_i, to = 1 - from;
  scene s = detail_scene_walking(from), other = detail_scene_walking(to);
  sbr_character_set_detail_level(s.world, s.character, to);
  detail_scene_ticks(&s, &other, 1); /* it is in view, and changes level in the next tick */
  double elastic = detail_scene_elastic(&s), kinetic = detail_scene_kinetic(&s);
  ck_assert(elastic > 0);
  sbr_world_step(s.world, 1e-9); /* the only difference is the change, and one tick */
  ck_assert_msg(detail_scene_elastic(&s) < 1.5 * elastic, "%g J to %g", elastic, detail_scene_elastic(&s));
  ck_assert_msg(detail_scene_kinetic(&s) < 1.1 * kinetic, "%g J to %g", kinetic, detail_scene_kinetic(&s));
  double max = 0;
  for (int t = 0; t < 120; t++) {
    detail_scene_ticks(&s, &other, 1);
    max = fmax(max, detail_scene_elastic(&s));
    ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  }
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).recoveries, 0);
  ck_assert_msg(max < 2 * fmax(elastic, detail_scene_elastic(&other)), "%g J up to %g", elastic, max);
  ck_assert_msg(detail_scene_apart(&s, &other) < 2e-3, "%g m", detail_scene_apart(&s, &other));
  scene_free(&s);
  scene_free(&other);
}
END_TEST

/* A loose box that falls. */
START_TEST(flying_bodies_continue_to_fly)
{
  scene s = detail_scene_begin(true), stays = detail_scene_begin(true);
  s.world_definition.has_gravity = stays.world_definition.has_gravity = true;
  s.world_definition.gravity = stays.world_definition.gravity = (sbf_vec3){0, -2, 0};
  scene_start(&s);
  scene_start(&stays);
  detail_scene_ticks(&s, &stays, 30);
  for (uint32_t n = 0; n < 4; n++) {
    sbr_character_set_detail_level(s.world, s.character, (n + 1) % 2);
    detail_scene_ticks(&s, &stays, 10);
    ck_assert_msg(detail_scene_apart(&s, &stays) < 1e-3, "%g m", detail_scene_apart(&s, &stays));
  }
  scene_free(&s);
  scene_free(&stays);
}
END_TEST

static sbri_rigid_motion motion_of(const scene *s) {
  sbri_character *c = sbri_character_of(s->world, s->character);
  return sbri_rigid_motion_find(
      &c->model->islands[0], &c->model->bodies[0], sbri_positions(c), sbri_velocities(c));
}

/* So many rad/s more, about a skew axis through its middle. */
static void angular_velocity(const scene *s, float rad_s) {
  sbri_character *c = sbri_character_of(s->world, s->character);
  sbf_vec3 axis = {0.48f * rad_s, 0.6f * rad_s, 0.64f * rad_s}, middle = motion_of(s).center;
  for (uint32_t i = 0; i < c->model->islands[0].free_count; i++) {
    const sbri_point *at = &sbri_positions(c)[i];
    sbf_vec3 v = sbri_cross(axis, sbri_sub(sbri_vec3(at->x, at->y, at->z), middle));
    float *to = sbri_velocities(c) + 3 * (i / SBRI_BLOCK * SBRI_BLOCK) + i % SBRI_BLOCK;
    to[0] += v.x, to[SBRI_BLOCK] += v.y, to[2 * SBRI_BLOCK] += v.z;
  }
}

/* Its momentum and its turning; in the coarse lattice it has 1.8 times the inertia. */
START_TEST(rotating_bodies_continue_to_rotate)
{
  static const float spins[3] = {1, 4, 12};
  scene s = detail_scene_begin(true);
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, -2, 0};
  scene_start(&s);
  angular_velocity(&s, spins[_i]);
  scene_ticks(&s, 30);
  for (uint32_t n = 0; n < 6; n++) {
    sbr_character_set_detail_level(s.world, s.character, (n + 1) % 2);
    scene_ticks(&s, 1); /* it is looked at */
    sbri_rigid_motion was = motion_of(&s);
    sbri_detail_level_change(s.world, sbri_character_of(s.world, s.character));
    sbri_rigid_motion is = motion_of(&s);
    float inertia = is.inertia[0] / was.inertia[0];
    ck_assert(n % 2 ? inertia < 1 / 1.5f : inertia > 1.5f);
    float push = sbri_length(sbri_sub(is.velocity, was.velocity));
    float turn = sbri_length(sbri_sub(is.angular_velocity, was.angular_velocity));
    ck_assert_msg(push < 1e-4f, "change %u: %g m/s", n, (double)push);
    ck_assert_msg(turn < 1e-4f * spins[_i], "change %u: %g rad/s", n, (double)turn);
    scene_ticks(&s, 10);
  }
  scene_free(&s);
}
END_TEST

START_TEST(a_character_without_level_follows_its_drive_and_returns)
{
  scene s = detail_scene_walking(DETAIL_OFFSCREEN), stays = detail_scene_walking(DETAIL_BONES);
  double distance = sbr_character_get_distance(s.world, s.character);
  ck_assert(distance > 0.5);
  ck_assert(fabs(distance - sbr_character_get_distance(stays.world, stays.character)) < 1e-3);
  sbr_character_set_detail_level(s.world, s.character, DETAIL_FINE);
  detail_scene_ticks(&s, &stays, 120);
  ck_assert(detail_scene_apart(&s, &stays) < 0.03);
  ck_assert(detail_scene_elastic(&s) > 0);
  ck_assert(fabs(sbr_character_get_distance(s.world, s.character) -
                 sbr_character_get_distance(stays.world, stays.character)) < 1e-3);
  scene_free(&s);
  scene_free(&stays);
}
END_TEST

/* Expected motion of the middle of a shaken bone, by the follower's equation. */
START_TEST(jiggle_follows_its_bone)
{
  scene s = detail_scene_walking(DETAIL_JIGGLE), bones = detail_scene_walking(DETAIL_BONES);
  static sbf_vec3 a[RUNG_VERTICES], b[RUNG_VERTICES];
  uint32_t count = detail_scene_skin(&s, a);
  detail_scene_skin(&bones, b);
  double steady = detail_scene_farthest(a, b, count);
  ck_assert_msg(steady < 2e-3, "%g m", steady); /* it turns: its middle speeds up by 0.4 m/s^2 */
  sbr_character_set_drive(s.world, s.character, -0.5f, 0, 0);
  sbr_character_set_drive(bones.world, bones.character, -0.5f, 0, 0);
  double max = 0;
  for (int t = 0; t < 60; t++) {
    scene_ticks(&s, 1);
    scene_ticks(&bones, 1);
    count = detail_scene_skin(&s, a);
    detail_scene_skin(&bones, b);
    max = fmax(max, detail_scene_farthest(a, b, count));
    sbf_vec3 off = {a[0].x - b[0].x, a[0].y - b[0].y, a[0].z - b[0].z};
    for (uint32_t v = 0; v < count; v++) { /* as one piece */
      ck_assert(fabsf(a[v].x - b[v].x - off.x) < 1e-5f && fabsf(a[v].z - b[v].z - off.z) < 1e-5f);
    }
  }
  ck_assert_msg(max > 3e-3 && max < 3e-2, "%g m", max);
  for (int t = 0; t < 300; t++) scene_ticks(&s, 1), scene_ticks(&bones, 1);
  detail_scene_skin(&s, a);
  detail_scene_skin(&bones, b);
  ck_assert(detail_scene_farthest(a, b, count) < 1e-5);
  scene_free(&s);
  scene_free(&bones);
}
END_TEST

/* Up and down the detail levels, teleported and reset meanwhile. */
static uint64_t wander(scene *s) {
  static const uint32_t path[] = {1, 2, 0, 4, 3, 1, 0, 3, 4, 0};
  for (uint32_t i = 0; i < 10; i++) {
    sbr_character_set_detail_level(s->world, s->character, path[i]);
    for (uint32_t t = 0; t < 8 + i; t++) sbr_world_step(s->world, 0.013);
    if (i == 3) sbr_character_teleport(s->world, s->character, (sbr_double3){3, 1000, 8}, 1);
    if (i == 6) sbr_character_reset(s->world, s->character);
    ck_assert(sbr_character_get_body_health(s->world, s->character, 0).finite);
  }
  return sbr_world_get_state_hash(s->world);
}

START_TEST(snapshots_store_detail_levels_and_fades)
{
  scene s = detail_scene_walking(DETAIL_FINE);
  static sbf_vec3 a[RUNG_VERTICES], b[RUNG_VERTICES];
  sbr_character_set_detail_level(s.world, s.character, DETAIL_JIGGLE);
  scene_ticks(&s, 4);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  size_t size = sbr_world_get_snapshot_size(s.world);
  unsigned char *bytes = malloc(size);
  ck_assert_int_eq(sbr_world_save_snapshot(s.world, bytes, size), SBF_OK);
  uint32_t count = detail_scene_skin(&s, a);
  uint64_t end = wander(&s);
  ck_assert_uint_eq(sbr_world_get_snapshot_size(s.world), size);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_OK);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hash);
  ck_assert_uint_eq(sbr_character_get_detail_level(s.world, s.character), DETAIL_JIGGLE);
  detail_scene_skin(&s, b);
  ck_assert(detail_scene_farthest(a, b, count) == 0);
  ck_assert_uint_eq(wander(&s), end);
  free(bytes);
  scene_free(&s);
}
END_TEST

START_TEST(recordings_store_changes)
{
  static tape t;
  const sbr_record_output output = {tape_keep, &t};
  scene s = detail_scene_begin(false), again = detail_scene_begin(false);
  scene_start(&s);
  scene_start(&again);
  sbr_world_set_recording(s.world, &output);
  uint64_t end = wander(&s);
  sbr_world_set_recording(s.world, NULL);
  sbr_replay replay;
  ck_assert_int_eq(sbr_replay_begin(&replay, again.world, t.bytes, t.size, NULL), SBF_OK);
  while (sbr_replay_step(&replay)) {}
  ck_assert(!replay.differs);
  ck_assert_uint_gt(replay.checks, 1);
  ck_assert_uint_eq(sbr_world_get_state_hash(again.world), end);
  scene_free(&s);
  scene_free(&again);
}
END_TEST

START_TEST(bones_that_stand_sleep_and_wake_for_a_change)
{
  scene s = detail_scene_begin(false);
  s.world_definition.sleep_after_s = 0.5;
  scene_start(&s);
  sbr_character_set_detail_level(s.world, s.character, DETAIL_BONES);
  scene_ticks(&s, 120);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  sbr_character_set_detail_level(s.world, s.character, DETAIL_FINE);
  scene_ticks(&s, 60);
  ck_assert_uint_ne(sbr_world_get_state_hash(s.world), hash);
  ck_assert(detail_scene_elastic(&s) > 0);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *s = suite_create("detail level change");
  TCase *c = tcase_create("detail level change");
  tcase_add_loop_test(c, the_skin_does_not_jump, 0, CHANGES);
  tcase_add_loop_test(c, energy_does_not_rise_and_the_motion_continues, 0, 2);
  tcase_add_test(c, flying_bodies_continue_to_fly);
  tcase_add_loop_test(c, rotating_bodies_continue_to_rotate, 0, 3);
  tcase_add_test(c, a_character_without_level_follows_its_drive_and_returns);
  tcase_add_test(c, jiggle_follows_its_bone);
  tcase_add_test(c, snapshots_store_detail_levels_and_fades);
  tcase_add_test(c, recordings_store_changes);
  tcase_add_test(c, bones_that_stand_sleep_and_wake_for_a_change);
  suite_add_tcase(s, c);
  return harness_run(s);
}
