/* External forces: gas inside a surface, a medium around it, bending of sheets, force fields. */
#ifndef SBRI_EXTERNAL_FORCES_H
#define SBRI_EXTERNAL_FORCES_H

#include "soft/solvers/scheme.h"

/* Writes the sum of external forces on each free point to t->external_forces, at the present positions and
 * velocities, for a substep of h seconds. */
void sbri_compute_external_forces(const sbri_island_tick *t, float h);

/* Updates *t->external_rad_s for the stiffness of the gases at the present positions, at least its value at
 * rest. */
void sbri_update_gas_stiffness(const sbri_island_tick *t);

/* Acceleration of a point at x with velocity v, all in the field's space; m/s^2. */
sbf_vec3 sbri_field_at(const sbf_force_field *field, sbf_vec3 x, sbf_vec3 v);

/* Energy of a body's hinges and its gas, J. `positions` are those of its island; `vertices` is scratch of its
 * surface. */
double sbri_external_energy(
    const sbri_island *island, const sbri_body *body, const sbri_point *positions, sbri_point *vertices);

#endif
