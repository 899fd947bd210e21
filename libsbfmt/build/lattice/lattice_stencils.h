/* Cuts of tetrahedra of the body-centred grid at a surface. */
#ifndef SBFI_LATTICE_STENCILS_H
#define SBFI_LATTICE_STENCILS_H

#include <stdint.h>

#include "mechanics/vector.h"

typedef enum sbfi_stencil_corner {
  SBFI_STENCIL_OUTSIDE,
  SBFI_STENCIL_INSIDE,
  SBFI_STENCIL_ON /* on the surface */
} sbfi_stencil_corner;

/* Four points: (i, i) is corner i, (i, j) the cut between corners i and j. Positive orientation in this
 * order. */
typedef struct sbfi_stencil_piece {
  uint8_t at[4][2];
} sbfi_stencil_piece;

enum { SBFI_STENCIL_MAX = 3 };

/* Cuts the tetrahedron whose edges 0-1 and 2-3 are long ones. At least one corner is inside and at least one
 * outside. `nodes` number the corners consistently in all tetrahedra; `positions` has those of corners and
 * cuts. Writes the pieces and returns their number.
 *
 * The diagonal of a quad on a face depends on the face alone, so that both neighbours agree: from the inner
 * corner on the cut short edge to the cut on the long one; if both cut edges are short, the shorter diagonal,
 * or for equal ones that from the lower node. */
int sbfi_stencil_apply(const sbfi_stencil_corner corners[4], const uint32_t nodes[4],
    const sbfi_d3 positions[4][4], sbfi_stencil_piece pieces[SBFI_STENCIL_MAX]);

#endif
