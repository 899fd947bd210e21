#include "studio.h"

#include <math.h>
#include <string.h>

static bool parse_show(cli_call *call, unsigned *show) {
  static const char *const words[STAGE_LAYER_COUNT] = {
      "surface", "springs", "lattice", "bones", "hulls", "strain", "feet", "contacts", "joints", "bounds"};
  const char *text = cli_value(call, "--show");
  *show = 0;
  while (text && *text) {
    size_t length = strcspn(text, ",");
    int found = -1;
    for (int i = 0; i < STAGE_LAYER_COUNT; i++)
      if (strlen(words[i]) == length && strncmp(words[i], text, length) == 0) found = i;
    if (found < 0) {
      cli_wrong(call,
          "--show takes surface, springs, lattice, bones, hulls, strain, feet, contacts, joints and bounds "
          "with "
          "commas between, not '%s'",
          cli_value(call, "--show"));
      return false;
    }
    *show |= 1u << found;
    text += length + (text[length] == ',');
  }
  return true;
}

static bool parse_view(cli_call *call, studio *st) {
  const char *view = cli_value(call, "--view");
  char rest;
  float yaw, pitch;
  st->yaw = DRAW_CAMERA_THREE_QUARTER_YAW;
  st->pitch = DRAW_CAMERA_THREE_QUARTER_PITCH;
  if (!view) return true;
  if (sscanf(view, "%f,%f%c", &yaw, &pitch, &rest) != 2 || !(fabsf(yaw) <= 360) || !(fabsf(pitch) <= 85)) {
    cli_wrong(call, "--view takes YAW,PITCH in degrees, PITCH from -85 to 85, not '%s'", view);
    return false;
  }
  st->yaw = yaw * 0.017453293f;
  st->pitch = pitch * 0.017453293f;
  return true;
}

bool studio_options(studio *st, cli_call *call) {
  long level = 0;
  bool good = parse_show(call, &st->show) && parse_view(call, st) &&
              cli_integer(call, "--render-level", 0, 1000, &level);
  st->render_level = (uint32_t)level;
  return good;
}

bool studio_size(cli_call *call, uint32_t *width, uint32_t *height) {
  const char *text = cli_value(call, "--size");
  unsigned wide, high;
  char rest;
  if (!text) return true;
  if (sscanf(text, "%ux%u%c", &wide, &high, &rest) == 2 && wide >= 16 && high >= 16 &&
      wide <= DRAW_CANVAS_LARGEST && high <= DRAW_CANVAS_LARGEST) {
    *width = wide;
    *height = high;
    return true;
  }
  cli_wrong(call, "--size takes WIDTHxHEIGHT from 16 to %d, not '%s'", DRAW_CANVAS_LARGEST, text);
  return false;
}

static sbf_status out_of_memory(sbf_diagnostic *error) {
  *error = (sbf_diagnostic){.severity = SBF_SEVERITY_ERROR, .offset = -1, .index = -1};
  snprintf(error->message, sizeof error->message, "memory ran out for the picture");
  return SBF_FAILED;
}

sbf_status studio_set_appearance(studio *st, sbf_diagnostic *error) {
  /* A transparent skin has colours only. */
  if (!st->has_images && !(st->show & ~(unsigned)(STAGE_SURFACE | STAGE_FEET))) {
    skin_images_load(&st->images, st->s.asset, st->call->inputs[0], cli_report, st->call);
    st->has_images = true;
  }
  stage_destroy(st->stage);
  st->stage = stage_create(&st->s, &st->images, st->show, st->render_level);
  return st->stage ? SBF_OK : out_of_memory(error);
}

/* Default selection of the visible parts. */
static unsigned usual_show(const sbf_asset *asset) {
  if (asset->render_meshes.count || asset->soft_bodies.count) return STAGE_SURFACE;
  return asset->bones.count ? STAGE_BONES : STAGE_HULLS;
}

sbf_status studio_open(studio *st, cli_call *call, draw_canvas *canvas, sbf_diagnostic *error) {
  st->canvas = canvas;
  st->call = call;
  if (!cli_value(call, "--show")) st->show = usual_show(st->s.asset);
  sbf_status status = draw_painter_create(&st->painter, st->canvas, error);
  if (status != SBF_OK) return status;
  if (!(st->scene = draw_scene_create())) return out_of_memory(error);
  return studio_set_appearance(st, error);
}

void studio_close(studio *st) {
  stage_destroy(st->stage);
  if (st->scene) draw_scene_destroy(st->scene);
  draw_painter_destroy(st->painter);
  draw_canvas_close(st->canvas);
  skin_images_free(&st->images);
  session_close(&st->s);
}

float studio_aspect(const studio *st) {
  return (float)draw_canvas_width(st->canvas) / (float)draw_canvas_height(st->canvas);
}

sbf_status studio_paint(studio *st, sbf_diagnostic *error) {
  float aspect = studio_aspect(st);
  stage_show(st->stage, &st->s, st->scene);
  if (!st->framed)
    draw_scene_frame(st->scene, &st->camera, aspect, st->yaw, st->pitch);
  else
    draw_scene_follow(st->scene, &st->camera, aspect, (float)(1 / st->s.fps));
  st->framed = true;
  return draw_painter_paint(st->painter, st->scene, &st->camera, error);
}
