/* Images decoded: whole ones to their pixels, others with a reason. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "render/base_image.h"
#include "render/picture.h"

/* What this build draws beside PNG: as tools/render/CMakeLists.txt found it. */
#ifdef SBFMT_JPEG
enum { JPEG_DRAWN = 1 };
#else
enum { JPEG_DRAWN = 0 };
#endif
#ifdef SBFMT_WEBP
enum { WEBP_DRAWN = 1 };
#else
enum { WEBP_DRAWN = 0 };
#endif

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
  static const uint8_t none[] = "GIF89a....";
  ck_assert_ptr_null(draw_image_decode(none, sizeof none, why));
  ck_assert_msg(strstr(why, "neither PNG nor JPEG nor WebP"), "%s", why);
  ck_assert_ptr_null(draw_image_decode(NULL, 0, why));
  ck_assert_msg(strstr(why, "neither PNG nor JPEG nor WebP"), "%s", why);
}
END_TEST

/* --- JPEG and WebP: red and green over blue and yellow, each a quarter of 32 by 32 pixels ----------------
 */

static const struct {
  const char *file, *form;
  int is_drawn, red_alpha;
} quarters[] = {{"quarters.jpg", "JPEG", JPEG_DRAWN, 255},
    {"quarters_progressive.jpg", "JPEG", JPEG_DRAWN, 255}, {"quarters_inks.jpg", "JPEG", JPEG_DRAWN, 255},
    {"quarters.webp", "WebP", WEBP_DRAWN, 255}, {"quarters_alpha.webp", "WebP", WEBP_DRAWN, 64}};
enum { QUARTERS = sizeof quarters / sizeof *quarters, MAX_BYTES = 4096 };

static uint8_t *read_image(const char *name, size_t *count) {
  char path[256];
  snprintf(path, sizeof path, "tests/render/images/%s", name);
  FILE *file = fopen(harness_source(path), "rb");
  uint8_t *bytes = malloc(MAX_BYTES);
  ck_assert_msg(file && bytes, "%s", path);
  *count = fread(bytes, 1, MAX_BYTES, file);
  fclose(file);
  return bytes;
}

START_TEST(jpeg_and_webp_show_their_colours)
{
  static const int expected[4][3] = {{224, 0, 0}, {0, 224, 0}, {0, 0, 224}, {224, 224, 0}};
  size_t count;
  uint8_t *bytes = read_image(quarters[_i].file, &count);
  draw_image *image = draw_image_decode(bytes, count, why);
  if (quarters[_i].is_drawn) {
    ck_assert_msg(image, "%s: %s", quarters[_i].file, why);
    ck_assert_uint_eq(image->width, 32);
    ck_assert_uint_eq(image->height, 32);
    for (size_t q = 0; q < 4; q++) {
      const uint8_t *pixel = image->rgba + 4 * (32 * (q < 2 ? 7 : 24) + (q % 2 ? 24 : 7));
      for (int k = 0; k < 3; k++) ck_assert_int_le(abs(pixel[k] - expected[q][k]), 6);
      ck_assert_int_eq(pixel[3], q == 0 ? quarters[_i].red_alpha : 255);
    }
  } else {
    ck_assert_ptr_null(image);
    ck_assert_ptr_nonnull(strstr(why, quarters[_i].form));
    ck_assert_ptr_nonnull(strstr(why, "built without"));
  }
  draw_image_destroy(image);
  free(bytes);
}
END_TEST

/* Wherever it ends before the last of its data. */
START_TEST(jpeg_and_webp_cut_short_are_damaged)
{
  size_t count;
  uint8_t *bytes = read_image(quarters[_i].file, &count);
  if (!quarters[_i].is_drawn) harness_skip("this build draws PNG alone");
  for (size_t kept = 12; quarters[_i].is_drawn && kept < count - 24; kept++) {
    uint8_t *part = malloc(kept);
    ck_assert_ptr_nonnull(part);
    memcpy(part, bytes, kept);
    ck_assert_msg(!draw_image_decode(part, kept, why), "%zu bytes of %zu", kept, count);
    ck_assert_msg(strstr(why, "damaged"), "%s", why);
    free(part);
  }
  free(bytes);
}
END_TEST

START_TEST(moving_webp_is_named)
{
  size_t count;
  uint8_t *bytes = read_image("quarters_moving.webp", &count);
  ck_assert_ptr_null(draw_image_decode(bytes, count, why));
  ck_assert_ptr_nonnull(strstr(why, WEBP_DRAWN ? "animation" : "built without"));
  free(bytes);
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
  tcase_add_loop_test(tests, jpeg_and_webp_show_their_colours, 0, QUARTERS);
  tcase_add_loop_test(tests, jpeg_and_webp_cut_short_are_damaged, 0, QUARTERS);
  tcase_add_test(tests, moving_webp_is_named);
  tcase_add_loop_test(tests, too_large_is_refused, 0, 2);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
