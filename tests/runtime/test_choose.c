#include <math.h>
#include <stdlib.h>

#include "detail_scenes.h"
#include "harness.h"
#include "host_threads.h"
#include "sbfmt/codes.h"
#include "tape.h"

enum { CROWD = 12 };

typedef struct crowd {
  scene s;
  sbr_character_id ids[CROWD];
} crowd;

static sbr_view view_from(double z) {
  return (sbr_view){{0, 1, z}, {0, 0, 1}, 1.0472f, 16.0f / 9, 1080};
}

/* Boxes in a row along +Z, two metres apart, in a world that chooses. */
static crowd make_crowd(const sbr_detail_definition *how, const sbr_tasks *tasks) {
  crowd c = {.s = detail_scene_begin(false)};
  sbr_detail_definition by_default = sbr_default_detail_definition();
  if (tasks) c.s.world_definition.tasks = *tasks;
  scene_start(&c.s);
  ck_assert_int_eq(sbr_world_select_detail_levels(c.s.world, how ? how : &by_default, NULL), SBF_OK);
  c.ids[0] = c.s.character;
  for (uint32_t i = 1; i < CROWD; i++) {
    sbr_character_definition where = c.s.character_definition;
    where.position.z = 2.0 * i;
    ck_assert_int_eq(sbr_character_create(c.s.world, c.s.model, &where, &c.ids[i], NULL), SBF_OK);
  }
  return c;
}

static uint32_t detail_level_of(const crowd *c, uint32_t i) {
  return sbr_character_get_detail_level(c->s.world, c->ids[i]);
}

static void check(crowd *c, double z, uint32_t ticks) {
  const sbr_view view = view_from(z);
  for (uint32_t t = 0; t < ticks; t++) {
    sbr_world_set_views(c->s.world, &view, 1);
    sbr_world_tick(c->s.world);
  }
}

START_TEST(distant_characters_are_coarse_and_invisible_ones_have_no_level)
{
  crowd c = make_crowd(NULL, NULL);
  check(&c, -1, 2);
  ck_assert_uint_eq(detail_level_of(&c, 0), DETAIL_FINE);
  for (uint32_t i = 0; i < CROWD; i++) {
    ck_assert(sbr_character_get_error_px(c.s.world, c.ids[i]) <= 0.5f);
    if (i > 0) ck_assert_uint_ge(detail_level_of(&c, i), detail_level_of(&c, i - 1));
  }
  check(&c, -120, 40); /* 2 cm of the bones' error, 120 m away: 0.15 pixels */
  ck_assert_uint_eq(detail_level_of(&c, 0), DETAIL_BONES);
  ck_assert(sbr_character_get_error_px(c.s.world, c.ids[0]) > 0.1f);
  check(&c, 200, 30); /* all are behind */
  ck_assert_uint_eq(detail_level_of(&c, 0), DETAIL_BONES);
  ck_assert(sbr_character_get_error_px(c.s.world, c.ids[0]) == 0);
  check(&c, 200, 40);
  for (uint32_t i = 0; i < CROWD; i++) ck_assert_uint_eq(detail_level_of(&c, i), DETAIL_OFFSCREEN);
  check(&c, -1, 1);
  ck_assert_uint_eq(detail_level_of(&c, 0), DETAIL_FINE);
  ck_assert(sbr_character_get_detail_fade(c.s.world, c.ids[0]) == 0); /* nobody has seen where it was */
  ck_assert(sbr_character_get_body_health(c.s.world, c.ids[0], 0).elastic_j > 0);
  scene_free(&c.s);
}
END_TEST

/* At rest, seen from z metres away: error x lines / (2 tan(height / 2) x distance), the distance to the
 * nearest of the box; and the coarse level is taken where that is below 0.7 of half a pixel. */
START_TEST(predicted_pixels_are_those_of_the_measured_error)
{
  const float error_m = 0.004f;
  for (int i = 0; i < 2; i++) {
    double distance = i ? 16 : 9, pixels = (double)error_m * 1080 / (2 * tan(0.5236) * distance);
    crowd c = {.s = detail_scene_begin(false)};
    sbf_level *levels = (sbf_level *)(uintptr_t)scene_body(&c.s, 0)->levels.at;
    const sbr_detail_definition by_default = sbr_default_detail_definition();
    const sbr_view view = view_from(-distance);
    levels[1].simulation.motion_error = error_m;
    scene_start(&c.s);
    ck_assert_int_eq(sbr_world_select_detail_levels(c.s.world, &by_default, NULL), SBF_OK);
    for (int t = 0; t < 40; t++) {
      sbr_world_set_views(c.s.world, &view, 1);
      sbr_world_tick(c.s.world);
    }
    ck_assert_uint_eq(sbr_character_get_detail_level(c.s.world, c.s.character), pixels < 0.35 ? 1u : 0u);
    sbr_character_set_detail_level(c.s.world, c.s.character, 1);
    sbr_world_tick(c.s.world);
    double said = (double)sbr_character_get_error_px(c.s.world, c.s.character);
    ck_assert_double_ge(said, pixels);
    ck_assert_double_le(said, 1.1 * pixels);
    scene_free(&c.s);
  }
}
END_TEST

