#include "pose_driver.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "method_table.h"
#include "sbrun/animation.h"
#include "turns.h"

/* Rate in 1/s at which a bone turns to its point, and the largest turn from its animated pose, rad. */
static const float AIM_RATE = 8, AIM_LIMIT = 1.2f;

pose_driver *pose_driver_of(soft_character *one) {
  if (one->pose_driver) return one->pose_driver;
  one->pose_driver = calloc(1, sizeof *one->pose_driver);
  if (!one->pose_driver) return gd_error("no memory for a character's pose"), NULL;
  one->pose_driver->path = gd_empty(GDEXTENSION_VARIANT_TYPE_NODE_PATH);
  one->pose_driver->weight = 1;
  one->pose_driver->sent_weight = -1;
  return one->pose_driver;
}

void pose_driver_clear(soft_character *one) {
  if (!one->pose_driver) return;
  free(one->pose_driver->bones);
  one->pose_driver->bones = NULL;
  one->pose_driver->skeleton = 0;
  one->pose_driver->sent_weight = -1;
}

void pose_driver_free(soft_character *one) {
  if (!one->pose_driver) return;
  pose_driver_clear(one);
  gd_free(&one->pose_driver->path);
  free(one->pose_driver);
  one->pose_driver = NULL;
}

static bool has_path(const pose_driver *pose) {
  return !gd_take_bool(GD_CALL(&pose->path, "is_empty"));
}

bool pose_driver_is_used(const soft_character *one) {
  return one->pose_driver && !one->is_in_editor &&
         (one->pose_driver->aim_count || has_path(one->pose_driver));
}

/* ---- Another skeleton ---- */

/* Frame of a bone in its parent's, at rest, without scale. */
static sbr_transform rest_of(const sbf_asset *asset, uint32_t bone) {
  const sbf_bone *of = &asset->bones.at[bone];
  if (of->parent < 0) return (sbr_transform){of->head, of->rotation};
  const sbf_bone *parent = &asset->bones.at[of->parent];
  sbf_quat back = turn_back(parent->rotation);
  sbf_vec3 arm = {of->head.x - parent->head.x, of->head.y - parent->head.y, of->head.z - parent->head.z};
  return (sbr_transform){turned(back, arm), turn_product(back, of->rotation)};
}

/* Finds the bones of the same names; false where there is no skeleton. */
static bool find_bones(soft_character *one, const gd_variant *skeleton) {
  pose_driver *pose = one->pose_driver;
  const sbf_bone_list *bones = &one->model->asset->bones;
  uint64_t id = gd.object_get_instance_id(gd_as_object(skeleton));
  if (pose->skeleton == id && pose->bones) return true;
  uint32_t found = 0;
  free(pose->bones);
  pose->bones = malloc((bones->count + 1) * sizeof *pose->bones);
  pose->skeleton = id;
  if (!pose->bones) return gd_error("no memory for a character's pose"), false;
  for (uint32_t i = 0; i < bones->count; i++) {
    const char *name = bones->at[i].name[0] ? bones->at[i].name : bones->at[i].id;
    pose->bones[i] = (int32_t)gd_take_int(GD_CALL(skeleton, "find_bone", gd_string(name)));
    if (pose->bones[i] < 0) { /* Godot's importers write others for . : and / */
      gd_variant text = gd_string(name), valid = GD_CALL(&text, "validate_node_name");
      pose->bones[i] = (int32_t)gd_take_int(GD_CALL(skeleton, "find_bone", gd_copy(&valid)));
      gd_free(&text);
      gd_free(&valid);
    }
    found += pose->bones[i] >= 0;
  }
  if (!found)
    soft_character_error(one, "pose_source: no bone of that Skeleton3D has the name of a bone of the asset");
  return true;
}

static gd_transform taken_transform(gd_variant value) {
  gd_transform read = gd_as_transform(&value);
  gd_free(&value);
  return read;
}

