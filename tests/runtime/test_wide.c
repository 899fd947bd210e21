#include "harness.h"
#include "random.h"
#include "wide_twin.h"

static float next(uint32_t *state) {
  return (float)(int32_t)random_next(state) * (1.0f / 2147483648.0f);
}

START_TEST(one_lane_and_all_lanes_give_the_same_bits)
{
  sbri_point points[TWIN_POINTS], wide[2 * TWIN_POINTS], scalar[2 * TWIN_POINTS];
  uint32_t indices[TWIN_POINTS], state = 7;
  for (int round = 0; round < 200; round++) {
    for (uint32_t i = 0; i < TWIN_POINTS; i++) {
      points[i] = (sbri_point){next(&state), next(&state), next(&state), 9};
      indices[i] = (uint32_t)((next(&state) + 1) * 0.5f * (TWIN_POINTS - 1));
    }
    twin_kernel(points, indices, wide);
    twin_scalar(points, indices, scalar);
    ck_assert_mem_eq(wide, scalar, sizeof wide);
    ck_assert_float_eq(wide[3].w, 0);
    ck_assert_float_eq(wide[TWIN_POINTS + 3].w, 9);
    ck_assert_float_eq(wide[TWIN_POINTS + 3].x, points[indices[3]].x);
  }
}
END_TEST

START_TEST(maximum_and_minimum_prefer_the_second_where_one_is_not_a_number)
{
  float numbers[SBRI_BLOCK], result[SBRI_BLOCK];
  for (int i = 0; i < SBRI_BLOCK; i++) numbers[i] = i % 2 ? NAN : (float)i;
  for (int lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES)
    sbri_wide_store(result + lane, sbri_wide_max(sbri_wide_load(numbers + lane), sbri_wide_all(3)));
  for (int i = 0; i < SBRI_BLOCK; i++) ck_assert_float_eq(result[i], i % 2 || i < 3 ? 3.0f : (float)i);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("wide");
  TCase *c = tcase_create("wide");
  tcase_add_test(c, one_lane_and_all_lanes_give_the_same_bits);
  tcase_add_test(c, maximum_and_minimum_prefer_the_second_where_one_is_not_a_number);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
