/* Joins pieces of one object of the rig, for programs that split objects by material. */
#ifndef SBFI_JOIN_PIECES_H
#define SBFI_JOIN_PIECES_H

#include "import/rigging/rigging.h"

/* Joins meshes of an OBJ that represent the same unskinned mesh of the rig: those that match it point by
 * point, and those that share a border. `meshes` (`*count`) are the input's in order. The first joined
 * mesh receives all pieces, under the name of the rig's object, with coincident points merged; the others
 * are removed. `nodes` are those of `meshes`. Allocates from the conversion's scratch; false if memory
 * runs out. */
bool sbfi_join_pieces(
    const sbfi_rigging *r, sbfi_scene_node *nodes, sbfi_scene_mesh *meshes, uint32_t *count);

#endif
