/* Which bones of a rig hold skin, and which only carry or aim others. */
#ifndef SBFI_BONE_ROLES_H
#define SBFI_BONE_ROLES_H

#include "build/weights/body_rays.h"

/* Sets `is_deforming` (in->bone_count) to in->is_deforming where the caller states it. Else every bone holds
 * skin but these: frames and controls by name (root, armature, master, pole, target, ...); leaves of a root
 * that lie outside the body, which aim limbs; leaves of a root in the place of another bone, which pull it;
 * roots with such leaves. */
void sbfi_bone_roles_find(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_rays *rays, bool *is_deforming);

#endif
