#include "rigid_person.h"

#include <check.h>
#include <math.h>

const part person_parts[ALL_PARTS] = {{-1, {0, 1.0f, 0}, {0, 1.2f, 0}, 11},
    {0, {0, 1.2f, 0}, {0, 1.5f, 0}, 20}, {1, {0, 1.5f, 0}, {0, 1.75f, 0}, 5},
    {1, {0.2f, 1.45f, 0}, {0.5f, 1.45f, 0}, 2}, {3, {0.5f, 1.45f, 0}, {0.78f, 1.45f, 0}, 1.5f},
    {1, {-0.2f, 1.45f, 0}, {-0.5f, 1.45f, 0}, 2}, {5, {-0.5f, 1.45f, 0}, {-0.78f, 1.45f, 0}, 1.5f},
    {0, {0.1f, 1.0f, 0}, {0.1f, 0.55f, 0}, 8}, {7, {0.1f, 0.55f, 0}, {0.1f, 0.1f, 0}, 4},
    {8, {0.1f, 0.05f, 0}, {0.1f, 0.05f, 0.2f}, 1}, {0, {-0.1f, 1.0f, 0}, {-0.1f, 0.55f, 0}, 8},
    {10, {-0.1f, 0.55f, 0}, {-0.1f, 0.1f, 0}, 4}, {11, {-0.1f, 0.05f, 0}, {-0.1f, 0.05f, 0.2f}, 1},
    {1, {0, 1.35f, 0}, {0, 1.35f, -0.1f}, 3}, {4, {0.78f, 1.45f, 0}, {0.93f, 1.45f, 0}, 0.5f},
    {6, {-0.78f, 1.45f, 0}, {-0.93f, 1.45f, 0}, 0.5f}, {9, {0.1f, 0.05f, 0.2f}, {0.1f, 0.05f, 0.28f}, 0.2f},
    {12, {-0.1f, 0.05f, 0.2f}, {-0.1f, 0.05f, 0.28f}, 0.2f}, {0, {0, 1.05f, -0.1f}, {0, 1.05f, -0.3f}, 1},
    {18, {0, 1.05f, -0.3f}, {0, 1.05f, -0.5f}, 0.5f}};

static float larger(float a, float b) {
  return a > b ? a : b;
}

static scene person_of(int count) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0.02;
  sbf_bone *bones = sbf_asset_allocate(s.asset, ALL_PARTS, sizeof *bones);
  ck_assert_ptr_nonnull(bones);
  for (int i = 0; i < count; i++) {
    const part *p = &person_parts[i];
    sbf_vec3 middle = {
        0.5f * (p->head.x + p->tail.x), 0.5f * (p->head.y + p->tail.y), 0.5f * (p->head.z + p->tail.z)};
    sbf_vec3 size = {
        fabsf(p->tail.x - p->head.x), fabsf(p->tail.y - p->head.y), fabsf(p->tail.z - p->head.z)};
    uint32_t body = rigid_box(&s, middle,
        (sbf_vec3){larger(0.9f * size.x, 0.1f), larger(0.9f * size.y, 0.1f), larger(0.9f * size.z, 0.1f)},
        p->mass);
    sbf_bone_init(&bones[i]);
    bones[i].id = "bone";
    bones[i].parent = p->parent;
    bones[i].head = p->head;
    rigid_body(&s, body)->bone = i;
    if (p->parent < 0) continue;
    sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, p->parent, body, p->head, rigid_along_x);
    rigid_limit(&s, joint, (sbf_limit){.target = SBF_JOINT_AXIS_SWING, .max = 0.7f});
    rigid_limit(&s, joint, (sbf_limit){.target = SBF_JOINT_AXIS_TWIST, .min = -0.3f, .max = 0.3f});
  }
  s.asset->bones = (sbf_bone_list){bones, (uint32_t)count};
  return s;
}

scene person(void) {
  return person_of(PARTS);
}

scene whole_person(void) {
  return person_of(ALL_PARTS);
}

float person_fastest(const scene *s) {
  float max = 0;
  for (uint32_t b = 0; b < PARTS; b++) {
    sbf_vec3 v = rigid_state(s, b).velocity;
    max = larger(max, sqrtf(v.x * v.x + v.y * v.y + v.z * v.z));
  }
  return max;
}

void person_shove(const scene *s, uint32_t body, sbf_vec3 impulse) {
  sbr_double3 o = sbr_character_get_origin(s->world, s->character);
  sbf_vec3 c = rigid_state(s, body).center;
  sbr_character_apply_rigid_impulse(s->world, s->character, body,
      (sbr_double3){o.x + (double)c.x, o.y + (double)c.y + 0.05 * (double)s->character_definition.scale,
          o.z + (double)c.z},
      impulse);
}
