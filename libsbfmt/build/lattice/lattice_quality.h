/* How well tetrahedra are shaped: their dihedral angles. */
#ifndef SBFI_LATTICE_QUALITY_H
#define SBFI_LATTICE_QUALITY_H

#include "sbfmt/base.h"

enum { SBFI_DIHEDRAL_BINS = 18 }; /* of ten degrees */

typedef struct sbfi_lattice_quality {
  double volume;                          /* m^3, of all */
  double least_deg, most_deg;             /* dihedral angles; 180 and 0 where there is no tetrahedron */
  uint64_t histogram[SBFI_DIHEDRAL_BINS]; /* six angles a tetrahedron */
} sbfi_lattice_quality;

/* Adds tetrahedra to what was measured; begin with SBFI_LATTICE_QUALITY_NONE. */
#define SBFI_LATTICE_QUALITY_NONE ((sbfi_lattice_quality){.least_deg = 180})
void sbfi_dihedrals_measure(
    sbfi_lattice_quality *quality, const sbf_vec3 *positions, const sbf_uint4 *tetrahedra, uint32_t count);

#endif
