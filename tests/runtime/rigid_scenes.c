#include "rigid_scenes.h"

#include <check.h>
#include <string.h>

const sbf_quat rigid_along_x = {0, 0, 0, 1};
const sbf_quat rigid_along_y = {0, 0, 0.70710678f, 0.70710678f};
const sbf_quat rigid_along_z = {0, -0.70710678f, 0, 0.70710678f};

scene rigid_begin(void) {
  scene s = scene_begin();
  s.asset->soft_bodies = (sbf_soft_body_list){NULL, 0};
  sbf_rigid_body *bodies = sbf_asset_allocate(s.asset, RIGID_MAX, sizeof *bodies);
  sbf_joint *joints = sbf_asset_allocate(s.asset, RIGID_MAX, sizeof *joints);
  ck_assert(bodies && joints);
  s.asset->rigid_bodies = (sbf_rigid_body_list){bodies, 0};
  s.asset->joints = (sbf_joint_list){joints, 0};
  return s;
}

static sbf_polygon_mesh *box_hull(scene *s, sbf_vec3 center, sbf_vec3 size) {
  static const uint32_t corners[24] = {
      0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  static const uint32_t sizes[6] = {4, 4, 4, 4, 4, 4};
  sbf_polygon_mesh *hull = sbf_asset_allocate(s->asset, 1, sizeof *hull);
  sbf_vec3 *points = sbf_asset_allocate(s->asset, 8, sizeof *points);
  ck_assert(hull && points);
  sbf_polygon_mesh_init(hull);
  for (int i = 0; i < 8; i++)
    points[i] = (sbf_vec3){center.x + size.x * (i & 1 ? 0.5f : -0.5f),
        center.y + size.y * (i & 2 ? 0.5f : -0.5f), center.z + size.z * (i & 4 ? 0.5f : -0.5f)};
  hull->positions = (sbf_vec3_list){points, 8};
  hull->polygon_sizes = (sbf_u32_list){sizes, 6};
  hull->polygon_points = (sbf_u32_list){corners, 24};
  return hull;
}

sbf_rigid_body *rigid_body(scene *s, uint32_t number) {
  return (sbf_rigid_body *)(uintptr_t)&s->asset->rigid_bodies.at[number];
}

uint32_t rigid_box(scene *s, sbf_vec3 center, sbf_vec3 size, float mass) {
  uint32_t number = s->asset->rigid_bodies.count++;
  ck_assert_uint_lt(number, RIGID_MAX);
  sbf_rigid_body *body = rigid_body(s, number);
  sbf_rigid_body_init(body);
  body->id = "box";
  body->motion = SBF_BODY_MOTION_DYNAMIC;
  body->center = center;
  body->mass = mass;
  body->hull = box_hull(s, center, size);
  return number;
}

static sbf_frame frame_in(const scene *s, int32_t body, sbf_vec3 position, sbf_quat axes) {
  sbf_vec3 from = {0, 0, 0};
  if (body >= 0) from = s->asset->rigid_bodies.at[body].center;
  return (sbf_frame){{position.x - from.x, position.y - from.y, position.z - from.z}, axes};
}

sbf_joint *rigid_joint(
    scene *s, sbf_joint_kind kind, int32_t a, uint32_t b, sbf_vec3 position, sbf_quat axes) {
  uint32_t number = s->asset->joints.count++;
  ck_assert_uint_lt(number, RIGID_MAX);
  sbf_joint *joint = (sbf_joint *)(uintptr_t)&s->asset->joints.at[number];
  sbf_joint_init(joint);
  joint->id = "joint";
  joint->kind = kind;
  joint->body_a = a;
  joint->body_b = (int32_t)b;
  joint->frame_a = frame_in(s, a, position, axes);
  joint->frame_b = frame_in(s, (int32_t)b, position, axes);
  return joint;
}

static const void *with_one_more(scene *s, const void *list, uint32_t count, const void *one, size_t size) {
  unsigned char *more = sbf_asset_allocate(s->asset, count + 1, size);
  ck_assert_ptr_nonnull(more);
  if (count) memcpy(more, list, count * size);
  memcpy(more + count * size, one, size);
  return more;
}

void rigid_limit(scene *s, sbf_joint *joint, sbf_limit limit) {
  joint->limits.at = with_one_more(s, joint->limits.at, joint->limits.count, &limit, sizeof limit);
  joint->limits.count++;
}

void rigid_drive(scene *s, sbf_joint *joint, sbf_drive drive) {
  joint->drives.at = with_one_more(s, joint->drives.at, joint->drives.count, &drive, sizeof drive);
  joint->drives.count++;
}

sbr_rigid_state rigid_state(const scene *s, uint32_t body) {
  return sbr_character_get_rigid_state(s->world, s->character, body);
}

sbr_joint_state rigid_joint_state(const scene *s, uint32_t joint) {
  return sbr_character_get_joint_state(s->world, s->character, joint);
}

double rigid_energy(const scene *s, uint32_t body_count) {
  double sum = 0;
  for (uint32_t b = 0; b < body_count; b++) {
    sbr_rigid_state state = rigid_state(s, b);
    sum += (double)state.kinetic_j + (double)state.potential_j;
  }
  return sum;
}

void rigid_pin(
    scene *s, sbf_level *level, uint32_t set_number, int32_t body, const uint32_t *points, uint32_t count) {
  sbf_pin_set *sets = sbf_asset_allocate(s->asset, level->pins.count + 1, sizeof *sets);
  uint32_t *copy = sbf_asset_allocate(s->asset, count, sizeof *copy);
  ck_assert(sets && copy);
  ck_assert_uint_eq(set_number, level->pins.count);
  for (uint32_t i = 0; i < level->pins.count; i++) sets[i] = level->pins.at[i];
  for (uint32_t i = 0; i < count; i++) copy[i] = points[i];
  sbf_pin_set_init(&sets[set_number]);
  sets[set_number].rigid_body = body;
  sets[set_number].points = (sbf_u32_list){copy, count};
  level->pins = (sbf_pin_set_list){sets, set_number + 1};
}

void rigid_push(const scene *s, uint32_t body, sbf_vec3 offset, sbf_vec3 impulse) {
  sbr_double3 o = sbr_character_get_origin(s->world, s->character);
  sbf_vec3 c = rigid_state(s, body).center;
  sbr_double3 at = {
      o.x + (double)(c.x + offset.x), o.y + (double)(c.y + offset.y), o.z + (double)(c.z + offset.z)};
  sbr_character_apply_rigid_impulse(s->world, s->character, body, at, impulse);
}
