/* State of a window with a character. */
#ifndef VIEW_VIEWER_STATE_H
#define VIEW_VIEWER_STATE_H

#include "studio.h"
#include "view/input_script.h"
#include "view/player.h"
#include "view/window.h"

typedef enum viewer_panel { PANEL_FIGURES, PANEL_KEYS, PANEL_HIDDEN, PANEL_COUNT } viewer_panel;

/* Times over the last half second, or over all frames of a limited run. */
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
  viewer_costs costs, reported; /* being accumulated; as displayed */
  double reported_s;            /* duration of the latter */
  float home;                   /* m: initial distance of the camera */
  float rise;                   /* m: height of the camera's subject above the character's centre */
  float size;                   /* m: of the character */
  unsigned keys;                /* pressed walking keys */
  int ground;                   /* index among the grounds to choose from; -1: that of the call */
  sbr_ground own_ground;        /* ground of the call */
  viewer_panel panel;
  bool paused, quit, orbits, grabs;
  float depth;      /* m: of the grabbed object, from the eye */
  float pointer[2]; /* its position as fractions */
} viewer;

#endif
