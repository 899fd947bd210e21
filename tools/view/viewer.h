/* A character in a window: what is shown, from where, and what keys and pointer do. */
#ifndef VIEW_VIEWER_H
#define VIEW_VIEWER_H

#include "view/viewer_state.h"

/* The player of the session that was just made, and the camera framed if `framed` is false. */
sbf_status viewer_begin(viewer *v, sbf_diagnostic *error);
/* What happened to the window; what cannot be gone on from is in *error. */
sbf_status viewer_take(viewer *v, const SDL_Event *event, sbf_diagnostic *error);
/* Time passes: false after the session's last frame. */
bool viewer_step(viewer *v, double seconds);
/* Paints the window. */
sbf_status viewer_draw(viewer *v, sbf_diagnostic *error);

#endif
