/* Connected pieces of a surface: points that share a polygon or a position are connected. */
#ifndef SBFI_SURFACE_PIECES_H
#define SBFI_SURFACE_PIECES_H

#include "import/rigging/rigging.h"

/* First point of the piece of each point. NULL if memory runs out. */
uint32_t *sbfi_surface_pieces(const sbfi_scene_surface *s, sbfi_arena *arena);

#endif
