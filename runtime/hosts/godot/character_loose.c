/* A character without pins, such as a block of jelly, is at the position of its points. Its node follows the
 * centre of its points, and when the node is moved, the centre moves to its rest position relative to it. Its
 * frame in the runtime stays at its last placement. */
#include <math.h>
#include <stdlib.h>

#include "soft_character.h"
#include "turns.h"

enum { TRIES = 4 };

/* Pins fix a body at its placement, as those of a flag do. */
bool soft_asset_is_loose(const sbf_asset *asset) {
  bool any = false;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[i];
    if (body->pins.count || body->attachments.count) return false;
    for (uint32_t k = 0; k < body->levels.count; k++)
      if (body->levels.at[k].pins.count) return false;
    any = any || body->levels.count;
  }
  return any && !asset->bones.count;
}

/* Centre of all points in the world; false if there are none, or memory runs out. */
static bool middle_of(const soft_character *one, double middle[3]) {
  double sum[3] = {0, 0, 0};
  uint64_t all = 0;
  for (uint32_t i = 0; i < one->model->asset->soft_bodies.count; i++) {
    uint32_t count = sbr_character_get_points(one->world, one->id, i, NULL, 0);
    sbf_vec3 *points = count ? malloc(count * sizeof *points) : NULL;
    if (!points) continue;
    sbr_character_get_points(one->world, one->id, i, points, count);
    for (uint32_t k = 0; k < count; k++)
      sum[0] += (double)points[k].x, sum[1] += (double)points[k].y, sum[2] += (double)points[k].z;
    free(points);
    all += count;
  }
  if (!all) return false;
  sbr_double3 origin = sbr_character_get_origin(one->world, one->id);
  middle[0] = origin.x + sum[0] / (double)all;
  middle[1] = origin.y + sum[1] / (double)all;
  middle[2] = origin.z + sum[2] / (double)all;
  return true;
}

void soft_character_loose_begin(soft_character *one) {
  double middle[3], ground = soft_character_ground_height(
                        one, one->placement.shown_at.origin.x, one->placement.shown_at.origin.z);
  one->loose.frame = (sbr_double3){one->placement.shown_at.origin.x, 0, one->placement.shown_at.origin.z};
  one->loose.middle = (sbf_vec3){0, 0, 0};
  if (!middle_of(one, middle)) return;
  sbf_vec3 off = {(float)(middle[0] - one->loose.frame.x), (float)(middle[1] - ground),
      (float)(middle[2] - one->loose.frame.z)};
  gd_transform back = upright((sbf_vec3){0, 0, 0}, -transform_heading(&one->placement.shown_at), 1);
  one->loose.middle = placed_vector(&back, off);
}

/* From the node to the centre, in the node's rotation. */
static sbf_vec3 arm_of(const soft_character *one) {
  gd_transform turn = upright((sbf_vec3){0, 0, 0}, transform_heading(&one->placement.shown_at), 1);
  return placed_vector(&turn, one->loose.middle);
}

bool soft_character_loose_follow(soft_character *one) {
  double middle[3];
  if (!one->loose.is_loose || !middle_of(one, middle)) return false;
  sbf_vec3 arm = arm_of(one);
  one->placement.shown_at.origin = (sbf_vec3){(float)(middle[0] - (double)arm.x),
      (float)(middle[1] - (double)arm.y), (float)(middle[2] - (double)arm.z)};
  return true;
}

/* Iterates, because the height of the frame is relative to the ground below it. */
bool soft_character_set_loose_position(soft_character *one) {
  double middle[3], wanted[3];
  if (!one->loose.is_loose) return false;
  sbf_vec3 arm = arm_of(one), put = one->placement.shown_at.origin;
  wanted[0] = (double)put.x + (double)arm.x;
  wanted[1] = fmax((double)put.y, soft_character_ground_height(one, put.x, put.z)) + (double)arm.y;
  wanted[2] = (double)put.z + (double)arm.z;
  for (int i = 0; i < TRIES; i++) {
    sbr_character_teleport(
        one->world, one->id, one->loose.frame, transform_heading(&one->placement.shown_at));
    if (!middle_of(one, middle)) return false;
    double x = wanted[0] - middle[0], y = wanted[1] - middle[1], z = wanted[2] - middle[2];
    if (x * x + y * y + z * z < 1e-12) break;
    double was = soft_character_ground_height(one, one->loose.frame.x, one->loose.frame.z);
    one->loose.frame.x += x, one->loose.frame.z += z;
    one->loose.frame.y += y + was - soft_character_ground_height(one, one->loose.frame.x, one->loose.frame.z);
  }
  return true;
}
