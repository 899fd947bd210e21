/* Solid test bodies for schemes and meshes: a bar, a sphere, a figure; filled by the library's own build. */
#ifndef CHART_MADE_BODIES_H
#define CHART_MADE_BODIES_H

#include "sbfmt/build.h"

typedef struct chart_matter {
  float density, young_modulus, poisson_ratio, damping_ratio;
} chart_matter;

/* Surfaces only; NULL if memory runs out. */

/* 1 x 0.2 x 0.2 m along x from the origin, in squares of 5 cm, pinned to the world at x = 0. */
sbf_asset *chart_bar(const chart_matter *matter);
/* A sphere of that radius about the origin. */
sbf_asset *chart_ball(float radius_m, const chart_matter *matter);
/* Six overlapping ellipsoids (trunk, head, arms, legs), 1 m tall, pinned to the world in its head. */
sbf_asset *chart_figure(const chart_matter *matter);

/* Fills it with about this many tetrahedra, or regions on such a lattice, or springs of about this length;
 * frees `surface`. */
typedef struct chart_filling {
  sbf_build_interior interior;
  uint32_t elements;
  double spring_m;
  bool calibrated;
} chart_filling;
sbf_status chart_fill(
    sbf_asset *surface, const chart_filling *filling, sbf_asset **filled, sbf_diagnostic *error);

#endif
