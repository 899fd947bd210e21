/* Bind pose of a scene's skins. Files are often saved during an animation: then the nodes' transforms are
 * a frame of it, and the original shape is the bind pose. */
#ifndef SBFI_BIND_POSE_H
#define SBFI_BIND_POSE_H

#include "import/scene/scene.h"

/* Computes world matrices of all nodes (node_count) in the bind pose: a joint's from the first skin with
 * it, a bone above joints from its first child; their descendants move along, other nodes keep the rest
 * pose. Size, direction and position are those of the saved pose (bind_space.h). `*difference` is the
 * maximum difference from the rest pose: a bone's displacement as a fraction of the skeleton's size, or
 * the sine of its rotation; rounding is below 1e-4. False if memory runs out. */
bool sbfi_bind_worlds(const sbfi_scene *scene, sbfi_matrix *worlds, double *difference);

/* Makes the bind pose the rest pose of a scene that is not shared yet, if they differ, and adds a note.
 * Skinned meshes are then in their bind shape. Clips keep their motion: missing tracks get a key with the
 * node's saved value. `saved_worlds` keeps the pose of the file. False if memory runs out. */
bool sbfi_scene_apply_bind_pose(sbfi_scene *scene);

#endif
