/* Connects separate parts of a body's cells. */
#ifndef SBFI_BODY_BRIDGES_H
#define SBFI_BODY_BRIDGES_H

#include "build/weights/body_grid.h"

/* Adds the minimum set of bridges, shortest first, that connects all cells. False if memory runs out. */
bool sbfi_body_bridges_make(sbfi_body_grid *grid, sbfi_arena *arena);

#endif
