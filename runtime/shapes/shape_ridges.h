/* Edges of host boxes, hulls and meshes with an angle above 18 degrees. */
#ifndef SBRI_SHAPE_RIDGES_H
#define SBRI_SHAPE_RIDGES_H

#include "shapes/shape.h"

/* Call when the rest of the shape is built; returns false if memory runs out. */
bool sbri_shape_ridges_make(sbr_shape *shape);

#endif
