/* The rig's meshes in another pose than the one that their skins were bound in: other programs write an OBJ
 * of a rigged file as it stands, in the pose that it was saved in or at a moment of a clip. A pose is the
 * `worlds` of the rig's nodes, node to scene. */
#ifndef SBFI_RIG_POSE_H
#define SBFI_RIG_POSE_H

#include "import/rigging/rigging.h"

/* Positions of the points of the rig's surface in that pose, in asset space. `motions` (nodes) is scratch. */
void sbfi_pose_positions(
    const sbfi_rigging *r, const sbfi_matrix *worlds, sbfi_matrix *motions, sbf_vec3 *positions);

/* The rig's surface in that pose. False where memory runs out. */
bool sbfi_pose_surface(const sbfi_rigging *r, const sbfi_matrix *worlds, sbfi_scene_surface *posed);

/* Takes points, normals and deltas of shapes of an input mesh, which stands in the alignment's pose, back to
 * the bind pose, each by its weights or by the node that carries the mesh. `to_asset` is that of the mesh's
 * own space. False where memory runs out. */
bool sbfi_pose_undo(const sbfi_rigging *r, uint32_t mesh, const sbfi_matrix *to_asset, sbfi_scene_mesh *to);

#endif
