/* Methods that add weights to points without weights. Those that allocate return false if memory runs out. */
#ifndef SBFI_WEIGH_H
#define SBFI_WEIGH_H

#include "import/rigging/rigging.h"

/* By name: objects that have the name of a rig mesh on a bone. A name identifies the mesh node, not the
 * bone, because a section and a different bone may have equal names. If the rig has no mesh, objects named
 * after bones belong to them. */
void sbfi_weigh_by_name(sbfi_rigging *r);
/* Sum of the distances between the centres of objects and the rig's meshes of equal names under a
 * transform, m. */
double sbfi_names_distance(const sbfi_rigging *r, const sbfi_matrix *to_asset);
/* By the caller's request: objects, or shells of them (pieces that share no point), that exactly one bone
 * moves. Runs after the names. IMPORT_PIN_UNKNOWN if an object, shell or bone does not exist. */
sbf_status sbfi_weigh_shells(sbfi_rigging *r);
/* By the input's own skins, for bones with equal names. RIG_MISFIT if these are at other positions. */
sbf_status sbfi_weigh_by_own_skin(sbfi_rigging *r);
/* Node of the rig's bone of a name, or SBF_NONE. */
int32_t sbfi_find_bone_node(const sbfi_rigging *r, const char *name);

/* By position: points at points of the rig's meshes. `moved` is the input in asset space. */
bool sbfi_weigh_by_position(sbfi_rigging *r, const sbfi_scene_surface *moved);

/* By proximity: remaining points take weights of the nearby surface of the rig's meshes. `*fraction` is the
 * fraction of all points that then have weights. Below `min` the input is not similar to the rig's mesh,
 * and nothing changes. */
bool sbfi_weigh_by_nearness(sbfi_rigging *r, const sbfi_scene_surface *moved, double min, double *fraction);

/* From the bones alone (build/weights): remaining points of objects without a carrier node. */
sbf_status sbfi_weigh_by_bones(sbfi_rigging *r, const sbfi_scene_surface *moved);

/* From the file of --weights; errors name the line. */
sbf_status sbfi_weigh_by_file(sbfi_rigging *r, const char *path);

#endif
