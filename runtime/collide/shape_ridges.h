/* Edges of a host's box, hull or mesh that stand out by more than 18 degrees. */
#ifndef SBRI_SHAPE_RIDGES_H
#define SBRI_SHAPE_RIDGES_H

#include "collide/shape.h"

/* Of a shape that is otherwise made; false where memory runs out. */
bool sbri_shape_ridges_make(sbr_shape *shape);

#endif
