#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "render/palette.h"

/* Rec. 709 luma of the linear values: about how light a colour looks. */
static float lightness(draw_colour c) {
  return 0.2126f * powf((float)c.r / 255, 2.2f) + 0.7152f * powf((float)c.g / 255, 2.2f) +
         0.0722f * powf((float)c.b / 255, 2.2f);
}

START_TEST(sequential_grows_lighter)
{
  draw_colour_map map;
  draw_colour_map_init_sequential(&map);
  for (int i = 8; i < DRAW_COLOUR_MAP_SIZE; i++)
    ck_assert_float_gt(lightness(map.at[i]), lightness(map.at[i - 8]));
}
END_TEST

START_TEST(diverging_is_even_about_rest)
{
  draw_colour_map map;
  draw_colour_map_init_diverging(&map);
  draw_colour min = draw_colour_map_at_strain(&map, -0.1f, 0.1f);
  draw_colour rest = draw_colour_map_at_strain(&map, 0, 0.1f);
  draw_colour max = draw_colour_map_at_strain(&map, 0.1f, 0.1f);
  ck_assert_int_gt(min.b, min.r + 80);
  ck_assert_int_gt(max.r, max.b + 80);
  ck_assert_int_lt(abs(rest.r - rest.b), 20);
  ck_assert_float_gt(lightness(rest), 2 * lightness(min));
  ck_assert_float_eq_tol(lightness(min), lightness(max), 0.06f);
}
END_TEST

START_TEST(out_of_range_is_clamped)
{
  draw_colour_map map;
  draw_colour_map_init_sequential(&map);
  ck_assert_mem_eq(&map.at[0], (&(draw_colour[1]){draw_colour_map_at(&map, -5)}), sizeof(draw_colour));
  ck_assert_mem_eq(&map.at[DRAW_COLOUR_MAP_SIZE - 1], (&(draw_colour[1]){draw_colour_map_at(&map, INFINITY)}),
      sizeof(draw_colour));
  draw_colour broken = draw_colour_map_at(&map, NAN);
  ck_assert(broken.r == 255 && broken.g == 0 && broken.b == 255);
}
END_TEST

START_TEST(kinds_have_different_colors)
{
  for (int a = 0; a < DRAW_SPRING_STYLE_COUNT; a++)
    for (int b = 0; b < a; b++) {
      draw_colour x = draw_spring_style_of((draw_spring_style_kind)a)->colour;
      draw_colour y = draw_spring_style_of((draw_spring_style_kind)b)->colour;
      ck_assert_int_gt(abs(x.r - y.r) + abs(x.g - y.g) + abs(x.b - y.b), 100);
    }
  ck_assert_ptr_nonnull(draw_spring_style_of((draw_spring_style_kind)99));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("palette");
  TCase *tests = tcase_create("palette");
  tcase_add_test(tests, sequential_grows_lighter);
  tcase_add_test(tests, diverging_is_even_about_rest);
  tcase_add_test(tests, out_of_range_is_clamped);
  tcase_add_test(tests, kinds_have_different_colors);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
