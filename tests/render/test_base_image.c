/* Images decoded: whole ones to their pixels, others with a reason. */
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "render/base_image.h"
#include "render/picture.h"

enum { WIDTH = 5, HEIGHT = 3 };

static uint8_t rgb[WIDTH * HEIGHT * 3], *png;
static size_t size;
static char why[DRAW_IMAGE_WHY];

static void set_up(void) {
  for (size_t i = 0; i < sizeof rgb; i++) rgb[i] = (uint8_t)(i * 5);
  ck_assert_int_eq(draw_picture_encode_png(rgb, WIDTH, HEIGHT, &png, &size, NULL), SBF_OK);
}
static void tear_down(void) {
  free(png);
}

START_TEST(pixels_are_those_written)
{
  draw_image *image = draw_image_decode(png, size, why);
  ck_assert_msg(image, "%s", why);
  ck_assert_uint_eq(image->width, WIDTH);
  ck_assert_uint_eq(image->height, HEIGHT);
  for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
    ck_assert_mem_eq(image->rgba + 4 * i, rgb + 3 * i, 3);
    ck_assert_uint_eq(image->rgba[4 * i + 3], 255);
  }
  draw_image_destroy(image);
}
END_TEST

/* No matter where it ends: before the last chunk all is refused. */
START_TEST(cut_short_is_damaged)
{
  for (size_t kept = 8; kept < size - 12; kept++) {
    uint8_t *part = malloc(kept); /* for a reader that goes beyond to be seen */
    ck_assert_ptr_nonnull(part);
    memcpy(part, png, kept);
    ck_assert_msg(!draw_image_decode(part, kept, why), "%zu bytes of %zu", kept, size);
    ck_assert_msg(strstr(why, "damaged"), "%s", why);
    free(part);
  }
}
END_TEST

START_TEST(changed_byte_is_damaged)
{
  png[size - 20] ^= 0x10; /* among the pixels, which have a checksum */
  ck_assert_ptr_null(draw_image_decode(png, size, why));
  ck_assert_msg(strstr(why, "damaged"), "%s", why);
}
END_TEST

START_TEST(other_files_are_named)
{
  static const uint8_t jpeg[] = {0xff, 0xd8, 0xff, 0xe0, 0, 16, 'J', 'F', 'I', 'F'}, none[] = "GIF89a....";
  ck_assert_ptr_null(draw_image_decode(jpeg, sizeof jpeg, why));
  ck_assert_msg(strstr(why, "JPEG"), "%s", why);
  ck_assert_ptr_null(draw_image_decode(none, sizeof none, why));
  ck_assert_msg(strstr(why, "no PNG"), "%s", why);
  ck_assert_ptr_null(draw_image_decode(NULL, 0, why));
  ck_assert_msg(strstr(why, "no PNG"), "%s", why);
}
END_TEST

START_TEST(too_large_is_refused)
{
  enum { LONG = DRAW_IMAGE_LARGEST + 1 };
  uint8_t *row = calloc(LONG, 3), *wide;
  ck_assert_ptr_nonnull(row);
  ck_assert_int_eq(draw_picture_encode_png(row, _i ? LONG : 1, _i ? 1 : LONG, &wide, &size, NULL), SBF_OK);
  ck_assert_ptr_null(draw_image_decode(wide, size, why));
  ck_assert_msg(strstr(why, "8192"), "%s", why);
  free(wide);
  free(row);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("base_image");
  TCase *tests = tcase_create("base_image");
  tcase_add_checked_fixture(tests, set_up, tear_down);
  tcase_add_test(tests, pixels_are_those_written);
  tcase_add_test(tests, cut_short_is_damaged);
  tcase_add_test(tests, changed_byte_is_damaged);
  tcase_add_test(tests, other_files_are_named);
  tcase_add_loop_test(tests, too_large_is_refused, 0, 2);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