START_TEST(the_host_can_override_the_choice)
{
  crowd c = make_crowd(NULL, NULL);
  sbr_character_set_visibility(c.s.world, c.ids[0], SBR_VISIBILITY_NEVER);
  sbr_character_set_detail_level(c.s.world, c.ids[1], DETAIL_COARSE);
  check(&c, -1, 70);
  ck_assert_uint_eq(detail_level_of(&c, 0), DETAIL_OFFSCREEN);
  ck_assert_uint_eq(detail_level_of(&c, 1), DETAIL_COARSE);
  sbr_character_set_visibility(c.s.world, c.ids[0], SBR_VISIBILITY_BY_VIEWS);
  sbr_character_set_visibility(c.s.world, c.ids[1], SBR_VISIBILITY_ALWAYS);
  sbr_character_set_detail_level(c.s.world, c.ids[1], SBR_DETAIL_AUTOMATIC);
  check(&c, 3, 70); /* both are behind */
  ck_assert_uint_eq(detail_level_of(&c, 0), DETAIL_OFFSCREEN);
  ck_assert_uint_eq(detail_level_of(&c, 1), DETAIL_FINE);
  scene_free(&c.s);
}
END_TEST

START_TEST(a_camera_that_trembles_changes_nothing)
{
  crowd c = make_crowd(NULL, NULL);
  uint32_t changes = 0, was[CROWD];
  check(&c, -20, 60);
  for (uint32_t i = 0; i < CROWD; i++) was[i] = detail_level_of(&c, i);
  for (int t = 0; t < 300; t++) {
    check(&c, -20 + (t % 2 ? 1.0 : -1.0), 1);
    for (uint32_t i = 0; i < CROWD; i++) {
      changes += detail_level_of(&c, i) != was[i];
      was[i] = detail_level_of(&c, i);
    }
  }
  ck_assert_uint_le(changes, 2); /* to the finer of the two levels */
  scene_free(&c.s);
}
END_TEST

/* From three metres away, looking `aside` rad beside it. */
static uint32_t detail_level_beside(crowd *c, double aside) {
  sbr_view view = view_from(-3);
  view.forward = (sbf_vec3){(float)sin(aside), 0, (float)cos(aside)};
  sbr_world_set_views(c->s.world, &view, 1);
  sbr_world_tick(c->s.world);
  return detail_level_of(c, 0);
}

/* A character outside the view becomes fine within one tick, before it is visible. It never alternates
 * between levels. */
START_TEST(a_rotating_view_finds_fine_levels)
{
  crowd c = make_crowd(NULL, NULL);
  double in = 0, out = 0, step = 0.002, far = 1.6;
  const double edge = atan(tan(0.5236) * sqrt(1 + 256.0 / 81));
  uint32_t changes = 0, detail_level, before = DETAIL_BONES;
  for (uint32_t t = 0; t < 5; t++) detail_level_beside(&c, far);
  ck_assert_uint_eq(detail_level_of(&c, 0), DETAIL_BONES);
  for (double aside = far; aside > 0; aside -= step)
    for (int tick = 0; tick < 3; tick++, before = detail_level) {
      detail_level = detail_level_beside(&c, aside);
      if ((detail_level == DETAIL_FINE) == (before == DETAIL_FINE)) continue;
      ck_assert(sbr_character_get_detail_fade(c.s.world, c.ids[0]) == 0);
      in = aside, changes++;
    }
  ck_assert_uint_eq(changes, 1);
  ck_assert_double_gt(in, edge);
  for (double aside = 0; aside < far; aside += step)
    for (int tick = 0; tick < 3; tick++, before = detail_level) {
      detail_level = detail_level_beside(&c, aside);
      if ((detail_level == DETAIL_FINE) != (before == DETAIL_FINE)) out = aside, changes++;
    }
  ck_assert_uint_eq(changes, 2);
  ck_assert_double_gt(out, in + 5 * step);
  scene_free(&c.s);
}
END_TEST

