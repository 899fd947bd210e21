/* How far a skin comes apart where it is joined at rest. */
#ifndef SEAM_H
#define SEAM_H

#include "session.h"

typedef struct seams seams;

/* NULL where memory runs out. */
seams *seams_create(const session *s);
void seams_destroy(seams *all);

/* Measures the present skin: `skin` has the vertices of all render meshes one after the other. */
void seams_measure(seams *all, const sbf_vec3 *skin);

/* m: the greatest distance, at any time, between vertices of one mesh that are in one place at rest. */
double seams_gap(const seams *all);

#endif
