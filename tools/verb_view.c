/* sbfmt view: a character in a window. */
#include <stdlib.h>
#include <string.h>

#ifdef SBFMT_WINDOW
#include "render/picture.h"
#include "view/viewer.h"
#include "view/viewer_choices.h"
#else
#include "studio.h"
#endif

#ifdef SBFMT_WINDOW

static const double FRAME_MAX_S = 0.05; /* a slower machine shows slow motion */

typedef struct viewing {
  viewer v;
  uint32_t width, height;
  long frames; /* 0: until it is closed */
  uint8_t *rgb;
} viewing;

static sbf_status write_shot(viewing *g, const char *path, sbf_diagnostic *error) {
  uint32_t width = draw_canvas_width(g->v.st.canvas), height = draw_canvas_height(g->v.st.canvas);
  uint8_t *grown = realloc(g->rgb, 3 * (size_t)width * height);
  if (!grown) {
    *error = (sbf_diagnostic){.severity = SBF_SEVERITY_ERROR, .offset = -1, .index = -1};
    snprintf(error->message, sizeof error->message, "memory ran out for the picture");
    return SBF_FAILED;
  }
  g->rgb = grown;
  sbf_status status = draw_canvas_read(g->v.st.canvas, g->rgb, error);
  return status == SBF_OK ? draw_picture_write_png(path, g->rgb, width, height, error) : status;
}

/* Handles the script's events, then the window's. */
static sbf_status handle_events(viewer *v, uint32_t frame, const char **shot, sbf_diagnostic *error) {
  SDL_Event event;
  sbf_status status = SBF_OK;
  while (status == SBF_OK && input_script_next(&v->input, &v->w, frame, &event, shot))
    status = viewer_take(v, &event, error);
  while (status == SBF_OK && v->w.sdl.PollEvent(&event)) status = viewer_take(v, &event, error);
  return status;
}

/* A frame: events, time step, picture. *more: false after the last. */
static sbf_status show_frame(viewing *g, uint32_t frame, double seconds, bool *more, sbf_diagnostic *error) {
  viewer *v = &g->v;
  const char *shot = NULL;
  sbf_status status = handle_events(v, frame, &shot, error);
  if (status != SBF_OK) return status;
  *more = viewer_step(v, seconds);
  status = viewer_draw(v, error);
  if (status == SBF_OK && shot) status = write_shot(g, shot, error);
  if (status == SBF_OK) v->w.sdl.GL_SwapWindow(v->w.shown);
  return status;
}

static sbf_status show(viewing *g, sbf_diagnostic *error) {
  viewer *v = &g->v;
  sbf_status status = SBF_OK;
  bool more = true;
  double last = window_seconds(&v->w);
  v->costs.since_s = last;
  for (uint32_t frame = 0;
       status == SBF_OK && more && !v->quit && (g->frames == 0 || frame < (uint32_t)g->frames); frame++) {
    double now = window_seconds(&v->w), seconds = 1 / v->st.s.fps;
    if (g->frames == 0) seconds = now - last < FRAME_MAX_S ? now - last : FRAME_MAX_S;
    last = now;
    status = show_frame(g, frame, seconds > 1e-6 ? seconds : 1e-6, &more, error);
  }
  const char *shot = cli_value(v->call, "--shot");
  return status == SBF_OK && shot ? write_shot(g, shot, error) : status;
}

static int report(const viewer *v) {
  const session *s = &v->st.s;
  char hash[24];
  json_t *o = json_object();
  bool valid = true;
  for (uint32_t i = 0; i < s->asset->soft_bodies.count; i++) {
    sbr_body_health health = sbr_character_get_body_health(s->world, s->character, i);
    valid = valid && health.finite && !health.inverted;
  }
  snprintf(hash, sizeof hash, "%016llx", (unsigned long long)sbr_world_get_state_hash(s->world));
  json_object_set_new(o, "frames", json_integer(s->frame));
  json_object_set_new(o, "seconds", json_real(s->time_s));
  json_object_set_new(o, "state_hash", json_string(hash));
  json_object_set_new(o, "valid", json_boolean(valid));
  json_object_set_new(o, "walked", json_real(sbr_character_get_distance(s->world, s->character)));
  json_object_set_new(o, "level", json_integer(s->settings.model.level));
  json_object_set_new(o, "render_level", json_integer(v->st.render_level));
  json_object_set_new(o, "ground", json_string(viewer_ground_name(v)));
  json_object_set_new(o, "pace", json_string(viewer_pace_name(v)));
  json_object_set_new(o, "balls_thrown", json_integer(v->p.thrown));
  json_object_set_new(o, "ball_hits", json_integer(v->p.hits));
  json_object_set_new(o, "holds", json_boolean(v->p.holds));
  json_object_set_new(o, "paused", json_boolean(v->paused));
  json_object_set_new(o, "camera",
      json_pack("{s:f,s:f,s:f}", "yaw", (double)v->st.camera.yaw, "pitch", (double)v->st.camera.pitch,
          "distance", (double)v->st.camera.distance));
  return cli_print_json(o, SBF_OK);
}

