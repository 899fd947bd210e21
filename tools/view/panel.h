/* Text in the picture. */
#ifndef VIEW_PANEL_H
#define VIEW_PANEL_H

#include "view/viewer_state.h"

void panel_add(const viewer *v, draw_scene *scene);

#endif
