/* What a window with a character in it is at a moment. */
#ifndef VIEW_VIEWER_STATE_H
#define VIEW_VIEWER_STATE_H

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
  viewer_costs costs, reported; /* being gathered; as shown */
  double reported_s;            /* how long that took */
  float home;                   /* m: of the camera at first */
  float rise;                   /* m: of the camera's subject above the character's middle */
  float size;                   /* m: of the character */
  unsigned keys;                /* pressed, of those that walk */
  int ground;                   /* place among the grounds to choose from; -1: as the call says */
  sbr_ground own_ground;        /* that one */
  viewer_panel panel;
  bool paused, quit, orbits, grabs;
  float depth;      /* m: of what is held, before the eye */
  float pointer[2]; /* where it is, as shares */
} viewer;

#endif
