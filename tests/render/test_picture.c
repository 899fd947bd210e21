#define _POSIX_C_SOURCE 200809L

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness.h"
#include "left_behind.h"
#include "render/picture.h"
#include "sbfmt/codes.h"

enum { WIDTH = 37, HEIGHT = 19 };

static uint8_t rgb[WIDTH * HEIGHT * 3];

static void fill(void) {
  for (size_t i = 0; i < sizeof rgb; i++) rgb[i] = (uint8_t)(i * 7 + i / 11);
}

START_TEST(reads_back_the_same)
{
  const char *path = harness_scratch("picture.png");
  uint8_t read[sizeof rgb];
  sbf_diagnostic error = {0};
  png_image image = {.version = PNG_IMAGE_VERSION};
  fill();
  unlink(path);
  ck_assert_msg(draw_picture_write_png(path, rgb, WIDTH, HEIGHT, &error) == SBF_OK, "%s", error.message);
  ck_assert(png_image_begin_read_from_file(&image, path));
  ck_assert_uint_eq(image.width, WIDTH);
  ck_assert_uint_eq(image.height, HEIGHT);
  image.format = PNG_FORMAT_RGB;
  ck_assert(png_image_finish_read(&image, NULL, read, 0, NULL));
  ck_assert_mem_eq(rgb, read, sizeof rgb);
  ck_assert_int_eq(left_behind("picture.png"), 1);
}
END_TEST

START_TEST(replaces_an_older_file)
{
  const char *path = harness_scratch("older.png");
  size_t size;
  fill();
  ck_assert(harness_write(path, "old", 3));
  ck_assert_int_eq(draw_picture_write_png(path, rgb, WIDTH, HEIGHT, NULL), SBF_OK);
  char *bytes = harness_read(path, &size);
  ck_assert_uint_gt(size, 8);
  ck_assert_mem_eq(bytes, "\x89PNG\r\n\x1a\n", 8);
  free(bytes);
}
END_TEST

START_TEST(missing_folder)
{
  sbf_diagnostic error = {0};
  const char *path = harness_scratch("no/such/folder/picture.png");
  fill();
  ck_assert_int_eq(draw_picture_write_png(path, rgb, WIDTH, HEIGHT, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_WRITE);
  ck_assert_ptr_nonnull(strstr(error.file, "picture.png"));
}
END_TEST

START_TEST(path_is_a_folder)
{
  sbf_diagnostic error = {0};
  fill();
  ck_assert_int_eq(draw_picture_write_png(harness_scratch("."), rgb, WIDTH, HEIGHT, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_WRITE);
}
END_TEST

START_TEST(full_device)
{
  sbf_diagnostic error = {0};
  if (access("/dev/full", W_OK) != 0) {
    harness_skip("/dev/full cannot be written");
    return;
  }
  fill();
  ck_assert_int_eq(draw_picture_write_png("/dev/full", rgb, WIDTH, HEIGHT, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_WRITE);
  ck_assert_int_eq(access("/dev/full", F_OK), 0);
}
END_TEST

/* libpng's own line, before ours, says nothing that a user could act on. */
START_TEST(libpng_prints_nothing)
{
  enum { WIDE = 256, HIGH = 64 }; /* larger than a buffer of stdio */
  static uint8_t large[WIDE * HIGH * 3];
  const char *path = harness_scratch("said");
  sbf_diagnostic error = {0};
  size_t size;
  if (access("/dev/full", W_OK) != 0) {
    harness_skip("/dev/full cannot be written");
    return;
  }
  uint32_t noise = 1; /* does not compress */
  for (size_t i = 0; i < sizeof large; i++)
    large[i] = (uint8_t)((noise = noise * 1664525 + 1013904223) >> 24);
  fflush(stderr);
  int kept = dup(STDERR_FILENO);
  FILE *said = fopen(path, "wb");
  ck_assert(kept >= 0 && said && dup2(fileno(said), STDERR_FILENO) >= 0);
  sbf_status status = draw_picture_write_png("/dev/full", large, WIDE, HIGH, &error);
  fflush(stderr);
  ck_assert(dup2(kept, STDERR_FILENO) >= 0);
  close(kept);
  fclose(said);
  ck_assert_int_eq(status, SBF_FAILED);
  char *text = harness_read(path, &size);
  ck_assert_msg(size == 0, "%s", text);
  free(text);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("picture");
  TCase *tests = tcase_create("picture");
  tcase_add_test(tests, reads_back_the_same);
  tcase_add_test(tests, replaces_an_older_file);
  tcase_add_test(tests, missing_folder);
  tcase_add_test(tests, path_is_a_folder);
  tcase_add_test(tests, full_device);
  tcase_add_test(tests, libpng_prints_nothing);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
