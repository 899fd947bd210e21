/* sbfmt render: renders pictures and films without a window. */
#include <stdlib.h>
#include <string.h>

#include "render/movie.h"
#include "render/picture.h"
#include "studio.h"

typedef enum output { OUTPUT_PNG, OUTPUT_GIF, OUTPUT_MP4, OUTPUT_WEBP, OUTPUTS } output;

typedef struct shooting {
  studio st;
  uint8_t *rgb;
  uint32_t width, height;
  unsigned colors, quality;
  output kind;
} shooting;

static bool parse_output(cli_call *call, output *kind) {
  static const char *const endings[] = {".png", ".gif", ".mp4", ".webp"};
  const char *path = cli_value(call, "-o"), *dot = path ? strrchr(path, '.') : NULL;
  for (int i = 0; dot && i < OUTPUTS; i++)
    if (strcmp(dot, endings[i]) == 0) {
      *kind = (output)i;
      return true;
    }
  cli_wrong(call, "state the output: -o OUT.png, OUT.gif, OUT.mp4 or OUT.webp");
  return false;
}

/* An option of one kind of film only. */
static bool parse_own(
    cli_call *call, const shooting *shot, const char *option, output kind, long min, long max, unsigned *to) {
  long value = 0;
  if (!cli_value(call, option)) return true;
  if (shot->kind != kind)
    return cli_wrong(call, "%s is for a %s: leave it out", option, kind == OUTPUT_GIF ? "GIF" : "WebP"),
           false;
  if (!cli_integer(call, option, min, max, &value)) return false;
  *to = (unsigned)value;
  return true;
}

static sbf_status open_shooting(shooting *shot, cli_call *call, sbf_diagnostic *error) {
  draw_canvas *canvas;
  draw_canvas_quality quality = shot->kind == OUTPUT_PNG ? DRAW_CANVAS_STILL : DRAW_CANVAS_MOVIE;
  sbf_status status = draw_canvas_open(&canvas, shot->width, shot->height, quality, error);
  if (status == SBF_OK) status = studio_open(&shot->st, call, canvas, error);
  if (status != SBF_OK) return status;
  if ((shot->rgb = malloc(3 * (size_t)shot->width * shot->height))) return SBF_OK;
  *error = (sbf_diagnostic){.severity = SBF_SEVERITY_ERROR, .offset = -1, .index = -1};
  snprintf(error->message, sizeof error->message, "memory ran out for the picture");
  return SBF_FAILED;
}

static sbf_status paint(shooting *shot, sbf_diagnostic *error) {
  sbf_status status = studio_paint(&shot->st, error);
  return status == SBF_OK ? draw_canvas_read(shot->st.canvas, shot->rgb, error) : status;
}

static sbf_status draw_picture(shooting *shot, const char *path, sbf_diagnostic *error) {
  session *s = &shot->st.s;
  while (session_step(s)) cli_progress("running", (double)s->frame / s->frame_count);
  sbf_status status = paint(shot, error);
  return status == SBF_OK ? draw_picture_write_png(path, shot->rgb, shot->width, shot->height, error)
                          : status;
}

static sbf_status draw_film(shooting *shot, const char *path, sbf_diagnostic *error) {
  session *s = &shot->st.s;
  static const draw_movie_kind kinds[] = {
      [OUTPUT_GIF] = DRAW_MOVIE_GIF, [OUTPUT_MP4] = DRAW_MOVIE_MP4, [OUTPUT_WEBP] = DRAW_MOVIE_WEBP};
  draw_movie_options options = {.kind = kinds[shot->kind],
      .width = shot->width,
      .height = shot->height,
      .fps = (uint32_t)(s->fps + 0.5),
      .frame_count = s->frame_count,
      .colors = shot->colors,
      .quality = shot->quality};
  draw_movie *movie;
  sbf_status status = draw_movie_open(&movie, path, &options, error);
  if (status != SBF_OK) return status;
  do {
    status = paint(shot, error);
    if (status == SBF_OK) status = draw_movie_add_frame(movie, shot->rgb, error);
    cli_progress("drawing", (double)s->frame / (s->frame_count + 1));
  } while (status == SBF_OK && session_step(s));
  if (status == SBF_OK) return draw_movie_finish(movie, error);
  draw_movie_abandon(movie);
  return status;
}

static int run(cli_call *call) {
  static const double usual_fps[] = {60, 25, 30, 25}, usual_seconds[] = {0, 5, 5, 5};
  static const uint32_t usual_size[OUTPUTS][2] = {{1280, 960}, {640, 360}, {1280, 720}, {640, 360}};
  shooting shot = {.width = 0};
  studio *st = &shot.st;
  int status;
  sbf_diagnostic error;
  if (!parse_output(call, &shot.kind)) return SBF_FAILED;
  shot.width = usual_size[shot.kind][0];
  shot.height = usual_size[shot.kind][1];
  if (!studio_options(st, call) || !studio_size(call, &shot.width, &shot.height) ||
      !parse_own(call, &shot, "--colors", OUTPUT_GIF, 4, 256, &shot.colors) ||
      !parse_own(call, &shot, "--quality", OUTPUT_WEBP, 1, 100, &shot.quality))
    return SBF_FAILED;
  if (!session_open(&st->s, call, usual_seconds[shot.kind], usual_fps[shot.kind], &status)) return status;
  status = (int)open_shooting(&shot, call, &error);
  const char *path = cli_value(call, "-o");
  if (status == SBF_OK)
    status =
        (int)(shot.kind == OUTPUT_PNG ? draw_picture(&shot, path, &error) : draw_film(&shot, path, &error));
  cli_progress_end();
  if (status != SBF_OK)
    cli_print_diagnostic(call, &error);
  else if (!session_finish(&st->s, call))
    status = SBF_FAILED;
  studio_close(st);
  free(shot.rgb);
  return status;
}

static const cli_option options[] = {
    {"-o", "OUT.png|gif|mp4|webp", "output file; films need the program ffmpeg"},
    STUDIO_OPTIONS,
    {"--size", "WxH", "pixels (1280x960, GIF and WebP 640x360, MP4 1280x720)"},
    {"--colors", "N", "colours of a GIF; fewer make it smaller (256)"},
    {"--quality", "N", "quality of a WebP, 1 to 100 (80)"},
    SESSION_OPTIONS(
        "time of a picture (0), length of a film (5)", "frames a second (GIF and WebP 25, MP4 30)"),
    {NULL, NULL, NULL},
};
const cli_verb verb_render = {"render", "FILE -o OUT.png|gif|mp4|webp [--show LIST] [--seconds S] ...",
    "draw a picture or a film",
    "Draws without a display. A picture shows the moment after --seconds (default 0), a film\n"
    "the time up to it (default 5). The skin is translucent if parts below it are shown too.\n"
    "Otherwise it is drawn with its materials and base colour images (PNG, JPEG, WebP).\n"
    "Springs are coloured by kind or by strain.",
    options, 1, 1, run};
