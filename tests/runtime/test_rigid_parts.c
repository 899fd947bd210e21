/* A person of 14 boxes among the rest of a character: it falls, comes to rest, follows its pose. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "rigid_scenes.h"

enum { PARTS = 14 };
typedef struct part {
  int parent;
  sbf_vec3 head, tail;
  float mass;
} part;
static const part parts[PARTS] = {{-1, {0, 1.0f, 0}, {0, 1.2f, 0}, 11}, {0, {0, 1.2f, 0}, {0, 1.5f, 0}, 20},
    {1, {0, 1.5f, 0}, {0, 1.75f, 0}, 5}, {1, {0.2f, 1.45f, 0}, {0.5f, 1.45f, 0}, 2},
    {3, {0.5f, 1.45f, 0}, {0.78f, 1.45f, 0}, 1.5f}, {1, {-0.2f, 1.45f, 0}, {-0.5f, 1.45f, 0}, 2},
    {5, {-0.5f, 1.45f, 0}, {-0.78f, 1.45f, 0}, 1.5f}, {0, {0.1f, 1.0f, 0}, {0.1f, 0.55f, 0}, 8},
    {7, {0.1f, 0.55f, 0}, {0.1f, 0.1f, 0}, 4}, {8, {0.1f, 0.05f, 0}, {0.1f, 0.05f, 0.2f}, 1},
    {0, {-0.1f, 1.0f, 0}, {-0.1f, 0.55f, 0}, 8}, {10, {-0.1f, 0.55f, 0}, {-0.1f, 0.1f, 0}, 4},
    {11, {-0.1f, 0.05f, 0}, {-0.1f, 0.05f, 0.2f}, 1}, {1, {0, 1.35f, 0}, {0, 1.35f, -0.1f}, 3}};

static float larger(float a, float b) {
  return a > b ? a : b;
}

/* A bone and a box for each part, ball joints with cones of 0.7 rad and twists of 0.3 between them. */
static scene person(void) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0.02;
  sbf_bone *bones = sbf_asset_allocate(s.asset, PARTS, sizeof *bones);
  ck_assert_ptr_nonnull(bones);
  for (int i = 0; i < PARTS; i++) {
    const part *p = &parts[i];
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
  s.asset->bones = (sbf_bone_list){bones, PARTS};
  return s;
}

static float fastest(const scene *s) {
  float most = 0;
  for (uint32_t b = 0; b < PARTS; b++) {
    sbf_vec3 v = rigid_state(s, b).velocity;
    most = larger(most, sqrtf(v.x * v.x + v.y * v.y + v.z * v.z));
  }
  return most;
}

/* A little above the body's middle. */
static void shove(const scene *s, uint32_t body, sbf_vec3 impulse) {
  sbr_double3 o = sbr_character_origin(s->world, s->character);
  sbf_vec3 c = rigid_state(s, body).center;
  sbr_character_rigid_push(s->world, s->character, body,
      (sbr_double3){o.x + (double)c.x, o.y + (double)c.y + 0.05 * (double)s->character_definition.scale,
          o.z + (double)c.z},
      impulse);
}

/* Within 5 s, whatever way it is thrown; no joint off, no limit broken by a degree on the way and a tenth of
 * one at rest; and nothing trembles by more than 3 mm/s then. */
START_TEST(a_person_falls_and_lies)
{
  static const sbf_vec3 shoves[4] = {{0, 0, 60}, {80, 0, -40}, {-30, 100, 0}, {0, -50, -120}};
  scene s = person();
  scene_start(&s);
  shove(&s, 1, shoves[_i]);
  float apart = 0, beyond = 0;
  for (int i = 0; i < 300; i++) {
    sbr_world_tick(s.world);
    for (uint32_t j = 0; j < PARTS - 1; j++) {
      sbr_joint_state now = rigid_joint_state(&s, j);
      apart = larger(apart, now.apart), beyond = larger(beyond, now.beyond_angle);
    }
  }
  ck_assert_float_le(apart, 1e-3f);
  ck_assert_float_le(beyond, 0.0175f);
  float trembling = 0;
  beyond = 0;
  for (int i = 0; i < 60; i++) {
    sbr_world_tick(s.world);
    trembling = larger(trembling, fastest(&s));
    for (uint32_t j = 0; j < PARTS - 1; j++) beyond = larger(beyond, rigid_joint_state(&s, j).beyond_angle);
  }
  ck_assert_float_le(trembling, 3e-3f);
  ck_assert_float_le(beyond, 0.00175f);
  scene_free(&s);
}
END_TEST

/* Bones are where their bodies are. */
START_TEST(bones_go_with_their_bodies)
{
  scene s = person();
  scene_start(&s);
  shove(&s, 2, (sbf_vec3){10, 0, 10});
  scene_ticks(&s, 40);
  sbr_transform bones[PARTS];
  sbr_character_bones(s.world, s.character, bones, PARTS);
  for (uint32_t b = 0; b < PARTS; b++) {
    sbr_rigid_state now = rigid_state(&s, b);
    /* At rest the bone's axes are asset space's, as the body's are. */
    ck_assert_float_eq_tol(fabsf(bones[b].rotation.w), fabsf(now.frame.rotation.w), 1e-5f);
    sbf_vec3 d = {bones[b].position.x - now.center.x, bones[b].position.y - now.center.y,
        bones[b].position.z - now.center.z};
    sbf_vec3 r = {parts[b].head.x - 0.5f * (parts[b].head.x + parts[b].tail.x),
        parts[b].head.y - 0.5f * (parts[b].head.y + parts[b].tail.y),
        parts[b].head.z - 0.5f * (parts[b].head.z + parts[b].tail.z)};
    ck_assert_float_eq_tol(d.x * d.x + d.y * d.y + d.z * d.z, r.x * r.x + r.y * r.y + r.z * r.z, 1e-4f);
  }
  scene_free(&s);
}
END_TEST

