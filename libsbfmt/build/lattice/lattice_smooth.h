/* Points of a lattice moved a little, so that no part of it swings much faster than the rest.
 *
 * An explicit scheme needs substeps as short as the fastest mode asks for, and that of a stuffed lattice is
 * the swinging of a few points whose tetrahedra the surface has cut thin: twice as fast as all others. What a
 * point swings at among neighbours that stand still is w^2 <= E (tr S + r |S|) / m, with S the sum of V g g^T
 * over its tetrahedra, g the gradient of its shape function, m their volume's quarter, |S| Frobenius' norm,
 * and r and E by the matter (r = 5 at Poisson's ratio of 0.4, which is taken here). Points around those where
 * that is greatest go down the gradient of the sum of its sixth powers, again and again, while the greatest
 * falls.
 *
 * That ends where all are below 8 over the cell, half as fast again as the grid cut flat along its own faces.
 *
 * What stays: which points a tetrahedron has; what is held; all points within 0.35 cells of where they were
 * stuffed, and those on the surface no farther in, and within 0.03 cells of the planes of their
 * faces there (root of the mean square, by area: along a flat part they glide, along an edge too, a corner
 * stays); and dihedral angles between 12.8 and 160 degrees, or what the tetrahedra around a point had that
 * was beyond. */
#ifndef SBFI_LATTICE_SMOOTH_H
#define SBFI_LATTICE_SMOOTH_H

#include "base/memory.h"
#include "build/lattice/lattice_stuffing.h"

/* `cell` m, of the grid; `held` (point_count) marks points that stay where they are and do not swing, NULL:
 * none. False where memory runs out. */
bool sbfi_lattice_smooth(sbfi_tetrahedra *made, double cell, const uint8_t *held, sbfi_arena *scratch);

#endif
