/* Where a character is: its node goes with it, and it goes where its node is put. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "soft_character.h"

static sbf_vec3 turned(sbf_quat q, sbf_vec3 v) {
  sbf_vec3 t = {2 * (q.y * v.z - q.z * v.y), 2 * (q.z * v.x - q.x * v.z), 2 * (q.x * v.y - q.y * v.x)};
  return (sbf_vec3){v.x + q.w * t.x + (q.y * t.z - q.z * t.y), v.y + q.w * t.y + (q.z * t.x - q.x * t.z),
      v.z + q.w * t.z + (q.x * t.y - q.y * t.x)};
}

float transform_heading(const gd_transform *place) {
  return atan2f(place->basis[0][2], place->basis[2][2]);
}

/* The bone that travels with the character. */
static const sbf_bone *body_bone(const sbf_asset *asset, uint32_t *index) {
  *index = asset->gaits.count && asset->gaits.at[0].body >= 0 ? (uint32_t)asset->gaits.at[0].body : 0;
  return asset->bones.count ? &asset->bones.at[*index] : NULL;
}

void soft_character_follow(soft_character *one) {
  uint32_t index, count = one->model->asset->bones.count;
  const sbf_bone *bone = body_bone(one->model->asset, &index);
  sbr_transform *bones = bone ? malloc(count * sizeof *bones) : NULL;
  if (!bones) return;
  sbr_character_bones(one->world, one->id, bones, count);
  sbr_double3 origin = sbr_character_origin(one->world, one->id);
  sbf_quat back = {-bone->rotation.x, -bone->rotation.y, -bone->rotation.z, bone->rotation.w};
  sbf_vec3 ahead = turned(bones[index].rotation, turned(back, (sbf_vec3){0, 0, 1}));
  float heading = atan2f(ahead.x, ahead.z), c = cosf(heading), s = sinf(heading), k = one->scale;
  sbf_vec3 rest = {
      k * (c * bone->head.x + s * bone->head.z), k * bone->head.y, k * (c * bone->head.z - s * bone->head.x)};
  gd_transform *put = &one->put;
  put->origin = (sbf_vec3){(float)(origin.x + bones[index].position.x - rest.x),
      (float)(origin.y + bones[index].position.y - rest.y),
      (float)(origin.z + bones[index].position.z - rest.z)};
  float basis[3][3] = {{k * c, 0, k * s}, {0, k, 0}, {-k * s, 0, k * c}};
  memcpy(put->basis, basis, sizeof basis);
  free(bones);
  GD_DO(&one->node, "set_global_transform", gd_transform_value(*put));
}

double soft_character_ground_height(const soft_character *one, double x, double z) {
  sbf_vec3 normal;
  sbr_ground ground = physics_ground_of(one->ground);
  return ground.height(&ground, x, z, &normal);
}

void soft_character_place(soft_character *one, sbf_vec3 position, float heading) {
  float c = cosf(heading), s = sinf(heading), k = one->scale;
  float basis[3][3] = {{k * c, 0, k * s}, {0, k, 0}, {-k * s, 0, k * c}};
  one->put.origin = position;
  memcpy(one->put.basis, basis, sizeof basis);
  if (one->settings.ground == SOFT_GROUND_PHYSICS) {
    physics_bodies_look(one, true); /* which are no ground */
    physics_ground_look(one);
  }
  double above = position.y - soft_character_ground_height(one, position.x, position.z);
  /* What walks stands on the ground wherever it was put above it; what is loose falls from there. */
  if ((one->model->asset->gaits.count && !one->settings.free_bodies) || above < 0) above = 0;
  sbr_character_teleport(one->world, one->id, (sbr_double3){position.x, above, position.z}, heading);
  one->stale = true;
}

gd_transform soft_character_transform(const soft_character *one) {
  gd_variant value = GD_CALL(&one->node, "get_global_transform");
  gd_transform place = gd_as_transform(&value);
  gd_free(&value);
  return place;
}

/* Whether something else has moved the node since the character left it there. */
static bool was_moved(const gd_transform *a, const gd_transform *b) {
  float x = a->origin.x - b->origin.x, y = a->origin.y - b->origin.y, z = a->origin.z - b->origin.z;
  float turn = a->basis[0][2] * b->basis[2][2] - a->basis[2][2] * b->basis[0][2];
  return x * x + y * y + z * z > 1e-8f || turn * turn > 1e-8f;
}

/* ---- A frame ---- */

/* In the editor it stands where the node is put, and moves while it previews; then it is put back. */
static void edit(soft_character *one, const gd_transform *now) {
  if (one->previews) GD_DO(&one->node, "set_global_transform", gd_transform_value(one->from));
  if (!one->previews && !was_moved(now, &one->put)) return;
  one->put = one->previews ? one->from : *now;
  one->previews = false;
  one->flat_y = one->put.origin.y;
  physics_ground_level(one->ground, one->flat_y);
  sbr_character_reset(one->world, one->id);
  sbr_character_teleport(one->world, one->id, (sbr_double3){one->put.origin.x, 0, one->put.origin.z},
      transform_heading(&one->put));
  character_skeleton_update(one);
  one->stale = true;
  GD_DO(&one->node, "update_gizmos");
  GD_DO(&one->node, "update_configuration_warnings");
}

bool soft_character_prepare(soft_character *one) {
  gd_transform now = soft_character_transform(one);
  if (one->editor && !one->settings.preview) {
    edit(one, &now);
    return false;
  }
  if (one->editor && !one->previews) {
    one->previews = true;
    one->from = now;
    one->placed = false;
  }
  if (!one->placed || was_moved(&now, &one->put)) {
    soft_character_place(one, now.origin, transform_heading(&now));
    one->placed = true;
  } else if (one->settings.ground == SOFT_GROUND_PHYSICS && !one->settings.paused) {
    physics_bodies_look(one, false);
    physics_ground_look(one);
  }
  return !one->settings.paused;
}

void soft_character_show(soft_character *one) {
  soft_character_follow(one);
  character_skeleton_update(one);
  one->stale = true;
}
