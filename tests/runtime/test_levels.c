#include "harness.h"
#include "prepare/prepare.h"
#include "sbfmt/asset.h"

static const sbf_vec3 positions[2];

static sbf_level of_model(sbf_elastic_model model) {
  sbf_level level;
  sbf_level_init(&level);
  level.model = model;
  level.positions.at = positions;
  level.positions.count = 2;
  return level;
}

START_TEST(springs_and_solids_are_stepped_once_they_are_loaded)
{
  sbf_level level = of_model(SBF_ELASTIC_MODEL_TETRAHEDRA);
  ck_assert(sbri_level_has_stepped_model(&level) && sbri_level_is_stepped(&level));
  level.positions.count = 0;
  ck_assert(sbri_level_has_stepped_model(&level) && !sbri_level_is_stepped(&level));
  level = of_model(SBF_ELASTIC_MODEL_JIGGLE);
  ck_assert(!sbri_level_has_stepped_model(&level) && !sbri_level_is_stepped(&level));
}
END_TEST

START_TEST(a_level_fails_above_an_error_of_a_quarter_of_its_body)
{
  sbf_level level = of_model(SBF_ELASTIC_MODEL_SPRINGS);
  ck_assert(!sbri_level_has_failed(&level, 2)); /* it states nothing */
  level.simulation.error = 0.5f;
  ck_assert(!sbri_level_has_failed(&level, 2) && sbri_level_is_useful(&level, 2));
  level.simulation.error = 0.51f;
  ck_assert(sbri_level_has_failed(&level, 2) && !sbri_level_is_useful(&level, 2));
  level.simulation.motion_error = 0.9f; /* its motion was measured so: the value stays */
  ck_assert(!sbri_level_has_failed(&level, 2) && sbri_level_is_useful(&level, 2));
}
END_TEST

START_TEST(levels_that_cannot_be_stepped_are_no_detail_levels)
{
  sbf_level level = of_model(SBF_ELASTIC_MODEL_SPRINGS);
  level.simulation.error = 0.01f;
  ck_assert(sbri_level_is_useful(&level, 1));
  level.positions.count = 0;
  ck_assert(!sbri_level_has_failed(&level, 1) && !sbri_level_is_useful(&level, 1));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("levels");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, springs_and_solids_are_stepped_once_they_are_loaded);
  tcase_add_test(tests, a_level_fails_above_an_error_of_a_quarter_of_its_body);
  tcase_add_test(tests, levels_that_cannot_be_stepped_are_no_detail_levels);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
