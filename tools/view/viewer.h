/* A character in a window: what is shown, from where, and what keys and pointer do. */
#ifndef VIEW_VIEWER_H
#define VIEW_VIEWER_H

#include "studio.h"
#include "view/input_script.h"
#include "view/player.h"
#include "view/window.h"

typedef enum viewer_panel { PANEL_FIGURES, PANEL_KEYS, PANEL_HIDDEN, PANEL_COUNT } viewer_panel;

/* What the last half second, or all that was run by frames, cost. */
typedef struct viewer_costs {
  double physics_s, picture_s; /* sums */
  double since_s;              /* on the window's clock */
  uint32_t frames;
} viewer_costs;

typedef struct viewer {
  studio st;
  window w;
  player p;
  cli_call *call;
  input_script input;
  viewer_costs costs, told; /* being gathered; as shown */
  double told_s;            /* how long that took */
  float home;               /* m: of the camera at first */
  float rise;               /* m: of the camera's subject above the character's middle */
  float size;               /* m: of the character */
  unsigned keys;            /* pressed, of those that walk */
  int ground;               /* of viewer_grounds; -1: as the call says */
  sbr_ground own_ground;    /* that one */
  viewer_panel panel;
  bool paused, quit, orbits, grabs;
  float depth;      /* m: of what is held, before the eye */
  float pointer[2]; /* where it is, as shares */
} viewer;

const char *viewer_ground_name(const viewer *v);
const char *viewer_pace_name(const viewer *v);
uint32_t viewer_level_count(const sbf_asset *asset);
uint32_t viewer_render_level_count(const sbf_asset *asset);

/* The player of the session that was just made, and the camera framed if `framed` is false. */
sbf_status viewer_begin(viewer *v, sbf_diagnostic *error);
/* What happened to the window; what cannot be gone on from is in *error. */
sbf_status viewer_take(viewer *v, const SDL_Event *event, sbf_diagnostic *error);
/* Time passes: false after the session's last frame. */
bool viewer_step(viewer *v, double seconds);
/* Paints the window. */
sbf_status viewer_draw(viewer *v, sbf_diagnostic *error);

/* view/panel.c: the words in the picture. */
void panel_add(const viewer *v, draw_scene *scene);

#endif
