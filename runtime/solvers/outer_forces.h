/* Forces that are neither springs nor weight: gas inside a surface, a medium that pushes on it, bending of
 * sheets, force fields. */
#ifndef SBRI_OUTER_FORCES_H
#define SBRI_OUTER_FORCES_H

#include "solvers/scheme.h"

/* Their sum on each free point, into t->outer, at the present positions and velocities, for a substep of h
 * seconds. */
void sbri_outer_forces(const sbri_island_tick *t, float h);

/* Reckons *t->outer_rad_s anew by how stiff the gases are at the present positions; not below what it is at
 * rest. */
void sbri_outer_look(const sbri_island_tick *t);

/* Acceleration of a point at x with velocity v, all in the field's space; m/s^2. */
sbf_vec3 sbri_field_at(const sbf_force_field *field, sbf_vec3 x, sbf_vec3 v);

/* Energy of a body's hinges and its gas, J; `positions` of its island, `vertices` scratch of its surface. */
double sbri_outer_energy(
    const sbri_island *island, const sbri_body *body, const sbri_point *positions, sbri_point *vertices);

#endif
