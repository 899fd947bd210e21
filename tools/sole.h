/* What a walk does to the ground, measured on the skin: the sole of each foot, its slip and how deep it goes.
 */
#ifndef SOLE_H
#define SOLE_H

#include "session.h"

typedef struct sole_report {
  double slip_m;        /* farthest that a planted sole moved over the ground during one stance */
  double penetration_m; /* deepest that a sole went below the ground, its rest height taken off */
} sole_report;

typedef struct soles soles;

/* NULL where the character has no legs, or memory runs out. */
soles *soles_create(const session *s);
void soles_destroy(soles *soles);

/* Measures the present skin: `skin` has the vertices of all render meshes one after the other. */
void soles_measure(soles *soles, const session *s, const sbf_vec3 *skin);
/* Places in the skin of a leg's sole; returns how many. */
uint32_t soles_vertices(const soles *soles, uint32_t leg, const uint32_t **vertices);
/* Those of them with weights of the foot only: others move as the leg bends. */
uint32_t soles_firm_vertices(const soles *soles, uint32_t leg, const uint32_t **vertices);
/* Its radius around its centre at rest, seen from above, m; 0: no skin follows it. */
double soles_radius(const soles *soles, const session *s, uint32_t leg);
sole_report soles_report(const soles *soles);

#endif
