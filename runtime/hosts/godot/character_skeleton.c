/* The bones as a Skeleton3D, for attachments and other nodes that use one. */
#include <stdlib.h>

#include "soft_character.h"
#include "turns.h"

/* Frame of a bone relative to its parent; without a parent, relative to the skeleton. */
static gd_transform local(const sbr_transform *bones, int32_t parent, uint32_t bone) {
  if (parent < 0) return placed_at(bones[bone].rotation, bones[bone].position);
  sbf_quat back = turn_back(bones[parent].rotation);
  sbf_vec3 a = bones[parent].position, b = bones[bone].position;
  return placed_at(
      turn_product(back, bones[bone].rotation), turned(back, (sbf_vec3){b.x - a.x, b.y - a.y, b.z - a.z}));
}

/* The node is kept when the character is recreated, because attachments refer to it. */
static void begin(soft_character *one) {
  if (gd_as_object(&one->skeleton)) {
    GD_DO(&one->skeleton, "clear_bones");
    return;
  }
  gd_assign(&one->skeleton, gd_new("Skeleton3D"));
  GD_DO(&one->skeleton, "set_name", gd_string("Skeleton3D"));
  GD_DO(&one->skeleton, "set_as_top_level", gd_bool(true));
  GD_DO(
      &one->node, "add_child", gd_copy(&one->skeleton), gd_bool(false), gd_int(1)); /* INTERNAL_MODE_FRONT */
}

void character_skeleton_make(soft_character *one) {
  const sbf_bone_list *list = &one->model->asset->bones;
  sbr_transform *rest = list->count ? malloc(list->count * sizeof *rest) : NULL;
  if (!one->settings.display.mirror_skeleton || !rest) {
    free(rest);
    character_skeleton_free(one);
    return;
  }
  begin(one);
  for (uint32_t i = 0; i < list->count; i++) {
    const sbf_bone *bone = &list->at[i];
    rest[i] = (sbr_transform){bone->head, bone->rotation};
    GD_DO(&one->skeleton, "add_bone", gd_string(bone->name[0] ? bone->name : bone->id));
    if (bone->parent >= 0) GD_DO(&one->skeleton, "set_bone_parent", gd_int(i), gd_int(bone->parent));
    GD_DO(&one->skeleton, "set_bone_rest", gd_int(i), gd_transform_value(local(rest, bone->parent, i)));
  }
  free(rest);
  character_skeleton_update(one);
}

void character_skeleton_free(soft_character *one) {
  if (gd_as_object(&one->skeleton)) GD_DO(&one->skeleton, "queue_free");
  gd_assign(&one->skeleton, gd_nil());
}

void character_skeleton_update(soft_character *one) {
  const sbf_bone_list *list = &one->model->asset->bones;
  sbr_transform *bones = gd_as_object(&one->skeleton) ? malloc((list->count + 1) * sizeof *bones) : NULL;
  if (!bones) return;
  sbr_double3 origin = sbr_character_get_origin(one->world, one->id);
  sbr_character_get_bones(one->world, one->id, bones, list->count);
  GD_DO(&one->skeleton, "set_position", /* at the top level: in world space */
      gd_vector3((sbf_vec3){(float)origin.x, (float)origin.y, (float)origin.z}));
  for (uint32_t i = 0; i < list->count; i++)
    GD_DO(
        &one->skeleton, "set_bone_pose", gd_int(i), gd_transform_value(local(bones, list->at[i].parent, i)));
  free(bones);
}
