/* Edges of coarse soft bodies against edges of the host's shapes, where neither has a point in the other. */
#ifndef SBRI_SHAPE_EDGES_H
#define SBRI_SHAPE_EDGES_H

#include "contact/soft_shape_contacts.h"

/* Adds to the touches of the body with that shape. */
void sbri_shape_edges_add(const sbri_shape_pair *shape_pair);

#endif
