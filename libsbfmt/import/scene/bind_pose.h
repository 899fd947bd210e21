/* The pose in which a scene's skins were bound. Files are often saved in the middle of an animation: then the
 * nodes' own transforms are a frame of it, and the shape the artist made is the bind pose. */
#ifndef SBFI_BIND_POSE_H
#define SBFI_BIND_POSE_H

#include "import/scene/scene.h"

/* Worlds of all nodes (node_count) in the bind pose: a joint's from the first skin that has it, a bone above
 * joints from what hangs on it, everything below moved along, the rest as at rest. Returns how far that is
 * from the rest pose at most: a bone's displacement as a share of the skeleton's size, or the sine of what it
 * has turned by; rounding alone stays below 1e-4. */
double sbfi_bind_worlds(const sbfi_scene *scene, sbfi_matrix *worlds);

/* Makes the bind pose the rest pose of a scene that is not its owner's to share yet, if it is another one,
 * and adds a note of it. Skinned meshes then stand where they were bound. Clips keep what they show: where a
 * track is missing, a key holds what the node was at rest. False where memory runs out. */
bool sbfi_scene_take_bind_pose(sbfi_scene *scene);

#endif
