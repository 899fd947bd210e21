/* Determines which bones deform the skin, and which only move or control other bones. */
#ifndef SBFI_BONE_ROLES_H
#define SBFI_BONE_ROLES_H

#include "build/weights/body_rays.h"

/* Sets `is_deforming` (in->bone_count) to in->is_deforming if the caller provides it. Otherwise all bones
 * deform except: frames and controls by name (root, armature, master, pole, target, ...); children of a
 * root without children that are outside the body, which control limbs; those at the position of another
 * bone, which move it; roots with such children; end marks; smaller trees of bones with a joint at the
 * position of one of the largest tree's. If there is no mesh yet, `rays` is NULL, and `mesh` only provides
 * the scale of the bones. */
void sbfi_bone_roles_find(const sbfi_weights_input *in, const sbfi_weight_mesh *mesh,
    const sbfi_body_rays *rays, bool *is_deforming);

/* Whether a bone only marks the end of its parent, by its name. */
bool sbfi_bone_is_end(const sbfi_weights_input *in, uint32_t bone);

/* Whether a bone is a root or the child of one. */
bool sbfi_bone_is_on_root(const sbfi_weights_input *in, uint32_t bone);

#endif
