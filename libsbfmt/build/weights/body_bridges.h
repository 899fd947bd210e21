/* Joins the cells of a body that do not hang together. */
#ifndef SBFI_BODY_BRIDGES_H
#define SBFI_BODY_BRIDGES_H

#include "build/weights/body_grid.h"

/* Adds the fewest bridges, the shortest first, that make one of all cells. False where memory runs out. */
bool sbfi_body_bridges_make(sbfi_body_grid *grid, sbfi_arena *arena);

#endif
