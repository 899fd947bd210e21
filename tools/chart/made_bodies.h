/* Solid bodies, made to chart schemes and meshes by: a bar, a ball, a figure; filled by the library's own
 * build. */
#ifndef CHART_MADE_BODIES_H
#define CHART_MADE_BODIES_H

#include "sbfmt/build.h"

typedef struct chart_matter {
  float density, young_modulus, poisson_ratio, damping_ratio;
} chart_matter;

/* Surfaces alone; NULL where memory runs out. */

/* 1 x 0.2 x 0.2 m along x from the origin, in squares of 5 cm, held by the world at x = 0. */
sbf_asset *chart_bar(const chart_matter *matter);
/* Of that radius about the origin. */
sbf_asset *chart_ball(float radius_m, const chart_matter *matter);
/* Six ellipsoids that overlap (trunk, head, arms, legs), 1 m tall, held by the world in its head. */
sbf_asset *chart_figure(const chart_matter *matter);

/* Fills it with about so many tetrahedra, or the regions of such a lattice, or springs of about that length;
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
