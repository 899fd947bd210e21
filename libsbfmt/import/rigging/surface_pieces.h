/* Pieces of a surface: points that share a polygon, and points in one place, hang together. */
#ifndef SBFI_SURFACE_PIECES_H
#define SBFI_SURFACE_PIECES_H

#include "import/rigging/rigging.h"

/* Of each point the first of its piece. NULL where memory runs out. */
uint32_t *sbfi_surface_pieces(const sbfi_scene_surface *s, sbfi_arena *arena);

#endif