/* What turned and moved the bone away from its rest in the source does so here. */
static void copy_bone(soft_character *one, const gd_variant *skeleton, uint32_t bone, pose_key *key) {
  int32_t source = one->pose_driver->bones[bone];
  gd_transform rest = taken_transform(GD_CALL(skeleton, "get_bone_rest", gd_int(source)));
  gd_transform pose = taken_transform(GD_CALL(skeleton, "get_bone_pose", gd_int(source)));
  sbr_transform mine = rest_of(one->model->asset, bone);
  if (!transform_unscale(&rest) || !transform_unscale(&pose)) return;
  sbf_vec3 moved = {
      pose.origin.x - rest.origin.x, pose.origin.y - rest.origin.y, pose.origin.z - rest.origin.z};
  key->rotation =
      turn_product(mine.rotation, turn_product(turn_back(turn_of(rest.basis)), turn_of(pose.basis)));
  key->translation =
      (sbf_vec3){mine.position.x + moved.x, mine.position.y + moved.y, mine.position.z + moved.z};
}

static void copy_skeleton(soft_character *one, pose_clip *clip) {
  pose_driver *pose = one->pose_driver;
  gd_variant skeleton = GD_CALL(&one->node, "get_node_or_null", gd_copy(&pose->path));
  bool good =
      gd_as_object(&skeleton) && gd_take_bool(GD_CALL(&skeleton, "is_class", gd_string("Skeleton3D")));
  if (!good && !pose->warned)
    soft_character_error(
        one, "pose_source is not a Skeleton3D or does not exist: bones use their own animation");
  pose->warned = !good;
  if (!good) pose_driver_clear(one);
  if (good && find_bones(one, &skeleton))
    for (uint32_t i = 0; i < one->model->asset->bones.count; i++)
      if (pose->bones[i] >= 0) {
        copy_bone(one, &skeleton, i, &clip->keys[i]);
        pose_clip_enable(clip, i, true);
      }
  gd_free(&skeleton);
}

/* ---- Looking at a point ---- */