START_TEST(a_budget_is_kept_and_spent_on_near_characters)
{
  sbr_detail_level detail_levels[8];
  scene alone = detail_scene_begin(false);
  scene_start(&alone);
  sbr_model_get_detail_levels(alone.model, detail_levels, 8);
  scene_free(&alone);
  sbr_detail_definition how = sbr_default_detail_definition();
  how.error_px = 1e-3f; /* without a budget, all would be at the finest level */
  double all = CROWD * (double)detail_levels[0].visits, max = 6 * (double)detail_levels[0].visits;
  how.budget_us = (float)(max * (double)how.ns_per_visit * 1e-3);
  crowd c = make_crowd(&how, NULL);
  check(&c, -6, 90);
  ck_assert(all > max);
  ck_assert_msg(sbr_world_get_element_visits(c.s.world) <= max, "%g of %g visits",
      sbr_world_get_element_visits(c.s.world), max);
  ck_assert(sbr_world_get_element_visits(c.s.world) > 0.6 * max);
  ck_assert_uint_eq(detail_level_of(&c, 0), DETAIL_FINE);
  ck_assert_uint_gt(detail_level_of(&c, CROWD - 1), DETAIL_FINE);
  for (uint32_t i = 1; i < CROWD; i++) ck_assert_uint_ge(detail_level_of(&c, i), detail_level_of(&c, i - 1));
  scene_free(&c.s);
}
END_TEST

/* Through the crowd and back. */
static uint64_t fly(crowd *c) {
  for (uint32_t i = 0; i < CROWD; i++)
    sbr_character_set_drive(c->s.world, c->ids[i], 0.3f, 0, i % 2 ? 0.4f : -0.4f);
  for (int t = 0; t < 200; t++) check(c, -10 + 0.3 * t - (t > 100 ? 0.6 * (t - 100) : 0), 1);
  return sbr_world_get_state_hash(c->s.world);
}

START_TEST(threads_and_recordings_agree)
{
  static tape t;
  const sbr_record_output output = {tape_keep, &t};
  sbr_detail_definition how = sbr_default_detail_definition();
  how.budget_us = 100;
  static int threads = 3;
  const sbr_tasks tasks = {run_on_threads, &threads};
  crowd one = make_crowd(&how, NULL), several = make_crowd(&how, &tasks), again = make_crowd(&how, NULL);
  sbr_world_set_recording(one.s.world, &output);
  uint64_t hash = fly(&one);
  sbr_world_set_recording(one.s.world, NULL);
  ck_assert_uint_eq(fly(&several), hash);
  sbr_replay replay;
  ck_assert_int_eq(sbr_replay_begin(&replay, again.s.world, t.bytes, t.size, NULL), SBF_OK);
  while (sbr_replay_step(&replay)) {}
  ck_assert(!replay.differs);
  ck_assert_uint_eq(sbr_world_get_state_hash(again.s.world), hash);
  scene_free(&one.s);
  scene_free(&several.s);
  scene_free(&again.s);
}
END_TEST

START_TEST(wrong_definitions_and_failed_allocations_are_reported)
{
  crowd c = make_crowd(NULL, NULL);
  sbr_detail_definition how = sbr_default_detail_definition();
  sbf_diagnostic error;
  how.error_px = 0;
  ck_assert_int_eq(sbr_world_select_detail_levels(c.s.world, &how, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_BAD_CALL);
  how = (sbr_detail_definition){.error_px = 1};
  ck_assert_int_eq(sbr_world_select_detail_levels(c.s.world, &how, &error), SBF_FAILED);
  ck_assert_int_eq(sbr_world_select_detail_levels(NULL, &how, &error), SBF_FAILED);
  scene_free(&c.s);
  for (size_t allowed = 0; allowed < 3; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, SIZE_MAX);
    sbr_world_definition definition = sbr_default_world_definition();
    definition.allocator = &memory.allocator;
    sbr_world *world;
    ck_assert_int_eq(sbr_world_create(&definition, &world, NULL), SBF_OK);
    how = sbr_default_detail_definition();
    memory.allowed = memory.calls + allowed;
    ck_assert_int_eq(sbr_world_select_detail_levels(world, &how, &error), SBF_FAILED);
    ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    sbr_world_tick(world);
    sbr_world_destroy(world);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

int main(void) {
  Suite *s = suite_create("choose");
  TCase *c = tcase_create("choose");
  tcase_add_test(c, distant_characters_are_coarse_and_invisible_ones_have_no_level);
  tcase_add_test(c, predicted_pixels_are_those_of_the_measured_error);
  tcase_add_test(c, the_host_can_override_the_choice);
  tcase_add_test(c, a_camera_that_trembles_changes_nothing);
  tcase_add_test(c, a_rotating_view_finds_fine_levels);
  tcase_add_test(c, a_budget_is_kept_and_spent_on_near_characters);
  tcase_add_test(c, threads_and_recordings_agree);
  tcase_add_test(c, wrong_definitions_and_failed_allocations_are_reported);
  suite_add_tcase(s, c);
  return harness_run(s);
}
