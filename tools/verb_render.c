#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/camera.h"
#include "render/canvas.h"
#include "render/movie.h"
#include "render/painter.h"
#include "render/picture.h"
#include "stage.h"

typedef enum output { OUTPUT_PNG, OUTPUT_GIF, OUTPUT_MP4 } output;

typedef struct studio {
  session s;
  stage *stage;
  skin_images images;
  draw_canvas *canvas;
  draw_painter *painter;
  draw_scene *scene;
  draw_camera camera;
  uint8_t *rgb;
  unsigned width, height, colors;
  float yaw, pitch; /* from where the camera looks, rad */
  output kind;
  bool framed;
} studio;

static bool parse_output(cli_call *call, output *kind) {
  static const char *const endings[] = {".png", ".gif", ".mp4"};
  const char *path = cli_value(call, "-o"), *dot = path ? strrchr(path, '.') : NULL;
  for (int i = 0; dot && i < 3; i++)
    if (strcmp(dot, endings[i]) == 0) {
      *kind = (output)i;
      return true;
    }
  cli_wrong(call, "say where to draw: -o OUT.png, OUT.gif or OUT.mp4");
  return false;
}

static bool parse_show(cli_call *call, unsigned *show) {
  static const char *const words[] = {"surface", "springs", "lattice", "bones", "hulls", "strain", "feet"};
  const char *text = cli_value(call, "--show");
  *show = text ? 0 : STAGE_SURFACE;
  while (text && *text) {
    size_t length = strcspn(text, ",");
    int found = -1;
    for (int i = 0; i < 7; i++)
      if (strlen(words[i]) == length && strncmp(words[i], text, length) == 0) found = i;
    if (found < 0) {
      cli_wrong(call,
          "--show takes surface, springs, lattice, bones, hulls, strain and feet with commas between, not "
          "'%s'",
          cli_value(call, "--show"));
      return false;
    }
    *show |= 1u << found;
    text += length + (text[length] == ',');
  }
  return true;
}

static bool parse_size(cli_call *call, studio *st) {
  static const unsigned usual[3][2] = {{1280, 960}, {640, 360}, {1280, 720}};
  const char *text = cli_value(call, "--size");
  char rest;
  st->width = usual[st->kind][0];
  st->height = usual[st->kind][1];
  if (!text || (sscanf(text, "%ux%u%c", &st->width, &st->height, &rest) == 2 && st->width >= 16 &&
                   st->height >= 16 && st->width <= DRAW_CANVAS_LARGEST && st->height <= DRAW_CANVAS_LARGEST))
    return true;
  cli_wrong(call, "--size takes WIDTHxHEIGHT from 16 to %d, not '%s'", DRAW_CANVAS_LARGEST, text);
  return false;
}

static bool parse_view(cli_call *call, studio *st) {
  const char *view = cli_value(call, "--view"), *colors = cli_value(call, "--colors");
  char rest;
  st->yaw = DRAW_CAMERA_THREE_QUARTER_YAW;
  st->pitch = DRAW_CAMERA_THREE_QUARTER_PITCH;
  if (view) {
    float yaw, pitch;
    if (sscanf(view, "%f,%f%c", &yaw, &pitch, &rest) != 2 || !(fabsf(yaw) <= 360) || !(fabsf(pitch) <= 85)) {
      cli_wrong(call, "--view takes YAW,PITCH in degrees, PITCH from -85 to 85, not '%s'", view);
      return false;
    }
    st->yaw = yaw * 0.017453293f;
    st->pitch = pitch * 0.017453293f;
  }
  if (!colors) return true;
  if (st->kind == OUTPUT_GIF && sscanf(colors, "%u%c", &st->colors, &rest) == 1 && st->colors >= 4 &&
      st->colors <= 256)
    return true;
  cli_wrong(call, "--colors takes 4 to 256, for a GIF, not '%s'", colors);
  return false;
}

static void print_note(void *call, const sbf_diagnostic *note) {
  cli_print_diagnostic(call, note);
}

static sbf_status open_studio(
    studio *st, cli_call *call, unsigned show, uint32_t render_level, sbf_diagnostic *error) {
  draw_canvas_quality quality = st->kind == OUTPUT_PNG ? DRAW_CANVAS_STILL : DRAW_CANVAS_MOVIE;
  sbf_status status = draw_canvas_open(&st->canvas, st->width, st->height, quality, error);
  if (status == SBF_OK) status = draw_painter_create(&st->painter, st->canvas, error);
  if (status != SBF_OK) return status;
  /* A skin that is seen through shows its colours alone. */
  if (!(show & ~(unsigned)(STAGE_SURFACE | STAGE_FEET)))
    skin_images_load(&st->images, st->s.asset, call->inputs[0], print_note, call);
  st->stage = stage_create(&st->s, &st->images, show, render_level);
  st->scene = draw_scene_create();
  st->rgb = malloc(3 * (size_t)st->width * st->height);
  if (st->stage && st->scene && st->rgb) return SBF_OK;
  *error = (sbf_diagnostic){.severity = SBF_SEVERITY_ERROR, .offset = -1, .index = -1};
  snprintf(error->message, sizeof error->message, "memory ran out for the picture");
  return SBF_FAILED;
}

