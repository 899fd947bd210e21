/* A character in a window: its view, camera, keys and pointer. */
#ifndef VIEW_VIEWER_H
#define VIEW_VIEWER_H

#include "view/viewer_state.h"

/* Creates the player of a new session, and frames the camera if `framed` is false. */
sbf_status viewer_begin(viewer *v, sbf_diagnostic *error);
/* Handles an event of the window; *error has a fatal failure. */
sbf_status viewer_take(viewer *v, const SDL_Event *event, sbf_diagnostic *error);
/* Advances the time: false after the session's last frame. */
bool viewer_step(viewer *v, double seconds);
/* Paints the window. */
sbf_status viewer_draw(viewer *v, sbf_diagnostic *error);

#endif
