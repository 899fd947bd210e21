/* Measures gaps in a skin between vertices that coincide at rest. */
#ifndef SEAM_H
#define SEAM_H

#include "session.h"

typedef struct seams seams;

/* NULL if memory runs out. */
seams *seams_create(const session *s);
void seams_destroy(seams *all);

/* Measures the current skin: `skin` has the vertices of all render meshes, concatenated. */
void seams_measure(seams *all, const sbf_vec3 *skin);

/* m: maximum distance over time between vertices of one mesh that coincide at rest. */
double seams_gap(const seams *all);

#endif
