/* The pose in which a scene's skins were bound. Files are often saved in the middle of an animation: then the
 * nodes' own transforms are a frame of it, and the shape the artist made is the bind pose. */
#ifndef SBFI_BIND_POSE_H
#define SBFI_BIND_POSE_H

#include "import/scene/scene.h"

/* Fills the worlds of all nodes (node_count) in the bind pose: a joint's from the first skin that has it, a
 * bone above joints from its first child, everything below moved along, the rest as at rest. Size, direction
 * and position are those of the saved pose (bind_space.h). `*difference` is how far that is from the rest
 * pose at most: a bone's displacement as a part of the skeleton's size, or the sine of its rotation; rounding
 * alone stays below 1e-4. False where memory runs out. */
bool sbfi_bind_worlds(const sbfi_scene *scene, sbfi_matrix *worlds, double *difference);

/* Makes the bind pose the rest pose of a scene that is not its owner's to share yet, if it is another one,
 * and adds a note of it. Skinned meshes then stand where they were bound. Clips keep what they show: where a
 * track is missing, a key holds what the node was at rest. `saved_worlds` keeps the pose of the file. False
 * where memory runs out. */
bool sbfi_scene_take_bind_pose(sbfi_scene *scene);

#endif
