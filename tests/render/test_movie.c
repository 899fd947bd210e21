#define _POSIX_C_SOURCE 200809L

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/child_pipe.h"
#include "harness.h"
#include "left_behind.h"
#include "random.h"
#include "render/movie.h"
#include "sbfmt/codes.h"

enum { WIDTH = 33, HEIGHT = 21 };

static uint8_t rgb[WIDTH * HEIGHT * 3];
static const draw_movie_options gif = {.kind = DRAW_MOVIE_GIF, .width = WIDTH, .height = HEIGHT, .fps = 25};

#define have_ffmpeg() have_ffmpeg_for(__func__)
static bool have_ffmpeg_for(const char *function) {
  const char *const arguments[] = {"ffmpeg", "-version", NULL};
  char said[8];
  child_pipe child;
  if (child_pipe_start(&child, arguments, false) != 0) {
    harness_skip_case(function, "ffmpeg is not in PATH");
    return false;
  }
  return child_pipe_finish(&child, said, sizeof said);
}

static void draw_frame(uint32_t frame) {
  for (uint32_t i = 0; i < sizeof rgb; i++) rgb[i] = (uint8_t)(i / 3 % WIDTH * 7 + frame * 20);
}

START_TEST(film_is_whole)
{
  static const struct {
    const char *name, *magic;
    size_t magic_at;
    draw_movie_kind kind;
    uint32_t expected;
  } films[] = {{"film.gif", "GIF89a", 0, DRAW_MOVIE_GIF, 6}, {"stream.gif", "GIF89a", 0, DRAW_MOVIE_GIF, 0},
      {"film.mp4", "ftyp", 4, DRAW_MOVIE_MP4, 6}, {"film.webp", "WEBPVP8X", 8, DRAW_MOVIE_WEBP, 6}};
  draw_movie *movie;
  sbf_diagnostic error = {0};
  size_t size;
  if (!have_ffmpeg()) return;
  draw_movie_options options = gif;
  options.kind = films[_i].kind;
  options.frame_count = films[_i].expected;
  const char *path = harness_scratch(films[_i].name);
  unlink(path);
  ck_assert_msg(draw_movie_open(&movie, path, &options, &error) == SBF_OK, "%s", error.message);
  for (uint32_t frame = 0; frame < 6; frame++) {
    draw_frame(frame);
    ck_assert_msg(draw_movie_add_frame(movie, rgb, &error) == SBF_OK, "%s", error.message);
  }
  ck_assert_int_ne(access(path, F_OK), 0); /* not before it is finished */
  ck_assert_msg(draw_movie_finish(movie, &error) == SBF_OK, "%s", error.message);
  char *bytes = harness_read(path, &size);
  ck_assert_ptr_nonnull(bytes);
  ck_assert_uint_gt(size, 100);
  ck_assert_mem_eq(bytes + films[_i].magic_at, films[_i].magic, strlen(films[_i].magic));
  free(bytes);
  ck_assert_int_eq(left_behind(films[_i].name), 1);
}
END_TEST

START_TEST(no_ffmpeg)
{
  draw_movie *movie;
  sbf_diagnostic error = {0};
  draw_movie_options options = gif;
  if (_i)
    options.ffmpeg = "no-such-program-of-films";
  else
    setenv("PATH", "/nonexistent", 1);
  ck_assert_int_eq(draw_movie_open(&movie, harness_scratch("none.gif"), &options, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_NO_FFMPEG);
  ck_assert_ptr_nonnull(strstr(error.message, "install"));
  ck_assert_ptr_null(movie);
  ck_assert_int_eq(left_behind("none.gif"), 0);
}
END_TEST

/* `cat` takes our arguments for options it does not have; `false` ends without a word. Both leave no film. */
START_TEST(ffmpeg_fails)
{
  static const char *const programs[] = {"cat", "false"};
  draw_movie *movie;
  sbf_diagnostic error = {0};
  draw_movie_options options = gif;
  options.ffmpeg = programs[_i];
  const char *path = harness_scratch("fails.gif");
  ck_assert(harness_write(path, "old", 3));
  ck_assert_msg(draw_movie_open(&movie, path, &options, &error) == SBF_OK, "%s", error.message);
  sbf_status status = SBF_OK;
  for (int frame = 0; frame < 1000 && status == SBF_OK; frame++)
    status = draw_movie_add_frame(movie, rgb, &error);
  if (status == SBF_OK)
    status = draw_movie_finish(movie, &error);
  else
    draw_movie_abandon(movie);
  ck_assert_int_eq(status, SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_FFMPEG_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, _i ? "no reason" : "option"));
  ck_assert_int_eq(left_behind("fails.gif"), 1); /* the old one */
  unlink(path);
}
END_TEST

