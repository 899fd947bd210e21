/* A body's level of tetrahedra. */
#ifndef SBFI_LATTICE_LEVEL_H
#define SBFI_LATTICE_LEVEL_H

#include "build/lattice/lattice.h"
#include "build/lattice/lattice_thin.h"
#include "sbfmt/asset.h"
#include "sbfmt/mechanics.h"

/* Default numbers of elements: of one body with many thin parts, and of all bodies of a file. */
enum { SBFI_LATTICE_THIN_ELEMENTS = 4000, SBFI_LATTICE_SHARED_ELEMENTS = 16000 };

typedef struct sbfi_lattice_recipe {
  double cell;       /* m; 0: by `elements` */
  uint32_t elements; /* approximate number of tetrahedra; 0: 2000, or more if much of the body is thin */
  uint32_t max;      /* maximum of the automatic number; 0: SBFI_LATTICE_THIN_ELEMENTS */
  int32_t derivation;
  double tolerance; /* relative tolerance of their number; 0: SBFI_LATTICE_TOLERANCE, or a tenth if `max`
                     * reduces the usual number */
} sbfi_lattice_recipe;

/* Counts of one body. */
typedef struct sbfi_lattice_counts {
  uint32_t tetrahedra, points, pins;
  uint32_t thickened; /* nodes added to keep thin limbs, see lattice_limbs.h */
  sbf_lattice_measures quality;
  sbfi_thinness thinness; /* relative to one cell, which contains two elements */
} sbfi_lattice_counts;

/* Fills `*level` for a body that has polygons. Points: those of the lattice; none is the body's own.
 * Tetrahedra: their rest shape is the points' positions; they have the body's modulus, and its density,
 * scaled by one factor so that the mass is that of the volume inside a closed surface. Pins: see
 * lattice_pins.h. Masses follow from sbf_level_masses. If the lattice has no tetrahedra, the level has no
 * points. `asset` owns the lists. */
sbfi_lattice_outcome sbfi_lattice_level_make(sbf_level *level, const sbf_soft_body *body,
    const sbfi_lattice_recipe *recipe, sbf_asset *asset, sbfi_lattice_counts *counts, sbfi_progress progress,
    sbfi_arena *scratch);

#endif
