#include <stdlib.h>

#include "harness.h"
#include "opengl_probe.h"
#include "render/canvas.h"
#include "render/gl_api.h"
#include "sbfmt/codes.h"

static draw_canvas *opened(uint32_t width, uint32_t height, draw_canvas_quality quality) {
  draw_canvas *canvas;
  sbf_diagnostic error = {0};
  ck_assert_msg(draw_canvas_open(&canvas, width, height, quality, &error) == SBF_OK, "%s", error.message);
  ck_assert_uint_eq(draw_canvas_width(canvas), width);
  ck_assert_uint_eq(draw_canvas_height(canvas), height);
  return canvas;
}

static void check_colour(const uint8_t *rgb, int r, int g, int b) {
  ck_assert_msg(abs(rgb[0] - r) <= 1 && abs(rgb[1] - g) <= 1 && abs(rgb[2] - b) <= 1,
      "%d %d %d, not %d %d %d", rgb[0], rgb[1], rgb[2], r, g, b);
}

START_TEST(reads_the_drawn_pixels)
{
  uint8_t rgb[5 * 3 * 3];
  sbf_diagnostic error = {0};
  draw_canvas *canvas = opened(5, 3, _i ? DRAW_CANVAS_STILL : DRAW_CANVAS_MOVIE);
  const gl_api *gl = draw_canvas_gl(canvas);
  draw_canvas_bind(canvas);
  gl->ClearColor(1, 0.5f, 0, 1);
  gl->Clear(GL_COLOR_BUFFER_BIT);
  ck_assert_int_eq(draw_canvas_read(canvas, rgb, &error), SBF_OK);
  for (int i = 0; i < 15; i++) check_colour(rgb + 3 * i, 255, 128, 0);
  draw_canvas_close(canvas);
}
END_TEST

START_TEST(second_canvas_after_the_first)
{
  uint8_t rgb[3];
  for (int i = 0; i < 2; i++) {
    draw_canvas *canvas = opened(1, 1, DRAW_CANVAS_MOVIE);
    ck_assert_ptr_nonnull(draw_canvas_renderer(canvas));
    draw_canvas_bind(canvas);
    ck_assert_int_eq(draw_canvas_read(canvas, rgb, NULL), SBF_OK);
    draw_canvas_close(canvas);
  }
}
END_TEST

START_TEST(another_size)
{
  uint8_t rgb[40 * 30 * 3];
  sbf_diagnostic error = {0};
  draw_canvas *canvas = opened(5, 3, _i ? DRAW_CANVAS_STILL : DRAW_CANVAS_MOVIE);
  const gl_api *gl = draw_canvas_gl(canvas);
  ck_assert_int_eq(draw_canvas_resize(canvas, 40, 30, &error), SBF_OK);
  ck_assert_uint_eq(draw_canvas_width(canvas), 40);
  draw_canvas_bind(canvas);
  gl->ClearColor(0, 0.5f, 1, 1);
  gl->Clear(GL_COLOR_BUFFER_BIT);
  ck_assert_int_eq(draw_canvas_read(canvas, rgb, &error), SBF_OK);
  for (int i = 0; i < 40 * 30; i++) check_colour(rgb + 3 * i, 0, 128, 255);
  draw_canvas_close(canvas);
}
END_TEST

START_TEST(largest_picture)
{
  draw_canvas *canvas = opened(DRAW_CANVAS_LARGEST, 16, DRAW_CANVAS_STILL);
  ck_assert_uint_eq(draw_canvas_bind(canvas), 1);
  draw_canvas_close(canvas);
}
END_TEST

START_TEST(sizes_out_of_range)
{
  static const uint32_t sizes[][2] = {
      {0, 10}, {10, 0}, {DRAW_CANVAS_LARGEST + 1, 10}, {10, DRAW_CANVAS_LARGEST + 1}};
  draw_canvas *canvas;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(
      draw_canvas_open(&canvas, sizes[_i][0], sizes[_i][1], DRAW_CANVAS_MOVIE, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_BAD_CALL);
  ck_assert_ptr_null(canvas);
}
END_TEST

START_TEST(closing_nothing)
{ draw_canvas_close(NULL); }
END_TEST

int main(void) {
  opengl_probe();
  Suite *suite = suite_create("canvas");
  TCase *tests = tcase_create("canvas");
  tcase_add_checked_fixture(tests, opengl_needed, NULL);
  tcase_add_loop_test(tests, reads_the_drawn_pixels, 0, 2);
  tcase_add_test(tests, second_canvas_after_the_first);
  tcase_add_loop_test(tests, another_size, 0, 2);
  tcase_add_test(tests, largest_picture);
  tcase_add_loop_test(tests, sizes_out_of_range, 0, 4);
  tcase_add_test(tests, closing_nothing);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
