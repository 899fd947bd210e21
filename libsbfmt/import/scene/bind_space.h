/* Bind space of each skinned mesh: its space in the scene when its skin was bound.
 *
 * A skinned vertex is drawn at the sum of weight * joint's world * bind * vertex; the transform of the
 * mesh's own node is ignored (glTF 2.0, section 3.7.3.3). In the bind pose the products of a joint's world
 * and its bind matrix are equal for all joints: this is the bind space. It defines the size, direction and
 * position of the character. A file states it only if the saved pose is the bind pose. */
#ifndef SBFI_BIND_SPACE_H
#define SBFI_BIND_SPACE_H

#include "import/scene/scene.h"

/* Fills spaces (mesh_count), mesh to scene: the bind space of a skinned mesh, otherwise the node's world.
 * Skins that share a joint give it the same world. Linear in points, weights and joints. False if memory
 * runs out. */
bool sbfi_bind_spaces(const sbfi_scene *scene, sbfi_matrix *spaces);

#endif