static float dot4(sbf_quat a, sbf_quat b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

static sbf_quat blended(sbf_quat a, sbf_quat b, float t) {
  float s = dot4(a, b) < 0 ? -t : t, u = 1 - t;
  sbf_quat q = {u * a.x + s * b.x, u * a.y + s * b.y, u * a.z + s * b.z, u * a.w + s * b.w};
  float length = sqrtf(dot4(q, q));
  return (sbf_quat){q.x / length, q.y / length, q.z / length, q.w / length};
}

/* The shortest turn from one direction to another (any lengths), at most AIM_LIMIT. */
static sbf_quat turn_between(sbf_vec3 from, sbf_vec3 to) {
  sbf_vec3 axis = turn_cross(from, to);
  float sine = sqrtf(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  float angle = fminf(atan2f(sine, from.x * to.x + from.y * to.y + from.z * to.z), AIM_LIMIT);
  if (!(sine > 0)) return (sbf_quat){0, 0, 0, 1};
  float s = sinf(angle / 2) / sine;
  return (sbf_quat){s * axis.x, s * axis.y, s * axis.z, cosf(angle / 2)};
}

static void apply_aim(
    soft_character *one, pose_clip *clip, pose_aim *aim, const sbr_transform *bones, float frame_s) {
  const sbf_asset *asset = one->model->asset;
  const sbf_bone *bone = &asset->bones.at[aim->bone];
  pose_key *key = &clip->keys[aim->bone];
  sbr_transform rest = rest_of(asset, (uint32_t)aim->bone);
  float heading = transform_heading(&one->placement.shown_at);
  bool has_key = clip->tracks[2 * aim->bone].times.count > 0;
  if (!has_key) key->rotation = rest.rotation, key->translation = rest.position;
  sbf_quat parent = bone->parent >= 0 ? bones[bone->parent].rotation
                                      : (sbf_quat){0, sinf(heading / 2), 0, cosf(heading / 2)};
  sbf_quat animated = turn_product(parent, key->rotation);
  sbr_double3 o = sbr_character_get_origin(one->world, one->id);
  sbf_vec3 at = bones[aim->bone].position;
  sbf_vec3 to = {(float)((double)aim->point.x - o.x) - at.x, (float)((double)aim->point.y - o.y) - at.y,
      (float)((double)aim->point.z - o.z) - at.z};
  sbf_vec3 front = turned(animated, turned(turn_back(bone->rotation), (sbf_vec3){0, 0, 1}));
  sbf_quat none = {0, 0, 0, 1},
           wanted = aim->ends ? none : blended(none, turn_between(front, to), aim->weight);
  aim->turn = blended(aim->turn, wanted, 1 - expf(-AIM_RATE * frame_s));
  key->rotation = turn_product(turn_back(parent), turn_product(aim->turn, animated));
  pose_clip_enable(clip, (uint32_t)aim->bone, true);
}

static void apply_aims(soft_character *one, pose_clip *clip, float frame_s) {
  pose_driver *pose = one->pose_driver;
  uint32_t count = one->model->asset->bones.count;
  sbr_transform *bones = pose->aim_count ? malloc((count + 1) * sizeof *bones) : NULL;
  if (!bones) return;
  sbr_character_get_bones(one->world, one->id, bones, count);
  for (uint32_t i = 0; i < pose->aim_count; i++) {
    pose_aim *aim = &pose->aims[i];
    if (aim->bone < (int32_t)count) apply_aim(one, clip, aim, bones, frame_s);
    if (aim->ends && fabsf(aim->turn.w) > 0.99999f) pose->aims[i--] = pose->aims[--pose->aim_count];
  }
  free(bones);
}

/* ---- A frame ---- */

void pose_driver_prepare(soft_character *one, float frame_s) {
  pose_clip *clip = one->model ? soft_model_pose(one->model) : NULL;
  if (!one->pose_driver || !clip || one->placement.is_still) return;
  uint32_t count = one->model->asset->bones.count;
  for (uint32_t i = 0; i < count; i++) pose_clip_enable(clip, i, false);
  bool has_skeleton = has_path(one->pose_driver);
  if (has_skeleton) copy_skeleton(one, clip);
  apply_aims(one, clip, frame_s);
  double weight = has_skeleton ? one->pose_driver->weight : 1;
  if (!pose_clip_changes(clip) && weight == one->pose_driver->sent_weight) return; /* it may sleep */
  sbr_clip_play how = sbr_default_clip_play();
  how.weight = (float)(one->pose_driver->sent_weight = weight);
  sbr_character_play_clip(one->world, one->id, POSE_LAYER, clip->clip, &how);
}

/* ---- For scripts ---- */

CALL(set_aim) {
  soft_character *one = self;
  sbf_vec3 point = gd_as_vector3(arguments[1]);
  double weight = gd_type(arguments[2]) == GDEXTENSION_VARIANT_TYPE_NIL ? 1 : gd_as_float(arguments[2]);
  UNUSED;
  int32_t bone = soft_character_bone(one, arguments[0]);
  if (!one->world || !soft_character_fits(one, "set_look_target: weight", weight, 0, 1)) return;
  if (bone < 0) {
    soft_character_error(one, "set_look_target: the asset has no such bone: see SoftAsset.get_bone_names");
    return;
  }
  if (!isfinite(point.x + point.y + point.z)) {
    soft_character_error(one, "set_look_target: the point is not finite; it stays as it was");
    return;
  }
  pose_driver *pose = pose_driver_of(one);
  if (!pose) return;
  bool was_used = pose_driver_is_used(one);
  uint32_t i = 0;
  while (i < pose->aim_count && pose->aims[i].bone != bone) i++;
  if (i == POSE_AIMS) {
    soft_character_error(one, "set_look_target: 8 bones look at points already");
    return;
  }
  if (i == pose->aim_count) {
    pose->aim_count++;
    pose->aims[i] = (pose_aim){.bone = bone, .turn = {0, 0, 0, 1}};
  }
  pose->aims[i].point = point, pose->aims[i].weight = (float)weight, pose->aims[i].ends = false;
  if (!was_used && !soft_model_pose(one->model)) soft_character_make(one);
}

CALL(clear_aim) {
  soft_character *one = self;
  int32_t bone = soft_character_bone(one, arguments[0]);
  UNUSED;
  for (uint32_t i = 0; one->pose_driver && i < one->pose_driver->aim_count; i++)
    if (one->pose_driver->aims[i].bone == bone) one->pose_driver->aims[i].ends = true;
}

const gd_method soft_character_pose_methods[] = {
    {"set_look_target", set_aim, NOTHING, 3,
        {WITH("bone", STRING), WITH("point", VECTOR3), WITH("weight", NIL)}},
    {"clear_look_target", clear_aim, NOTHING, 1, {WITH("bone", STRING)}},
    {0},
};
