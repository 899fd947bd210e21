#include "render/movie.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/child_pipe.h"
#include "base/fault.h"
#include "base/output_file.h"
#include "render/movie_check.h"

struct draw_movie {
  child_pipe child;
  output_file output;
  draw_movie_kind kind;
  size_t frame_size;
  uint32_t frames;
};

/* A single palette requires all frames, which ffmpeg keeps in memory: above this number of bytes each
 * frame gets its own palette. */
#define PALETTE_BYTES_MAX ((uint64_t)1 << 30)

/* Ordered dithering is static where the picture is, which keeps a GIF steady and small. */
static void write_gif_filter(const draw_movie_options *options, char *filter, size_t size) {
  uint64_t bytes = (uint64_t)options->width * options->height * 3 * options->frame_count;
  bool one = options->frame_count && bytes <= PALETTE_BYTES_MAX;
  unsigned colors = options->colors ? options->colors : 256;
  snprintf(filter, size,
      "[0:v]split[a][b];[a]palettegen=max_colors=%u:stats_mode=%s[p];[b][p]paletteuse=%sdither=%s:"
      "diff_mode=rectangle",
      colors, one ? "full" : "single", one ? "" : "new=1:", colors < 256 ? "none" : "bayer:bayer_scale=5");
}

static sbf_status check(const char *path, const draw_movie_options *options, sbf_diagnostic *diagnostic) {
  static const char *const kinds[] = {"a GIF", "an MP4", "a WebP"};
  uint32_t max = options->kind == DRAW_MOVIE_MP4 ? 240 : DRAW_MOVIE_LOOP_FPS_MAX;
  if (options->width == 0 || options->height == 0 || options->width > 16384 || options->height > 16384)
    return fault_set_file(diagnostic, SBF_CODE_BAD_CALL, path, "a film of %ux%u pixels cannot be made",
        (unsigned)options->width, (unsigned)options->height);
  if (options->kind == DRAW_MOVIE_MP4 && (options->width < 2 || options->height < 2))
    return fault_set_file(diagnostic, SBF_CODE_BAD_CALL, path, "an MP4 needs at least 2x2 pixels");
  if (options->fps == 0 || options->fps > max)
    return fault_set_file(diagnostic, SBF_CODE_BAD_CALL, path, "%u frames a second: %s holds 1 to %u",
        (unsigned)options->fps, kinds[options->kind], (unsigned)max);
  return SBF_OK;
}

static int start(draw_movie *movie, const draw_movie_options *options, const char *file) {
  char size[32], rate[16], quality[16], gif_filter[192];
  const char *arguments[48];
  size_t count = 0;
  snprintf(size, sizeof size, "%ux%u", (unsigned)options->width, (unsigned)options->height);
  snprintf(rate, sizeof rate, "%u", (unsigned)options->fps);
  snprintf(quality, sizeof quality, "%u", options->quality ? (unsigned)options->quality : 80u);
  write_gif_filter(options, gif_filter, sizeof gif_filter);
  const char *const common[] = {options->ffmpeg ? options->ffmpeg : "ffmpeg", "-hide_banner", "-loglevel",
      "error", "-y", "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", size, "-framerate", rate,
      "-i", "pipe:0"};
  const char *const gif[] = {"-filter_complex", gif_filter, "-loop", "0", "-f", "gif"};
  /* yuv420p halves the colour resolution, so sizes must be even: crops an odd last row or column. */
  const char *const mp4[] = {"-vf",
      "crop=trunc(iw/2)*2:trunc(ih/2)*2:0:0,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p", "-c:v",
      "libx264", "-preset", "medium", "-crf", "17", "-colorspace", "bt709", "-color_primaries", "bt709",
      "-color_trc", "bt709", "-movflags", "+faststart", "-f", "mp4"};
  const char *const webp[] = {
      "-c:v", "libwebp_anim", "-lossless", "0", "-quality", quality, "-loop", "0", "-f", "webp"};
  const char *const *const own[] = {gif, mp4, webp}; /* by kind */
  const size_t own_count[] = {sizeof gif / sizeof *gif, sizeof mp4 / sizeof *mp4, sizeof webp / sizeof *webp};
  for (size_t i = 0; i < sizeof common / sizeof *common; i++) arguments[count++] = common[i];
  for (size_t i = 0; i < own_count[options->kind]; i++) arguments[count++] = own[options->kind][i];
  arguments[count++] = file;
  arguments[count] = NULL;
  return child_pipe_start(&movie->child, arguments, false);
}

