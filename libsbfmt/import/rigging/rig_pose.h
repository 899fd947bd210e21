/* The rig's meshes in another pose than the bind pose. Other programs write an OBJ of a rigged file in its
 * saved pose or at a time of a clip. A pose is given by the `worlds` of the rig's nodes, node to scene. */
#ifndef SBFI_RIG_POSE_H
#define SBFI_RIG_POSE_H

#include "import/rigging/rigging.h"

/* Positions of the rig's surface points in a pose, in asset space. `motions` (nodes) is scratch. */
void sbfi_pose_positions(
    const sbfi_rigging *r, const sbfi_matrix *worlds, sbfi_matrix *motions, sbf_vec3 *positions);

/* The rig's surface in a pose. False if memory runs out. */
bool sbfi_pose_surface(const sbfi_rigging *r, const sbfi_matrix *worlds, sbfi_scene_surface *posed);

/* Maps points, normals and shape deltas of an input mesh from the alignment's pose back to the bind pose,
 * by each point's weights or by the node of the mesh. `to_asset` transforms the mesh's own space. False if
 * memory runs out. */
bool sbfi_pose_undo(const sbfi_rigging *r, uint32_t mesh, const sbfi_matrix *to_asset, sbfi_scene_mesh *to);

#endif
