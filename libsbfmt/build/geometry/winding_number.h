/* Winding number of a surface about a point: 1 inside, 0 outside, in between near a hole.
 *
 * The generalized winding number of a triangle soup (Jacobson, Kavan, Sorkine-Hornung 2013) is the sum of the
 * solid angles of its triangles over 4 pi. Distant groups of triangles count as one dipole each, the sum of
 * their area vectors at their centroid (Barill, Dickson, Schmidt, Levin, Jacobson 2018), if the distance
 * exceeds twice the group's radius, with an error of about 1e-2. Angles use only square roots, so that every
 * machine gives the same bits.
 *
 * With caps on its holes (soup.h) a surface is closed, and its winding number is an integer: rounding is
 * enough, and it is constant in regions without triangles. The caps' part comes from the caps alone, which
 * are few, and is almost 0 far from them.
 *
 * A soup with many caps whose triangles are long, such as random ones, encloses nothing: there the distance
 * is so much smaller that a query visits at most some 128 triangles on average, whatever their number. */
#ifndef SBFI_WINDING_NUMBER_H
#define SBFI_WINDING_NUMBER_H

#include "build/geometry/soup.h"

typedef struct sbfi_winding_node {
  sbfi_d3 middle, area;  /* dipole: area vector at the centroid */
  double far2;           /* m^2, squared distance beyond which the dipole is used */
  uint32_t first, count; /* as in a box tree: leaf triangles, or (count 0) the left of two children */
} sbfi_winding_node;

/* A tree over some of a soup's triangles. */
typedef struct sbfi_winding_tree {
  sbfi_winding_node *nodes;
  uint32_t *triangles; /* of the leaves */
  uint32_t node_count;
  bool is_rough; /* dipoles are used at less than twice the radius, and nothing outside the bounds */
} sbfi_winding_tree;

typedef struct sbfi_winding {
  const sbfi_soup *soup;
  sbfi_winding_tree closed; /* surface and caps */
  sbfi_winding_tree caps;
} sbfi_winding;

/* `soup` must outlive it. Allocates from `arena`; false if memory runs out. */
bool sbfi_winding_make(sbfi_winding *winding, const sbfi_soup *soup, sbfi_arena *arena);

/* Winding number of surface and caps, an integer; of the caps only. The surface's own is the difference. */
int sbfi_winding_of_closed(const sbfi_winding *winding, sbfi_d3 point);
double sbfi_winding_of_caps(const sbfi_winding *winding, sbfi_d3 point);

/* Whether a point with these two numbers counts as inside: nearer to 1, or -1 for a surface that faces
 * inwards, than to 0. */
bool sbfi_winding_inside(int closed, double caps);

#endif