/* Noise: its film needs more space than the disk has. ffmpeg then exits with 0 for some formats. */
START_TEST(disk_is_full)
{
  static const char *const names[] = {"full.gif", "full.mp4", "full.webp"};
  static const rlim_t room[] = {0, 4096};
  static uint8_t noise[64 * 64 * 3];
  draw_movie *movie;
  sbf_diagnostic error = {0};
  uint32_t state = 1;
  if (!have_ffmpeg()) return;
  draw_movie_options options = {
      .kind = (draw_movie_kind)(_i % 3), .width = 64, .height = 64, .fps = 20, .frame_count = 4};
  const char *path = harness_scratch(names[_i % 3]);
  ck_assert(harness_write(path, "old", 3));
  signal(SIGXFSZ, SIG_IGN); /* which ffmpeg inherits: its writes fail as on a full disk */
  struct rlimit limit;
  ck_assert_int_eq(getrlimit(RLIMIT_FSIZE, &limit), 0);
  limit.rlim_cur = room[_i / 3];
  ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &limit), 0);
  sbf_status status = draw_movie_open(&movie, path, &options, &error);
  for (int frame = 0; frame < 4 && status == SBF_OK; frame++) {
    for (size_t i = 0; i < sizeof noise; i++) noise[i] = (uint8_t)(random_next(&state) >> 16);
    status = draw_movie_add_frame(movie, noise, &error);
  }
  status = status == SBF_OK ? draw_movie_finish(movie, &error) : (draw_movie_abandon(movie), status);
  limit.rlim_cur = limit.rlim_max;
  ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &limit), 0);
  ck_assert_int_eq(status, SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_FFMPEG_FAILED);
  size_t size;
  char *bytes = harness_read(path, &size);
  ck_assert_uint_eq(size, 3);
  ck_assert_mem_eq(bytes, "old", 3);
  free(bytes);
  ck_assert_int_eq(left_behind(names[_i % 3]), 1);
  unlink(path);
}
END_TEST

START_TEST(abandoned)
{
  draw_movie *movie;
  if (!have_ffmpeg()) return;
  ck_assert_int_eq(draw_movie_open(&movie, harness_scratch("abandoned.gif"), &gif, NULL), SBF_OK);
  ck_assert_int_eq(draw_movie_add_frame(movie, rgb, NULL), SBF_OK);
  draw_movie_abandon(movie);
  ck_assert_int_eq(left_behind("abandoned.gif"), 0);
  draw_movie_abandon(NULL);
}
END_TEST

START_TEST(interrupted)
{
  static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
  int ready[2], status;
  char byte;
  if (!have_ffmpeg()) return;
  ck_assert_int_eq(pipe(ready), 0);
  pid_t child = fork();
  if (child == 0) {
    draw_movie *movie;
    for (int i = 0; i < 3; i++) signal(signals[i], SIG_DFL); /* Check has handlers of its own */
    bool good = draw_movie_open(&movie, harness_scratch("interrupted.gif"), &gif, NULL) == SBF_OK;
    if (write(ready[1], good ? "y" : "n", 1) == 1) pause();
    _exit(99);
  }
  ck_assert_int_eq(read(ready[0], &byte, 1), 1);
  ck_assert_int_eq(byte, 'y');
  ck_assert_int_eq(left_behind("interrupted.gif"), 1);
  kill(child, signals[_i]);
  ck_assert_int_eq(waitpid(child, &status, 0), child);
  ck_assert(WIFSIGNALED(status) && WTERMSIG(status) == signals[_i]);
  ck_assert_int_eq(left_behind("interrupted.gif"), 0);
}
END_TEST

START_TEST(wrong_calls)
{
  static const struct {
    draw_movie_kind kind;
    uint32_t width, height, fps;
  } calls[] = {{DRAW_MOVIE_GIF, 8, 8, 0}, {DRAW_MOVIE_GIF, 8, 8, DRAW_MOVIE_LOOP_FPS_MAX + 1},
      {DRAW_MOVIE_MP4, 8, 8, 241}, {DRAW_MOVIE_WEBP, 8, 8, DRAW_MOVIE_LOOP_FPS_MAX + 1},
      {DRAW_MOVIE_GIF, 0, 8, 25}, {DRAW_MOVIE_MP4, 1, 8, 25}};
  draw_movie *movie;
  sbf_diagnostic error = {0};
  draw_movie_options options = {
      .kind = calls[_i].kind, .width = calls[_i].width, .height = calls[_i].height, .fps = calls[_i].fps};
  ck_assert_int_eq(draw_movie_open(&movie, harness_scratch("wrong"), &options, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_BAD_CALL);
  ck_assert_int_eq(left_behind("wrong"), 0);
}
END_TEST

START_TEST(film_without_a_frame)
{
  draw_movie *movie;
  sbf_diagnostic error = {0};
  if (!have_ffmpeg()) return;
  ck_assert_int_eq(draw_movie_open(&movie, harness_scratch("empty.gif"), &gif, &error), SBF_OK);
  ck_assert_int_eq(draw_movie_finish(movie, &error), SBF_FAILED);
  ck_assert_int_eq(left_behind("empty.gif"), 0);
}
END_TEST

START_TEST(unwritable_path)
{
  draw_movie *movie;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(draw_movie_open(&movie, harness_scratch("no/such/film.gif"), &gif, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_WRITE);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("movie");
  TCase *tests = tcase_create("movie");
  tcase_add_loop_test(tests, film_is_whole, 0, 4);
  tcase_add_loop_test(tests, no_ffmpeg, 0, 2);
  tcase_add_loop_test(tests, ffmpeg_fails, 0, 2);
  tcase_add_loop_test(tests, disk_is_full, 0, 6);
  tcase_add_test(tests, abandoned);
  tcase_add_loop_test(tests, interrupted, 0, 3);
  tcase_add_loop_test(tests, wrong_calls, 0, 6);
  tcase_add_test(tests, film_without_a_frame);
  tcase_add_test(tests, unwritable_path);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
