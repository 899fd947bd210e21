/* Bodies that benchmarks make themselves, to measure solvers by. */
#ifndef BENCH_MEASURED_BODIES_H
#define BENCH_MEASURED_BODIES_H

#include "sbfmt/asset.h"

/* The hull of a box. */
sbf_polygon_mesh *box_hull(sbf_asset *asset, sbf_vec3 middle, sbf_vec3 size);

/* One rigid body that is simulated: a ball about the origin, as a hull of 98 corners and two poles. */
sbf_asset *ball_asset(float radius, float mass);

/* A sheet of side x side points, 1 cm apart, held at two corners: springs along its rows, its columns and one
 * diagonal. 200: 40,000 points, 119,201 springs. */
sbf_asset *cloth_of_springs(uint32_t side);

/* across x across x along cells, along +Z, held at its low end: springs along the edges and across each face.
 * 10, 50: 6171 points, 33,370 springs. `stiffness` in N/m, matter of 1000 kg/m3. */
sbf_asset *beam_of_springs(uint32_t across, uint32_t along, float cell_m, float stiffness);

/* The same points, each cell five tetrahedra whose edges are those springs. 10, 50: 25,000. */
sbf_asset *beam_of_tetrahedra(uint32_t across, uint32_t along, float cell_m, float young_modulus);

/* The reference armadillo, 1 m tall, of about so many tetrahedra of 0.1 MPa, nothing held. NULL where the
 * file is not there. */
sbf_asset *armadillo_of_tetrahedra(uint32_t elements);

/* 1 x 0.2 x 1 m of about so many tetrahedra of 0.1 MPa, nothing held, its surface of 12,696 points. */
sbf_asset *slab_of_tetrahedra(uint32_t elements);

/* Holds what of the first body is above this share of its height. */
void hold_above(sbf_asset *asset, double fraction);

/* The first body of `solid` with springs along the edges of its tetrahedra in their stead, as stiff as
 * springs without a stiffness of their own are. */
sbf_asset *springs_of_edges(const sbf_asset *solid);

#endif
