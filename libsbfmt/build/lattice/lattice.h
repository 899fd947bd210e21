/* Tetrahedral lattice of the inside of any surface. */
#ifndef SBFI_LATTICE_H
#define SBFI_LATTICE_H

#include "base/progress.h"
#include "build/geometry/winding_number.h"
#include "build/lattice/lattice_stuffing.h"

#define SBFI_LATTICE_TOLERANCE 0.03

typedef struct sbfi_lattice {
  sbfi_tetrahedra made;
  double cell;           /* m, edge of the grid's cubes, the long edge of its tetrahedra */
  uint32_t forced_count; /* nodes added to keep thin limbs, see lattice_limbs.h and lattice_hinges.h */
  uint32_t dim_count;    /* edges with different ends that no triangle cuts: holes of an open surface */
} sbfi_lattice;

typedef enum sbfi_lattice_outcome {
  SBFI_LATTICE_MADE, /* possibly without tetrahedra, if the surface encloses nothing at this cell */
  SBFI_LATTICE_TOO_FINE,
  SBFI_LATTICE_NO_MEMORY,
  SBFI_LATTICE_CANCELLED
} sbfi_lattice_outcome;

/* Fills `*lattice` for a cell of `cell` metres. Uses memory of `arena`, also as scratch. */
sbfi_lattice_outcome sbfi_lattice_make(sbfi_lattice *lattice, const sbfi_winding *winding, double cell,
    sbfi_progress progress, sbfi_arena *arena);

/* The same with about the requested number of tetrahedra: adapts the cell until their number is off by a
 * factor below 1 + `tolerance`, usually SBFI_LATTICE_TOLERANCE, for at most eight rounds, of which the best
 * counts. A larger tolerance also improves the first guess: most then need one round. */
sbfi_lattice_outcome sbfi_lattice_make_count(sbfi_lattice *lattice, const sbfi_winding *winding,
    uint32_t elements, double tolerance, sbfi_progress progress, sbfi_arena *arena);

#endif
