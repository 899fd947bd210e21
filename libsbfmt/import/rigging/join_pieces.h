/* Pieces of one object of the rig, as programs write that cut objects by their materials. */
#ifndef SBFI_JOIN_PIECES_H
#define SBFI_JOIN_PIECES_H

#include "import/rigging/rigging.h"

/* Joins meshes of an OBJ that stand for the same mesh of the rig, which has no skin: those that lie on it
 * point by point, and those that share a border. `meshes` (`*count`) are the input's in its order; the first
 * of those that are joined becomes all of them, under the name of the rig's object, with one point where
 * theirs coincide, and the others go. `nodes` are those of `meshes`. Memory of the conversion's scratch;
 * false where it runs out. */
bool sbfi_join_pieces(
    const sbfi_rigging *r, sbfi_scene_node *nodes, sbfi_scene_mesh *meshes, uint32_t *count);

#endif
