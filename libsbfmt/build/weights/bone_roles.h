/* Which bones of a rig hold skin, and which only carry or aim others. */
#ifndef SBFI_BONE_ROLES_H
#define SBFI_BONE_ROLES_H

#include "build/weights/body_rays.h"

/* Sets `is_deforming` (in->bone_count) to in->is_deforming where the caller states it. Else every bone holds
 * skin but these: frames and controls by name (root, armature, master, pole, target, ...); leaves of a root
 * that lie outside the body, which aim limbs; leaves of a root in the place of another bone, which pull it;
 * roots with such leaves; ends of bones; trees of bones beside the largest with a joint in
 * the place of one of its. Where no mesh lies around the bones yet, `rays` is NULL, and of `mesh` only the
 * scale is used: that of the bones. */
void sbfi_bone_roles_find(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_rays *rays, bool *is_deforming);

/* Whether a bone is a leaf that only marks where its parent ends, by its name. */
bool sbfi_bone_is_end(const sbfi_weights_input *in, uint32_t bone);

/* Whether a bone is a root or hangs on one. */
bool sbfi_bone_is_on_root(const sbfi_weights_input *in, uint32_t bone);

#endif