static sbf_status open_all(viewing *g, cli_call *call, sbf_diagnostic *error) {
  viewer *v = &g->v;
  const char *title = v->st.s.asset->info.title;
  char words[160];
  draw_context context;
  draw_canvas *canvas;
  snprintf(words, sizeof words, "%s - sbfmt", title && *title ? title : call->inputs[0]);
  sbf_status status = window_open(&v->w, words, g->width, g->height, g->frames == 0, &context, error);
  if (status != SBF_OK) return status;
  const char *input = cli_value(call, "--input");
  int wrong;
  error->code = 0;
  if (input && !input_script_load(&v->input, &v->w.sdl, call, input, &wrong)) return (sbf_status)wrong;
  window_pixels(&v->w, &g->width, &g->height);
  status = draw_canvas_open_in(&canvas, &context, g->width, g->height, DRAW_CANVAS_MOVIE, error);
  if (status == SBF_OK) status = studio_open(&v->st, call, canvas, error);
  return status == SBF_OK ? viewer_begin(v, error) : status;
}

static int run(cli_call *call) {
  viewing g = {.width = 1280, .height = 800, .v = {.call = call, .ground = -1}};
  viewer *v = &g.v;
  int status;
  sbf_diagnostic error = {.code = 0};
  if (!cli_integer(call, "--frames", 1, 10000000, &g.frames) || !studio_options(&v->st, call) ||
      !studio_size(call, &g.width, &g.height))
    return SBF_FAILED;
  if (!session_open(&v->st.s, call, 1e6, 60, &status)) return status;
  status = (int)open_all(&g, call, &error);
  if (status == SBF_OK) status = (int)show(&g, &error);
  if (status != SBF_OK && error.code)
    cli_print_diagnostic(call, &error);
  else if (status == SBF_OK && !session_finish(&v->st.s, call))
    status = SBF_FAILED;
  if (status == SBF_OK && call->json) status = report(v);
  if (v->p.s) player_close(&v->p);
  studio_close(&v->st);
  input_script_free(&v->input);
  window_close(&v->w);
  free(g.rgb);
  return status;
}

#else

static int run(cli_call *call) {
  return cli_wrong(call,
      "this sbfmt was built without a window: install SDL 2's headers (Debian, Ubuntu: apt install "
      "libsdl2-dev), configure with -DSBFMT_WINDOW=ON and build again; `sbfmt render` draws pictures without "
      "one");
}

#endif

static const cli_option options[] = {
    STUDIO_OPTIONS,
    {"--size", "WxH", "size of the window (1280x800)"},
    {"--frames", "N", "run N frames as fast as possible, then exit (until the window is closed)"},
    {"--input", "FILE", "scripted keys and pointer; see docs/view.md"},
    {"--shot", "OUT.png", "write the last frame as a picture"},
    {"--format", "text|json", "how to print (text)"},
    SESSION_OPTIONS("simulated time (until the window is closed)", "frames a second for --frames (60)"),
    {NULL, NULL, NULL},
};
const cli_verb verb_view = {"view", "FILE [--ground KIND] [--show LIST] ...",
    "show a character in a window and play with it",
    "W A S D walk, Q E walk sideways, B throws a ball, K knocks it over, R restarts, P\n"
    "pauses. 1 to 7 show or hide skin, springs, lattice, bones, strain, hulls and feet. G, L,\n"
    "M and F select ground, simulation level, mesh level and speed. Arrow keys or dragging\n"
    "the ground turn the view, + and - zoom. Dragging the body pulls it. H shows all keys.\n"
    "Needs SDL 2 and a display.",
    options, 1, 1, run};
