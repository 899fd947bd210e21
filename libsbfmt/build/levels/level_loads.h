/* Displacements of a body's surface under loads, for comparison of levels of one body.
 *
 * A pinned body is loaded with gravity along each of the three axes. A free body is bent with the
 * acceleration e_i q_j^2, i and j different axes, q_j the position along j from the centre in half extents,
 * and stretched with e_i q_i. The rigid motion is subtracted from the load, so that forces and moments sum to
 * zero, and from the displacements as well. Points of kinematic pins are fixed; goal springs pull.
 *
 * Pushes stress every part of a body, even small ones, unlike gravity: the free surface is divided into
 * patches, each pushed with 1 N in its own direction. The last three pushes are twists about the three
 * central axes, over the whole free surface by area; for a free body proportional to the position along
 * the axis, with opposite signs on both sides. */
#ifndef SBFI_LEVEL_LOADS_H
#define SBFI_LEVEL_LOADS_H

#include "build/levels/level_statics.h"
#include "mechanics/linear_statics.h"

/* Forces (3 x level points) N of load `load` with size `size` m/s^2. */
void sbfi_level_compute_forces(const sbfi_level_statics *statics, uint32_t load, double size, double *forces);

enum { SBFI_PUSHED_PATCHES = 24, SBFI_TWISTS = 3, SBFI_PUSHES = 6 + SBFI_TWISTS };

typedef struct sbfi_level_pushes {
  uint32_t patch_count;
  uint32_t *patches;                 /* (surface points) UINT32_MAX: no patch */
  double areas[SBFI_PUSHED_PATCHES]; /* m^2 */
} sbfi_level_pushes;

/* Creates patches around widely spaced points of the surface that the level does not pin, for all levels
 * of the body. Allocates from `arena`; false if memory runs out. */
bool sbfi_level_pushes_make(sbfi_level_pushes *made, const sbfi_level_statics *statics, sbfi_arena *arena);

/* Forces (3 x level points) N of push number `push`. */
void sbfi_level_push(
    const sbfi_level_statics *statics, const sbfi_level_pushes *pushes, uint32_t push, double *forces);

/* Rayleigh's quotient, rad/s, of the displacements under angular acceleration about the central axis
 * `axis` (0 to 2); for a free body proportional to the position along the axis, with opposite signs on
 * both sides. Solved to the relative error `fraction`; 0: it does not move. False if memory runs out. */
bool sbfi_level_twist_frequency(const sbfi_level_statics *statics, sbfi_linear_statics *linear, uint32_t axis,
    double fraction, double *frequency, sbfi_arena *scratch);

/* Displacements of the surface's points (3 * surface points, m) under load `load` of `size` m/s^2, with
 * large strains, until all but `tolerance` of the load is balanced; fails to converge after a limited
 * number of Newton steps. False if memory runs out or the build is cancelled. */
bool sbfi_level_solve_nonlinear(const sbfi_level_statics *statics, uint32_t load, double size,
    double tolerance, double *displacements, bool *converged, sbfi_progress progress, sbfi_arena *scratch);

/* The same for small strains under 1 m/s^2, to relative accuracy `fraction`. `*frequency` rad/s is
 * Rayleigh's quotient of the displacements: slightly above the lowest mode's, if the load excites that
 * mode. */
bool sbfi_level_solve_linear(const sbfi_level_statics *statics, sbfi_linear_statics *linear, uint32_t load,
    double fraction, double *displacements, double *frequency, sbfi_arena *scratch);

/* Displacements of the surface's points (3 x surface points, m) from the level's (3 x level points, m);
 * subtracts rigid motion for a free body. */
void sbfi_level_get_surface_displacements(
    const sbfi_level_statics *statics, const double *moved, double *displacements);

/* Mean displacement of the surface along the load, m. */
double sbfi_level_mean_displacement(
    const sbfi_level_statics *statics, uint32_t load, const double *displacements);

#endif
