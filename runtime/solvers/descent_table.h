/* What block descent goes by: the points of an island in colours, with the elements that each is an end of.
 */
#ifndef SBRI_DESCENT_TABLE_H
#define SBRI_DESCENT_TABLE_H

#include "model/runtime_model.h"

/* Eight points of which no two share an element. Inert lanes name the first one's slot and have no mass. */
typedef struct sbri_descent_block {
  uint32_t slots[SBRI_BLOCK];
  float masses[SBRI_BLOCK];          /* kg */
  uint32_t first_spring, spring_end; /* cells of one spring a lane */
  uint32_t first_corner, corner_end; /* blocks of one tetrahedron a lane, its corner 0 the point */
} sbri_descent_block;

typedef struct sbri_descent {
  const sbri_descent_block *blocks; /* (block_count) colour after colour */
  uint32_t block_count, colour_count;
  const sbri_spring_cell *springs;
  const float *damping; /* (cells of springs x 8) N s/m; NULL: no spring is damped */
  const float *slack;   /* (cells of springs x 8) as sbfi_spring's; NULL: no spring has any */
  const sbri_tetrahedron_block *corners;
} sbri_descent;

/* Of the island, whose tables are made; false where memory runs out. */
bool sbri_descent_make(sbr_model *model, sbri_island *island);

#endif
