#include <math.h>
#include <string.h>

#include "detail_scenes.h"
#include "harness.h"

START_TEST(detail_levels_include_jiggle_bones_and_none)
{
  scene s = detail_scene_begin(false);
  scene_start(&s);
  sbr_detail_level detail_levels[8];
  ck_assert_uint_eq(sbr_model_get_detail_levels(s.model, detail_levels, 8), LEVELS_OF_DETAIL);
  const sbr_detail_level_kind kinds[LEVELS_OF_DETAIL] = {
      SBR_DETAIL_SOFT, SBR_DETAIL_SOFT, SBR_DETAIL_JIGGLE, SBR_DETAIL_BONES, SBR_DETAIL_OFFSCREEN};
  for (uint32_t r = 0; r < LEVELS_OF_DETAIL; r++) {
    ck_assert_int_eq(detail_levels[r].kind, kinds[r]);
    if (r == 0) continue;
    ck_assert(detail_levels[r].visits < detail_levels[r - 1].visits);
    ck_assert(detail_levels[r].error_m >= detail_levels[r - 1].error_m);
  }
  ck_assert(detail_levels[0].error_m == 0);
  ck_assert(detail_levels[1].error_m == 0.01f);
  ck_assert(detail_levels[2].error_m == 0.02f);
  scene_free(&s);
}
END_TEST

START_TEST(a_rigid_body_or_missing_levels_give_one_detail_level)
{
  for (int i = 0; i < 2; i++) {
    scene s = detail_scene_begin(false);
    if (i == 0)
      s.model_options.detail_levels = false;
    else
      scene_body(&s, 0)->attributes.yield_strain = 0.2f, scene_body(&s, 0)->attributes.yield_flow = 1;
    scene_start(&s);
    ck_assert_uint_eq(sbr_model_get_detail_levels(s.model, NULL, 0), 1);
    sbr_character_set_detail_level(s.world, s.character, 3);
    scene_ticks(&s, 3);
    ck_assert_uint_eq(sbr_character_get_detail_level(s.world, s.character), 0);
    scene_free(&s);
  }
  ck_assert_uint_eq(sbr_model_get_detail_levels(NULL, NULL, 0), 0);
}
END_TEST

START_TEST(unpinned_bodies_have_soft_detail_levels_only)
{
  scene s = detail_scene_begin(true);
  scene_start(&s);
  sbr_detail_level detail_levels[8];
  ck_assert_uint_eq(sbr_model_get_detail_levels(s.model, detail_levels, 8), 2);
  ck_assert_int_eq(detail_levels[1].kind, SBR_DETAIL_SOFT);
  scene_free(&s);
}
END_TEST

START_TEST(a_level_with_a_large_error_is_no_detail_level)
{
  scene s = detail_scene_begin(false);
  ((sbf_level *)(uintptr_t)scene_body(&s, 0)->levels.at)[1].simulation.error = 0.2f;
  scene_start(&s);
  sbr_detail_level detail_levels[8];
  ck_assert_uint_eq(sbr_model_get_detail_levels(s.model, detail_levels, 8), LEVELS_OF_DETAIL - 1);
  ck_assert_int_eq(detail_levels[1].kind, SBR_DETAIL_JIGGLE);
  scene_free(&s);
}
END_TEST

/* What a level states about motion ranks before what it states about rest, even if the latter is wrong. A
 * scheme that visits elements more often costs proportionally more. */
START_TEST(detail_levels_use_errors_measured_in_motion)
{
  float visits = 0;
  for (int i = 0; i < 2; i++) {
    scene s = detail_scene_begin(false);
    sbf_level *levels = (sbf_level *)(uintptr_t)scene_body(&s, 0)->levels.at;
    levels[0].simulation.motion_error = 0.001f;
    levels[1].simulation.error = 0.2f;
    levels[1].simulation.motion_error = 0.004f;
    levels[1].simulation.substeps = 3;
    levels[1].simulation.scheme = i ? SBF_SCHEME_BLOCK_DESCENT : SBF_SCHEME_POSITION_BASED;
    scene_start(&s);
    sbr_detail_level detail_levels[8];
    ck_assert_uint_eq(sbr_model_get_detail_levels(s.model, detail_levels, 8), LEVELS_OF_DETAIL);
    ck_assert(detail_levels[0].error_m == 0.001f);
    ck_assert_int_eq(detail_levels[1].kind, SBR_DETAIL_SOFT);
    ck_assert(detail_levels[1].error_m == 0.004f);
    ck_assert(detail_levels[2].error_m == 0.02f);
    uint32_t solids = levels[1].lattice.tetrahedra.count;
    if (i) ck_assert(fabsf(detail_levels[1].visits - visits - 3 * 15 * (float)solids) < 1);
    visits = detail_levels[1].visits;
    scene_free(&s);
  }
}
END_TEST

START_TEST(levels_that_were_not_loaded_are_skipped)
{
  scene s = detail_scene_begin(false);
  sbf_level *levels = (sbf_level *)(uintptr_t)scene_body(&s, 0)->levels.at;
  sbf_level_init(&levels[0]);
  s.model_options.detail_levels = false;
  scene_start(&s);
  scene_ticks(&s, 30);
  ck_assert_uint_eq(sbr_character_get_points(s.world, s.character, 0, NULL, 0), levels[1].positions.count);
  ck_assert(detail_scene_elastic(&s) > 0);
  scene_free(&s);
}
END_TEST

START_TEST(creation_survives_failed_allocations)
{
  scene s = detail_scene_begin(false);
  scene_models_survive_want(&s);
  sbf_asset_free(s.asset);
}
END_TEST

int main(void) {
  Suite *s = suite_create("detail levels");
  TCase *c = tcase_create("detail levels");
  tcase_add_test(c, detail_levels_include_jiggle_bones_and_none);
  tcase_add_test(c, a_rigid_body_or_missing_levels_give_one_detail_level);
  tcase_add_test(c, unpinned_bodies_have_soft_detail_levels_only);
  tcase_add_test(c, a_level_with_a_large_error_is_no_detail_level);
  tcase_add_test(c, detail_levels_use_errors_measured_in_motion);
  tcase_add_test(c, levels_that_were_not_loaded_are_skipped);
  tcase_add_test(c, creation_survives_failed_allocations);
  suite_add_tcase(s, c);
  return harness_run(s);
}
