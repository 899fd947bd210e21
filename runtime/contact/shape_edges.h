/* Contacts between edges of coarse soft bodies and edges of host shapes, where neither has a point inside the
 * other. */
#ifndef SBRI_SHAPE_EDGES_H
#define SBRI_SHAPE_EDGES_H

#include "contact/soft_shape_contacts.h"

/* Adds contacts of the body with the shape. */
void sbri_shape_edges_add(const sbri_shape_pair *shape_pair);

#endif
