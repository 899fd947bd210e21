/* A box filled with equal cells of six tetrahedra each around a diagonal (Kuhn's division), neighbours
 * mirrored. */
#ifndef TEST_LATTICE_BOX_H
#define TEST_LATTICE_BOX_H

#include "sbfmt/mechanics.h"

typedef struct lattice_box {
  uint32_t point_count, tetrahedron_count;
  sbf_vec3 *positions;   /* (point_count) x fastest, then y, then z; from the low corner on */
  sbf_uint4 *tetrahedra; /* (tetrahedron_count) positively oriented */
  float *masses;         /* (point_count) kg, a quarter of each tetrahedron's */
  float *young_modulus;  /* (tetrahedron_count) */
  float *poisson_ratios; /* (tetrahedron_count) */
  uint32_t cells[3];
} lattice_box;

/* `low` is the corner of the least coordinates. Free with lattice_box_free. */
lattice_box lattice_box_make(sbf_vec3 low, sbf_vec3 size, uint32_t nx, uint32_t ny, uint32_t nz,
    float density, float young_pa, float poisson);
void lattice_box_free(lattice_box *box);

/* Its points and tetrahedra, for sbfmt/mechanics.h; shares the box's lists. */
sbf_spring_network lattice_box_network(const lattice_box *box);

uint32_t lattice_box_point(const lattice_box *box, uint32_t x, uint32_t y, uint32_t z);
/* Holds the points of the side x = 0: their masses become 0. */
void lattice_box_hold(lattice_box *box);

#endif
