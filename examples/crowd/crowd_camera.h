/* A crowd in a field, and who looks at it: shared with the benchmark of levels of detail. */
#ifndef CROWD_CAMERA_H
#define CROWD_CAMERA_H

#include <math.h>

#include "sbrun/detail.h"

enum { CROWD_COLUMNS = 20 };

static const float CROWD_HEIGHT_RAD = 1.0471976f, CROWD_WIDE = 16.0f / 9, CROWD_LINES = 1080;

/* The i-th of them: three metres apart, each looking elsewhere, and at its own speed. */
static inline sbr_character_definition crowd_arrange(uint32_t i) {
  sbr_character_definition at = sbr_default_character_definition();
  sbr_double3 position = {3.0 * (i % CROWD_COLUMNS) - 1.5 * CROWD_COLUMNS, 0, 3.0 * (i / CROWD_COLUMNS)};
  at.position = position;
  at.heading = 0.7f * (float)i;
  return at;
}
/* Likewise, so close that they run into each other. */
static inline sbr_character_definition crowd_arrange_close(uint32_t i) {
  sbr_character_definition at = crowd_arrange(i);
  sbr_double3 position = {2.4 * (i % 10) - 12, 0, 2.4 * (i / 10)};
  at.position = position;
  return at;
}
static inline void crowd_drive(sbr_world *world, sbr_character_id id, uint32_t i) {
  sbr_character_set_drive(world, id, 0.2f + 0.05f * (float)(i % 7), 0, 0.1f * (float)(i % 5) - 0.2f);
}

/* Along the front of the crowd, two metres from it, at a man's height; it turns as it goes. */
static inline sbr_view crowd_view(double seconds, double all_s) {
  double fraction = seconds / all_s, turn = 0.8 * (fraction - 0.5);
  sbr_view view;
  sbr_double3 eye = {40 * fraction - 20, 1.7, -3.5};
  sbf_vec3 forward = {(float)sin(turn), -0.12f, (float)cos(turn)};
  view.eye = eye, view.forward = forward;
  view.height_rad = CROWD_HEIGHT_RAD, view.width_ratio = CROWD_WIDE, view.lines = CROWD_LINES;
  return view;
}

/* Pixels right and up from the middle; false behind the eye and beyond the edges. */
static inline bool crowd_project(
    const sbr_view *view, double x, double y, double z, double *right, double *up) {
  double fx = (double)view->forward.x, fy = (double)view->forward.y, fz = (double)view->forward.z;
  double size = sqrt(fx * fx + fy * fy + fz * fz), flat = sqrt(fx * fx + fz * fz),
         lines = (double)view->lines;
  double along, across, over, pixels = lines / 2 / tan((double)view->height_rad / 2);
  x -= view->eye.x, y -= view->eye.y, z -= view->eye.z;
  along = (x * fx + y * fy + z * fz) / size;
  across = (x * fz - z * fx) / flat;
  over = (y * flat * flat - fy * (x * fx + z * fz)) / (flat * size);
  if (!(along > 0.1)) return false;
  *right = pixels * across / along, *up = pixels * over / along;
  return fabs(*up) <= 0.5 * lines && fabs(*right) <= 0.5 * lines * (double)view->width_ratio;
}

#endif
