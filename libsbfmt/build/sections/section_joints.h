/* What holds the rigid bodies of sections together. */
#ifndef SBFI_SECTION_JOINTS_H
#define SBFI_SECTION_JOINTS_H

#include "model/unique_id.h"
#include "sbfmt/asset.h"

/* The frame of a joint at the bone's head, local to the rigid body: +X, the twist axis, is the bone's +Y, +Y
 * its +Z, +Z its +X. */
sbf_frame sbfi_bone_joint_frame(const sbf_bone *bone, const sbf_rigid_body *body);

/* Adds for each section that a build has cut a spherical joint at the head of its bone, between the first
 * rigid body of the bone and that of the nearest bone above it which has one; none where a joint of the
 * source holds that body already. Without limits, and so proposed. False where memory runs out. */
bool sbfi_section_joints_make(sbf_asset *asset, int32_t derivation, sbfi_ids *ids, sbfi_arena *scratch);

#endif
