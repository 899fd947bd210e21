/* Measures a walk's contact with the ground on the skin: slip and penetration of each foot's sole. */
#ifndef SOLE_H
#define SOLE_H

#include "session.h"

typedef struct sole_report {
  double slip_m;        /* maximum distance that a planted sole moved over the ground during one stance */
  double penetration_m; /* maximum depth of a sole below the ground, relative to its rest height */
} sole_report;

typedef struct soles soles;

/* NULL if the character has no legs, or memory runs out. */
soles *soles_create(const session *s);
void soles_destroy(soles *soles);

/* Measures the current skin: `skin` has the vertices of all render meshes, concatenated. */
void soles_measure(soles *soles, const session *s, const sbf_vec3 *skin);
/* Indices in the skin of a leg's sole; returns their number. */
uint32_t soles_vertices(const soles *soles, uint32_t leg, const uint32_t **vertices);
/* Those with weights of the foot only: others move as the leg bends. */
uint32_t soles_firm_vertices(const soles *soles, uint32_t leg, const uint32_t **vertices);
/* Radius around its centre at rest, seen from above, m; 0: it has no skin. */
double soles_radius(const soles *soles, const session *s, uint32_t leg);
sole_report soles_report(const soles *soles);

#endif
