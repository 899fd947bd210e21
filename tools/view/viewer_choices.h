/* Choices by key in the window: grounds, speeds, levels of bodies and of the skin. */
#ifndef VIEW_VIEWER_CHOICES_H
#define VIEW_VIEWER_CHOICES_H

#include "view/viewer_state.h"

const char *viewer_ground_name(const viewer *v);
sbr_ground viewer_ground_make(const viewer *v); /* ground of the viewer's choice */
/* Index of a ground among the choices, as in `viewer.ground`. */
int viewer_ground_find(const sbr_ground *ground);
int viewer_next_ground(const viewer *v);

const char *viewer_pace_name(const viewer *v);
float viewer_first_pace(void); /* in character's sizes per second, as in the player */
float viewer_next_pace(const viewer *v);

uint32_t viewer_level_count(const sbf_asset *asset);
uint32_t viewer_render_level_count(const sbf_asset *asset);

#endif