/* The hips held, all else driven: gravity bends it by little, and with no strength it hangs. */
START_TEST(drives_hold_the_pose)
{
  float bent[2];
  for (int passive = 0; passive < 2; passive++) {
    scene s = person();
    scene_start(&s);
    sbr_character_rigid_mode(s.world, s.character, -1, passive ? SBR_RIGID_PASSIVE : SBR_RIGID_DRIVEN);
    sbr_character_rigid_mode(s.world, s.character, 0, SBR_RIGID_KINEMATIC);
    scene_ticks(&s, 180);
    bent[passive] = 0;
    for (uint32_t j = 0; j < PARTS - 1; j++)
      bent[passive] = larger(bent[passive], rigid_joint_state(&s, j).coordinates[SBF_JOINT_AXIS_SWING]);
    scene_free(&s);
  }
  ck_assert_float_le(bent[0], 0.1f);
  ck_assert_float_ge(bent[1], 0.5f);
}
END_TEST

/* What is let go keeps going; what is caught is at its pose at once. */
START_TEST(modes_change_in_motion)
{
  scene s = person();
  scene_start(&s);
  sbr_character_rigid_mode(s.world, s.character, -1, SBR_RIGID_KINEMATIC);
  scene_ticks(&s, 30);
  ck_assert_float_eq_tol(rigid_state(&s, 2).center.y, 1.625f + 0.02f, 1e-5f);
  sbr_character_rigid_mode(s.world, s.character, 2, SBR_RIGID_PASSIVE);
  scene_ticks(&s, 60);
  ck_assert_float_le(rigid_joint_state(&s, 1).apart, 1e-5f);
  sbr_character_rigid_mode(s.world, s.character, -1, SBR_RIGID_KINEMATIC);
  scene_ticks(&s, 2);
  ck_assert_float_eq_tol(rigid_state(&s, 2).center.y, 1.625f + 0.02f, 1e-5f);
  scene_free(&s);
}
END_TEST

/* From a snapshot the same again, bit for bit; and asleep at last, until it is pushed. */
START_TEST(snapshots_and_sleep)
{
  scene s = person();
  s.world_definition.sleep_after_s = 0.5;
  scene_start(&s);
  shove(&s, 1, (sbf_vec3){0, 0, 60});
  scene_ticks(&s, 30);
  size_t size = sbr_world_snapshot_size(s.world);
  void *kept = malloc(size);
  ck_assert_int_eq(sbr_world_snapshot_save(s.world, kept, size), SBF_OK);
  scene_ticks(&s, 60);
  uint64_t first = sbr_world_state_hash(s.world);
  ck_assert_int_eq(sbr_world_snapshot_restore(s.world, kept, size), SBF_OK);
  scene_ticks(&s, 60);
  ck_assert_uint_eq(sbr_world_state_hash(s.world), first);
  free(kept);
  scene_ticks(&s, 400);
  ck_assert_float_eq(fastest(&s), 0);
  sbf_vec3 before = rigid_state(&s, 1).center;
  shove(&s, 1, (sbf_vec3){100, 100, 0});
  scene_ticks(&s, 10);
  sbf_vec3 after = rigid_state(&s, 1).center;
  ck_assert_float_ge(
      fabsf(after.x - before.x) + fabsf(after.y - before.y) + fabsf(after.z - before.z), 0.02f);
  scene_free(&s);
}
END_TEST

/* Twice the size falls as a body of that size does: the same shape after sqrt 2 times as long. */
START_TEST(a_larger_person_falls_the_same_way)
{
  sbr_joint_state small, large;
  for (int i = 0; i < 2; i++) {
    scene s = person();
    s.character_definition.scale = i ? 4 : 1;
    s.character_definition.position.y *= i ? 4 : 1;
    scene_start(&s);
    shove(&s, 1, (sbf_vec3){0, 0, 20.0f * (i ? 128 : 1)}); /* mass 64, speed 2 */
    scene_ticks(&s, i ? 60 : 30);
    *(i ? &large : &small) = rigid_joint_state(&s, 5);
    scene_free(&s);
  }
  ck_assert_float_eq_tol(
      small.coordinates[SBF_JOINT_AXIS_SWING], large.coordinates[SBF_JOINT_AXIS_SWING], 0.02f);
  ck_assert_float_ge(small.coordinates[SBF_JOINT_AXIS_SWING], 0.02f);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rigid_parts");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, a_person_falls_and_lies, 0, 4);
  tcase_add_test(tests, bones_go_with_their_bodies);
  tcase_add_test(tests, drives_hold_the_pose);
  tcase_add_test(tests, modes_change_in_motion);
  tcase_add_test(tests, snapshots_and_sleep);
  tcase_add_test(tests, a_larger_person_falls_the_same_way);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
