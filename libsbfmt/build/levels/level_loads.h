/* How a level gives under loads, seen at its body's surface: what levels of one body are compared by.
 *
 * A body that something holds is loaded with a gravity along each of the three axes. One that nothing holds
 * is bent: with the acceleration e_i q_j^2, i and j different axes, q_j the position along j from the middle
 * in half extents; and stretched, with e_i q_i. The rigid motion in a load is subtracted, so that forces and
 * moments sum to zero, and the rigid motion in the answer as well. Held are the points of kinematic pins;
 * goal springs pull.
 *
 * Pushes stress every part of a body, however small, which gravity does not: its loose surface is divided
 * into patches, and each is pushed with 1 N along a direction of its own. The last three pushes are twists:
 * about the middle's three axes, over all of the loose surface by area; where nothing holds the body against
 * them, the more the farther along the axis, and the other way round on the other side. */
#ifndef SBFI_LEVEL_LOADS_H
#define SBFI_LEVEL_LOADS_H

#include "build/levels/level_statics.h"
#include "mechanics/linear_statics.h"

/* The forces (3 x level points) N of load number `load` of `size` m/s^2. */
void sbfi_level_compute_forces(const sbfi_level_statics *statics, uint32_t load, double size, double *forces);

enum { SBFI_PUSHED_PATCHES = 24, SBFI_TWISTS = 3, SBFI_PUSHES = 6 + SBFI_TWISTS };

typedef struct sbfi_level_pushes {
  uint32_t patch_count;
  uint32_t *patches;                 /* (surface points) UINT32_MAX: in none */
  double areas[SBFI_PUSHED_PATCHES]; /* m^2 */
} sbfi_level_pushes;

/* Patches around points as far from each other as can be, of the surface that the level does not hold: for
 * all levels of the body. Memory of `arena`; false where it runs out. */
bool sbfi_level_pushes_make(sbfi_level_pushes *made, const sbfi_level_statics *statics, sbfi_arena *arena);

/* The forces (3 x level points) N of push number `push`. */
void sbfi_level_push(
    const sbfi_level_statics *statics, const sbfi_level_pushes *pushes, uint32_t push, double *forces);

/* Rayleigh's quotient, rad/s, of the displacements under angular acceleration about the middle's axis `axis`
 * (0 to 2); where nothing holds the body, the more the farther along the axis, opposite on the two sides.
 * Solved within the relative error `fraction`; 0: it does not move. False where memory runs out. */
bool sbfi_level_twist_frequency(const sbfi_level_statics *statics, sbfi_linear_statics *linear, uint32_t axis,
    double fraction, double *frequency, sbfi_arena *scratch);

/* Displacements of the surface's points (3 * surface points, m) under load number `load` of `size` m/s^2,
 * with large strains as they are, until all but `tolerance` of the load is balanced; what takes more than
 * some steps of Newton's method does not converge. False where memory runs out or the work is ended. */
bool sbfi_level_give(const sbfi_level_statics *statics, uint32_t load, double size, double tolerance,
    double *displacements, bool *converged, sbfi_progress progress, sbfi_arena *scratch);

/* The same for small strains, under 1 m/s^2 and in m for that, right to `fraction`. `*frequency` rad/s is
 * Rayleigh's quotient of the displacements: little above the lowest mode's, where the load is one that the
 * mode gives to. */
bool sbfi_level_lean(const sbfi_level_statics *statics, sbfi_linear_statics *linear, uint32_t load,
    double fraction, double *displacements, double *frequency, sbfi_arena *scratch);

/* Displacements of the surface's points (3 x surface points, m) where the level's are displaced so (3 x level
 * points, m); what is rigid in them is left out where nothing holds the body. */
void sbfi_level_get_surface_displacements(
    const sbfi_level_statics *statics, const double *moved, double *displacements);

/* Mean over the surface of what it gives along the load, m. */
double sbfi_level_yielding(const sbfi_level_statics *statics, uint32_t load, const double *displacements);

#endif