static void close_studio(studio *st) {
  stage_destroy(st->stage);
  if (st->scene) draw_scene_destroy(st->scene);
  draw_painter_destroy(st->painter);
  draw_canvas_close(st->canvas);
  skin_images_free(&st->images);
  free(st->rgb);
  session_close(&st->s);
}

/* Paints the present frame; the camera frames the first and follows. */
static sbf_status paint(studio *st, sbf_diagnostic *error) {
  stage_show(st->stage, &st->s, st->scene);
  float aspect = (float)st->width / (float)st->height;
  if (!st->framed)
    draw_scene_frame(st->scene, &st->camera, aspect, st->yaw, st->pitch);
  else
    draw_scene_follow(st->scene, &st->camera, aspect, (float)(1 / st->s.fps));
  st->framed = true;
  sbf_status status = draw_painter_paint(st->painter, st->scene, &st->camera, error);
  return status == SBF_OK ? draw_canvas_read(st->canvas, st->rgb, error) : status;
}

static sbf_status draw_picture(studio *st, const char *path, sbf_diagnostic *error) {
  while (session_step(&st->s)) cli_progress("running", (double)st->s.frame / st->s.frame_count);
  sbf_status status = paint(st, error);
  return status == SBF_OK ? draw_picture_write_png(path, st->rgb, st->width, st->height, error) : status;
}

static sbf_status draw_film(studio *st, const char *path, sbf_diagnostic *error) {
  draw_movie_options options = {.kind = st->kind == OUTPUT_GIF ? DRAW_MOVIE_GIF : DRAW_MOVIE_MP4,
      .width = st->width,
      .height = st->height,
      .fps = (uint32_t)(st->s.fps + 0.5),
      .frame_count = st->s.frame_count,
      .colors = st->colors};
  draw_movie *movie;
  sbf_status status = draw_movie_open(&movie, path, &options, error);
  if (status != SBF_OK) return status;
  do {
    status = paint(st, error);
    if (status == SBF_OK) status = draw_movie_add_frame(movie, st->rgb, error);
    cli_progress("drawing", (double)st->s.frame / (st->s.frame_count + 1));
  } while (status == SBF_OK && session_step(&st->s));
  if (status == SBF_OK) return draw_movie_finish(movie, error);
  draw_movie_abandon(movie);
  return status;
}

static int run(cli_call *call) {
  static const double usual_fps[] = {60, 25, 30}, usual_seconds[] = {0, 5, 5};
  studio st = {.width = 0};
  unsigned show;
  long render_level = 0;
  int status;
  sbf_diagnostic error;
  if (!parse_output(call, &st.kind) || !parse_show(call, &show) || !parse_size(call, &st) ||
      !parse_view(call, &st) || !cli_integer(call, "--render-level", 0, 1000, &render_level))
    return SBF_FAILED;
  if (!session_open(&st.s, call, usual_seconds[st.kind], usual_fps[st.kind], &status)) return status;
  status = (int)open_studio(&st, call, show, (uint32_t)render_level, &error);
  const char *path = cli_value(call, "-o");
  if (status == SBF_OK)
    status = (int)(st.kind == OUTPUT_PNG ? draw_picture(&st, path, &error) : draw_film(&st, path, &error));
  cli_progress_end();
  if (status != SBF_OK)
    cli_print_diagnostic(call, &error);
  else if (!session_finish(&st.s, call))
    status = SBF_FAILED;
  close_studio(&st);
  return status;
}

static const cli_option options[] = {
    {"-o", "OUT.png|gif|mp4", "where to draw; films need the program ffmpeg"},
    {"--show", "LIST", "surface, springs, lattice, bones, hulls, strain, feet (surface)"},
    {"--size", "WxH", "pixels (1280x960, GIF 640x360, MP4 1280x720)"},
    {"--view", "YAW,PITCH", "from where, degrees: 0 ahead, 90 its left; above (41,15)"},
    {"--render-level", "N", "level of the meshes, 0 the full ones (0); where there are fewer, the last"},
    {"--colors", "N", "of a GIF's palette; few make it small (256)"},
    SESSION_OPTIONS,
    {NULL, NULL, NULL},
};
const cli_verb verb_render = {"render", "FILE -o OUT.png|gif|mp4 [--show LIST] [--seconds S] ...",
    "draw a picture or a film",
    "Draws without a display. A picture shows the moment after --seconds (0), a film the time until then "
    "(5). The\n"
    "skin turns translucent when what lies under it is shown too; else it wears its base colour images, "
    "where they\n"
    "are PNG. Springs are coloured by kind, or by strain.",
    options, 1, 1, run};
