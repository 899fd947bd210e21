/* Soft bodies against the host's shapes: each place that may reach one within the tick gets a plane that
 * touches the shape there, moving with it, beside those of the ground (contact/contact.h). */
#ifndef SBRI_SHAPE_TOUCH_H
#define SBRI_SHAPE_TOUCH_H

#include "contact/contact.h"

/* Adds to the body's touches; after those of the ground. */
void sbri_shape_touches_add(
    const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_tables *tables);

#endif
