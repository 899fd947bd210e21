/* Tables of block descent: the points of an island by colour, with the elements of each. */
#ifndef SBRI_DESCENT_TABLE_H
#define SBRI_DESCENT_TABLE_H

#include "model/runtime_model.h"

/* Eight points of which no two share an element. Unused lanes hold the slot of the first one and have no
 * mass. */
typedef struct sbri_descent_block {
  uint32_t slots[SBRI_BLOCK];
  float masses[SBRI_BLOCK];          /* kg */
  uint32_t first_spring, spring_end; /* cells with one spring per lane */
  uint32_t first_corner, corner_end; /* blocks with one tetrahedron per lane, whose corner 0 is the point */
} sbri_descent_block;

typedef struct sbri_descent {
  const sbri_descent_block *blocks; /* (block_count) sorted by colour */
  uint32_t block_count, colour_count;
  const sbri_spring_cell *springs;
  const float *damping; /* (cells of springs x 8) N s/m; NULL: no spring has damping */
  const float *slack;   /* (cells of springs x 8) as in sbfi_spring; NULL: no spring has slack */
  const sbri_tetrahedron_block *corners;
} sbri_descent;

/* Call after the island's tables are built. Returns false if memory runs out. */
bool sbri_descent_make(sbr_model *model, sbri_island *island);

#endif