sbf_status draw_movie_open(
    draw_movie **opened, const char *path, const draw_movie_options *options, sbf_diagnostic *diagnostic) {
  *opened = NULL;
  sbf_status status = check(path, options, diagnostic);
  if (status != SBF_OK) return status;
  draw_movie *made = calloc(1, sizeof *made);
  if (!made) return fault_set_file(diagnostic, SBF_CODE_OUT_OF_MEMORY, path, "no memory for a film");
  made->kind = options->kind;
  made->frame_size = (size_t)options->width * options->height * 3;
  status = output_file_begin(&made->output, path, diagnostic);
  if (status != SBF_OK) {
    free(made);
    return status;
  }
  /* "file:" prevents ffmpeg from interpreting a colon or a leading dash in the name. */
  size_t size = strlen(made->output.written_path) + 6;
  char *file = malloc(size);
  int error = ENOMEM;
  if (file) {
    snprintf(file, size, "file:%s", made->output.written_path);
    error = start(made, options, file);
    free(file);
  }
  if (error) {
    output_file_abandon(&made->output);
    free(made);
    if (error == ENOENT)
      return fault_set_file(diagnostic, SBF_CODE_NO_FFMPEG, path,
          "the program %s is not in PATH, and films are made with it: install it (Debian, Ubuntu: apt "
          "install "
          "ffmpeg), or ask for a .png",
          options->ffmpeg ? options->ffmpeg : "ffmpeg");
    return fault_set_file(diagnostic, SBF_CODE_FFMPEG_FAILED, path, "the program %s cannot be started: %s",
        options->ffmpeg ? options->ffmpeg : "ffmpeg", strerror(error));
  }
  output_file_tie(made->child.process);
  *opened = made;
  return SBF_OK;
}

/* True if it succeeded. */
static bool end_child(draw_movie *movie, char *said, size_t size) {
  output_file_tie(0); /* after waiting its number may be reused */
  return child_pipe_finish(&movie->child, said, size);
}

sbf_status draw_movie_add_frame(draw_movie *movie, const uint8_t *rgb, sbf_diagnostic *diagnostic) {
  char said[256];
  if (movie->child.process > 0 && child_pipe_write(&movie->child, rgb, movie->frame_size)) {
    movie->frames++;
    return SBF_OK;
  }
  said[0] = 0;
  if (movie->child.process > 0) end_child(movie, said, sizeof said);
  return fault_set_file(diagnostic, SBF_CODE_FFMPEG_FAILED, movie->output.given,
      "ffmpeg stopped at frame %u: %s", (unsigned)movie->frames, said[0] ? said : "it gave no reason");
}

sbf_status draw_movie_finish(draw_movie *movie, sbf_diagnostic *diagnostic) {
  char said[256];
  sbf_status status = SBF_OK;
  said[0] = 0;
  if (movie->frames == 0)
    status = fault_set_file(diagnostic, SBF_CODE_BAD_CALL, movie->output.given, "a film without a frame");
  else if (movie->child.process <= 0 || !end_child(movie, said, sizeof said))
    status = fault_set_file(diagnostic, SBF_CODE_FFMPEG_FAILED, movie->output.given, "ffmpeg failed: %s",
        said[0] ? said : "it gave no reason");
  else if (!draw_movie_file_is_whole(movie->kind, movie->output.written_path))
    status = fault_set_file(diagnostic, SBF_CODE_FFMPEG_FAILED, movie->output.given,
        "ffmpeg did not write all of it: %s; check the free space", said[0] ? said : "it gave no reason");
  if (status == SBF_OK) status = output_file_commit(&movie->output, diagnostic);
  draw_movie_abandon(movie);
  return status;
}

void draw_movie_abandon(draw_movie *movie) {
  if (!movie) return;
  output_file_tie(0);
  child_pipe_kill(&movie->child);
  output_file_abandon(&movie->output);
  free(movie);
}
