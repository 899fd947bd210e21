/* Joints between rigid bodies of sections. */
#ifndef SBFI_SECTION_JOINTS_H
#define SBFI_SECTION_JOINTS_H

#include "model/unique_id.h"
#include "sbfmt/asset.h"

/* Frame of a joint at the bone's head, local to the rigid body: its +X (twist axis), +Y and +Z are the
 * bone's +Y, +Z and +X. */
sbf_frame sbfi_bone_joint_frame(const sbf_bone *bone, const sbf_rigid_body *body);

/* Adds a spherical joint at the head of the bone of each cut section, between the bone's first rigid body and
 * that of the nearest ancestor with one; none if that body already has an authored joint. The joints have no
 * limits and are marked as proposed. False if memory runs out. */
bool sbfi_section_joints_make(sbf_asset *asset, int32_t derivation, sbfi_ids *ids, sbfi_arena *scratch);

#endif
