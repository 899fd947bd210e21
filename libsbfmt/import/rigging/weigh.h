/* Ways to weigh the points of an input that have no weights yet. Those that need memory return
 * false where it runs out. */
#ifndef SBFI_WEIGH_H
#define SBFI_WEIGH_H

#include "import/rigging/rigging.h"

/* By name: objects that stand for a mesh of the rig which hangs on a bone. Names only say which object a node
 * stands for, never which bone it hangs on, because a section and a different bone may bear one name; where
 * the rig has no mesh, objects named as its bones are theirs. */
void sbfi_weigh_by_name(sbfi_rigging *r);
/* How far objects lie from the rig's meshes that they are named as, laid over the rig by that transform: the
 * sum of the distances of their middles, m. */
double sbfi_names_distance(const sbfi_rigging *r, const sbfi_matrix *to_asset);
/* By order of the caller: objects, or shells of them (pieces that share no point), that a bone is to move,
 * and only that. After those by name. IMPORT_PIN_UNKNOWN: there is no such object, shell or bone. */
sbf_status sbfi_weigh_shells(sbfi_rigging *r);
/* Skins that the input has itself, for bones of the same names. */
void sbfi_weigh_by_own_skin(sbfi_rigging *r);

/* By place: points that lie on points of the rig's meshes. `moved` is the input in asset space. */
bool sbfi_weigh_by_position(sbfi_rigging *r, const sbfi_scene_surface *moved);

/* By nearness: the other points, from the surface of the rig's meshes beside them. `*share` is that of all
 * points which then have weights; where it is below `least` the input is no mesh like the rig's, and nothing
 * changes. */
bool sbfi_weigh_by_nearness(sbfi_rigging *r, const sbfi_scene_surface *moved, double min, double *fraction);

/* From the bones alone (build/weights): the other points of objects that no node carries. */
sbf_status sbfi_weigh_by_bones(sbfi_rigging *r, const sbfi_scene_surface *moved);

/* From the file of --weights: an error says which line is wrong. */
sbf_status sbfi_weigh_by_file(sbfi_rigging *r, const char *path);

#endif
