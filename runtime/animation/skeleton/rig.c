#include "animation/skeleton/rig.h"

#include "math/quat.h"

sbf_quat sbri_bone_facing(sbf_vec3 along, sbf_vec3 side) {
  sbf_vec3 y = sbri_normalize(along, sbri_vec3(0, 1, 0));
  sbf_vec3 x = sbri_normalize(sbri_add_scaled(side, y, -sbri_dot(side, y)), sbri_vec3(1, 0, 0));
  return sbri_quat_from_axes(x, y, sbri_cross(x, y));
}

void sbri_rig_rotate_bone(const sbri_rig *rig, uint32_t bone, sbf_quat rotation, sbr_transform *pose) {
  sbf_vec3 pivot = pose[bone].position;
  for (uint32_t k = rig->bones.subtree_begin[bone]; k < rig->bones.subtree_end[bone]; k++) {
    sbr_transform *b = &pose[rig->bones.subtree[k]];
    b->position = sbri_add(pivot, sbri_rotate(rotation, sbri_sub(b->position, pivot)));
    b->rotation = sbri_quat_normalize(sbri_quat_multiply(rotation, b->rotation));
  }
}

void sbri_rig_shift(const sbri_rig *rig, uint32_t bone, sbf_vec3 by, sbr_transform *pose) {
  for (uint32_t k = rig->bones.subtree_begin[bone]; k < rig->bones.subtree_end[bone]; k++) {
    sbr_transform *b = &pose[rig->bones.subtree[k]];
    b->position = sbri_add(b->position, by);
  }
}
