/* Draws a session: scene, camera, painter and their options. Used for pictures, films and the window. */
#ifndef STUDIO_H
#define STUDIO_H

#include "render/camera.h"
#include "render/canvas.h"
#include "render/painter.h"
#include "stage.h"

/* The common drawing options; each verb has its own for sizes. */
#define STUDIO_OPTIONS                                                                                       \
  {"--show", "LIST",                                                                                         \
      "surface, springs, lattice, bones, hulls, strain, feet, contacts, joints, bounds (surface; without "   \
      "one: bones, or hulls)"},                                                                              \
      {"--view", "YAW,PITCH",                                                                                \
          "camera angles in degrees: 0 shows the front, 90 its left side; pitch from above (41,15)"},        \
  {                                                                                                          \
    "--render-level", "N", "mesh level, 0 is the full mesh (0); meshes with fewer levels use their last"     \
  }

typedef struct studio {
  session s;
  unsigned show; /* STAGE_SURFACE and so on; 0 until studio_open if the call does not set it */
  uint32_t render_level;
  float yaw, pitch; /* initial direction of the camera, rad */
  stage *stage;
  skin_images images;
  draw_canvas *canvas;
  draw_painter *painter;
  draw_scene *scene;
  draw_camera camera;
  bool framed, has_images;
  cli_call *call;
} studio;

/* Reads STUDIO_OPTIONS, and --size as WxH with defaults `width` and `height`. False, with a message, if
 * they are invalid. */
bool studio_options(studio *st, cli_call *call);
bool studio_size(cli_call *call, uint32_t *width, uint32_t *height);

/* For an open session, on a canvas, which the studio closes; a NULL canvas fails. */
sbf_status studio_open(studio *st, cli_call *call, draw_canvas *canvas, sbf_diagnostic *error);
/* Rebuilds the scene: after the session was recreated, or to show other parts (st->show) or another render
 * level. */
sbf_status studio_set_appearance(studio *st, sbf_diagnostic *error);
/* Of the canvas. */
float studio_aspect(const studio *st);
void studio_close(studio *st); /* the session too */

/* Paints the current frame; the camera frames the first and follows. */
sbf_status studio_paint(studio *st, sbf_diagnostic *error);

#endif
