/* The pose in which a scene's skins were bound. Files are often saved in the middle of an animation: then the
 * nodes' own transforms are a frame of it, and the shape the artist made is the bind pose. */
#ifndef SBFI_BIND_POSE_H
#define SBFI_BIND_POSE_H

#include "import/scene.h"

/* Worlds of all nodes (node_count) in the bind pose: a joint's from the first skin that has it, a bone above
 * joints from what hangs on it, everything below moved along, the rest as at rest. Returns how far a node
 * lies from its rest position at most, in units of the file: about 0 where the file was saved at rest. */
double sbfi_bind_worlds(const sbfi_scene *scene, sbfi_matrix *worlds);

/* Where a mesh stands in the bind pose: its points times this are in scene space. A skinned mesh stands where
 * its own node does at rest, whatever that node hangs on; any other moves with its node. */
sbfi_matrix sbfi_bind_placement(
    const sbfi_scene *scene, const sbfi_scene_mesh *mesh, const sbfi_matrix *bind_worlds);

#endif
