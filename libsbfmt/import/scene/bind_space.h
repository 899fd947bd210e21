/* Where the space of each skinned mesh lay in the scene when its skin was bound.
 *
 * A skinned vertex is drawn at the sum of weight * joint's world * bind * vertex; the transform of the mesh's
 * own node is not in it (glTF 2.0, section 3.7.3.3). In the bind pose all these products of a joint's world
 * and its bind matrix are one matrix, the bind space: it decides the size, the direction and the position of
 * the character. A file states it only where the saved pose is the bind pose. */
#ifndef SBFI_BIND_SPACE_H
#define SBFI_BIND_SPACE_H

#include "import/scene/scene.h"

/* Fills spaces (mesh_count), mesh to scene: the bind space of a skinned mesh, the node's world otherwise.
 * Skins that share a joint agree about the joint's world. Linear in points, weights and joints. False where
 * memory runs out. */
bool sbfi_bind_spaces(const sbfi_scene *scene, sbfi_matrix *spaces);

#endif
