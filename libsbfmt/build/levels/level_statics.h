/* How a level gives under loads, seen at its body's surface: what levels of one body are compared by.
 *
 * A body that something holds is loaded with a gravity along each of the three axes. One that nothing holds
 * is bent: with the acceleration e_i q_j^2, i and j different axes, q_j the place along j from the middle in
 * half extents, less the rigid motion in it, so that forces and moments sum to nothing; what of the answer is
 * rigid is left out as well. Held are the points of kinematic pins; goal springs pull. */
#ifndef SBFI_LEVEL_STATICS_H
#define SBFI_LEVEL_STATICS_H

#include "build/embed/carrier.h"
#include "mechanics/static_solve.h"

enum { SBFI_HELD_LOADS = 3, SBFI_FREE_LOADS = 6, SBFI_MOST_LOADS = 6 };

typedef struct sbfi_level_statics {
  const sbf_soft_body *body;
  const sbf_level *level;
  sbf_spring_network network;
  bool held;
  uint32_t load_count;
  sbfi_carried *carried; /* (surface points) */
  float *areas;          /* (surface points) m^2, their tributary areas, that means go by */
  double size;           /* m, diagonal of the surface's box */
  double low[3], high[3];
  double mass; /* kg, of what is free */
} sbfi_level_statics;

/* `interior` as for a carrier; may be NULL. Everything but body and level is memory of `arena`. False where
 * memory runs out. */
bool sbfi_level_statics_make(sbfi_level_statics *statics, const sbf_soft_body *body, const sbf_level *level,
    const sbfi_interior_map *interior, sbfi_arena *arena);

/* How a level came to rest. */
typedef struct sbfi_rest {
  bool converged;
  double frequency; /* rad/s, Rayleigh's quotient of the displacements: little above the lowest mode's, where
                       the load is one that the mode gives to; it means something for small loads */
} sbfi_rest;

/* Displacements of the surface's points (3 * surface points, m) under load number `load` of `size` m/s^2;
 * with large strains as they are, until all but `tolerance` of the load is balanced. False where memory runs
 * out. */
bool sbfi_level_give(const sbfi_level_statics *statics, uint32_t load, double size, double tolerance,
    double *displacements, sbfi_rest *rest, sbfi_arena *scratch);

/* Mean over the surface of what it gives along the load, m. */
double sbfi_level_yielding(const sbfi_level_statics *statics, uint32_t load, const double *displacements);

/* The frequency of the lowest mode from above, rad/s; 0: none. */
double sbfi_level_lowest(const sbfi_level_statics *statics, sbfi_arena *scratch);

/* Substeps that a control tick of `tick` s takes explicitly, times springs and tetrahedra. */
double sbfi_level_cost(const sbfi_level_statics *statics, double tick, sbfi_arena *scratch);

#endif
