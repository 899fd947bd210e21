#include "mechanics/level_points.h"

#include "harness.h"

static sbf_soft_body body;
static sbf_level level;
static const sbf_vec3 positions[5];
static const float factors[] = {0, 2, 4};
static sbf_weight_map maps[2];
static float values[5];

static void setup(void) {
  sbf_soft_body_init(&body);
  sbf_level_init(&level);
  level.positions = (sbf_vec3_list){positions, 5};
  for (int i = 0; i < 2; i++) {
    sbf_weight_map_init(&maps[i]);
    maps[i].values = (sbf_f32_list){factors, 3};
    maps[i].property = SBF_WEIGHT_PROPERTY_FRICTION;
  }
  body.weight_maps = (sbf_weight_map_list){maps, 2};
  for (int i = 0; i < 5; i++) values[i] = 1;
  values[3] = 0;
}

START_TEST(points_in_source_order)
{
  maps[1].property = SBF_WEIGHT_PROPERTY_DENSITY;
  sbfi_level_weigh(&body, &level, SBF_WEIGHT_PROPERTY_FRICTION, values);
  const float expected[] = {0, 2, 4, 0, 2}; /* the last two stand for no source point: the mean */
  ck_assert_mem_eq(values, expected, sizeof expected);
}
END_TEST

START_TEST(points_in_another_order)
{
  const uint32_t indices[] = {4, 1, 77};
  level.new_from_old = (sbf_u32_list){indices, 3};
  ck_assert_uint_eq(sbfi_level_point(&level, 0), 4);
  ck_assert_uint_eq(sbfi_level_point(&level, 2), UINT32_MAX);
  ck_assert_uint_eq(sbfi_level_point(&level, 3), UINT32_MAX);
  maps[1].property = SBF_WEIGHT_PROPERTY_DENSITY;
  sbfi_level_weigh(&body, &level, SBF_WEIGHT_PROPERTY_FRICTION, values);
  const float expected[] = {2, 2, 2, 0, 0};
  ck_assert_mem_eq(values, expected, sizeof expected);
}
END_TEST

START_TEST(maps_multiply)
{
  sbfi_level_weigh(&body, &level, SBF_WEIGHT_PROPERTY_FRICTION, values);
  const float expected[] = {0, 4, 16, 0, 4};
  ck_assert_mem_eq(values, expected, sizeof expected);
  sbfi_level_weigh(&body, &level, SBF_WEIGHT_PROPERTY_PRESSURE, values);
  ck_assert_mem_eq(values, expected, sizeof expected);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("level_points");
  TCase *c = tcase_create("level_points");
  tcase_add_checked_fixture(c, setup, NULL);
  tcase_add_test(c, points_in_source_order);
  tcase_add_test(c, points_in_another_order);
  tcase_add_test(c, maps_multiply);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
