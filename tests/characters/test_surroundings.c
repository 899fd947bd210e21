/* Colliders around a walking character: high ones are walls, low ones are stepped on, moving ones
 * carry it, and without ground it falls. */
#include <math.h>
#include <stdio.h>

#include "harness.h"
#include "sbfmt/build.h"
#include "sbfmt/convert.h"
#include "sbrun/collision.h"
#include "sbrun/debug.h"
#include "sbrun/events.h"
#include "sbrun/sbrun.h"

enum { SECOND = 60, LEGS = 4 };

static sbf_asset *pup, *koi;
static sbr_model *pup_model, *koi_model;

static sbf_asset *built(const char *path) {
  sbf_asset *draft, *asset;
  sbf_diagnostic error;
  ck_assert_msg(sbf_convert(harness_source(path), NULL, &draft, &error) == SBF_OK, "%s", error.message);
  ck_assert_msg(sbf_build(draft, NULL, &asset, NULL, &error) == SBF_OK, "%s", error.message);
  sbf_asset_free(draft);
  return asset;
}

static void make_models(void) {
  pup = built("examples/pup/pup.glb"), koi = built("examples/koi/koi.glb");
  ck_assert_int_eq(sbr_model_create(pup, NULL, &pup_model, NULL), SBF_OK);
  ck_assert_int_eq(sbr_model_create(koi, NULL, &koi_model, NULL), SBF_OK);
}

static void free_models(void) {
  sbr_model_destroy(pup_model);
  sbr_model_destroy(koi_model);
  sbf_asset_free(pup);
  sbf_asset_free(koi);
}

typedef struct scene {
  sbr_world *world;
  sbr_character_id walker;
  sbr_shape *shapes[16];
  uint32_t shape_count;
} scene;

static scene scene_of(const sbr_model *model, double ground_m, double y) {
  scene s = {.shape_count = 0};
  sbr_world_definition definition = sbr_default_world_definition();
  definition.ground = sbr_ground_flat(ground_m);
  ck_assert_int_eq(sbr_world_create(&definition, &s.world, NULL), SBF_OK);
  sbr_character_definition standing = sbr_default_character_definition();
  standing.position.y = y - ground_m;
  ck_assert_int_eq(sbr_character_create(s.world, model, &standing, &s.walker, NULL), SBF_OK);
  return s;
}

static void end_scene(scene *s) {
  sbr_world_destroy(s->world);
  for (uint32_t i = 0; i < s->shape_count; i++) sbr_shape_destroy(s->shapes[i]);
}

static sbr_collider_id collider_of(scene *s, const sbr_shape_definition *form, sbr_double3 at, float mass) {
  sbr_collider_id id;
  sbr_shape **shape = &s->shapes[s->shape_count++];
  ck_assert_int_eq(sbr_shape_create(NULL, form, shape, NULL), SBF_OK);
  sbr_collider_definition definition = sbr_default_collider_definition();
  definition.shape = *shape;
  definition.position = at;
  definition.mass = mass;
  ck_assert_int_eq(sbr_collider_create(s->world, &definition, &id, NULL), SBF_OK);
  return id;
}

static sbr_collider_id box(scene *s, sbr_double3 at, sbf_vec3 half) {
  sbr_shape_definition form = sbr_default_shape_definition();
  form.kind = SBR_SHAPE_BOX;
  form.half_sizes = half;
  return collider_of(s, &form, at, 0);
}

/* The same as triangles. */
static sbr_collider_id box_mesh(scene *s, sbr_double3 at, sbf_vec3 half) {
  static const uint32_t triangles[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7,
      3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  sbf_vec3 points[8];
  for (int i = 0; i < 8; i++)
    points[i] = (sbf_vec3){i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z};
  sbr_shape_definition form = sbr_default_shape_definition();
  form.kind = SBR_SHAPE_MESH;
  form.points = points, form.point_count = 8;
  form.triangles = triangles, form.triangle_count = 12;
  return collider_of(s, &form, at, 0);
}

static void run(scene *s, int ticks) {
  for (int i = 0; i < ticks; i++) sbr_world_tick(s->world);
}

/* Where the first bone is that hangs on nothing. */
static sbr_double3 position_of(const scene *s, const sbf_asset *asset) {
  sbr_transform bones[256];
  uint32_t root = 0;
  while (asset->bones.at[root].parent >= 0) root++;
  sbr_double3 o = sbr_character_get_origin(s->world, s->walker);
  sbr_character_get_bones(s->world, s->walker, bones, 256);
  sbf_vec3 p = bones[root].position;
  return (sbr_double3){o.x + (double)p.x, o.y + (double)p.y, o.z + (double)p.z};
}

/* The greatest of all its bones' heads along an axis of the world. */
static double foremost(const scene *s, const sbf_asset *asset, int axis) {
  sbr_transform bones[256];
  sbr_double3 o = sbr_character_get_origin(s->world, s->walker);
  const double origin[3] = {o.x, o.y, o.z};
  double most = -INFINITY;
  sbr_character_get_bones(s->world, s->walker, bones, 256);
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    const float at[3] = {bones[i].position.x, bones[i].position.y, bones[i].position.z};
    most = fmax(most, origin[axis] + (double)at[axis]);
  }
  return most;
}

static double nose_of(const sbf_asset *asset) {
  const sbf_vec3_list *at = &asset->render_meshes.at[0].mesh.positions;
  float most = at->at[0].z;
  for (uint32_t i = 1; i < at->count; i++) most = fmaxf(most, at->at[i].z);
  return (double)most;
}

START_TEST(a_wall_stops_it)
{
  scene s = scene_of(pup_model, 0, 0);
  double nose = nose_of(pup) - foremost(&s, pup, 2);
  if (_i)
    box_mesh(&s, (sbr_double3){0, 0.5, 1.1}, (sbf_vec3){2, 0.5f, 0.1f});
  else
    box(&s, (sbr_double3){0, 0.5, 1.1}, (sbf_vec3){2, 0.5f, 0.1f});
  sbr_character_set_drive(s.world, s.walker, 0.4f, 0, 0);
  run(&s, 5 * SECOND);
  double front = foremost(&s, pup, 2) + nose;
  ck_assert_msg(front > 0.9 && front < 1.02, "its nose is at %g m, the wall at 1 m", front);
  double before = position_of(&s, pup).z;
  run(&s, SECOND); /* and it stays there */
  ck_assert_double_eq_tol(position_of(&s, pup).z, before, 0.02);
  end_scene(&s);
}
END_TEST

/* Those that crawl, go on six or eight legs, or follow their nose. */
START_TEST(every_kind_is_stopped)
{
  static const char *const paths[] = {
      "examples/caterpillar/caterpillar.glb", "examples/snake/snake.glb", "examples/spider/spider.glb"};
  sbf_asset *asset = built(paths[_i]);
  sbr_model *model;
  ck_assert_int_eq(sbr_model_create(asset, NULL, &model, NULL), SBF_OK);
  scene s = scene_of(model, 0, 0);
  double nose = nose_of(asset), length = 2 * nose, margin = foremost(&s, asset, 2);
  box(&s, (sbr_double3){0, length, nose + length + 0.1}, (sbf_vec3){9, (float)length, 0.1f});
  sbr_character_set_drive(s.world, s.walker, (float)(0.5 * length), 0, 0);
  run(&s, 6 * SECOND);
  double front = foremost(&s, asset, 2);
  ck_assert_msg(front > margin + 0.5 * length && front < nose + length,
      "it came to %g m, the wall is at %g m", front, nose + length);
  end_scene(&s);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
}
END_TEST

/* From its second second on it walks so far, and comes so much higher. */
static void check_climb(scene *s, int seconds, double z, double rise, double within) {
  sbr_character_set_drive(s->world, s->walker, 0.3f, 0, 0);
  run(s, SECOND);
  double before = position_of(s, pup).y;
  run(s, (seconds - 1) * SECOND);
  sbr_double3 at = position_of(s, pup);
  ck_assert_msg(at.z > z, "it came to %g m", at.z);
  ck_assert_double_eq_tol(at.y - before, rise, within);
  end_scene(s);
}

/* A slope of 40 degrees is ground, not a wall. */
START_TEST(a_ramp_is_climbed)
{
  const double angle = 40 * 3.14159265 / 180, along = 3, thick = 0.1, foot = 0.8;
  scene s = scene_of(pup_model, 0, 0);
  sbr_collider_id ramp = box(&s, (sbr_double3){0, -9, 0}, (sbf_vec3){2, (float)thick, (float)along});
  sbr_double3 middle = {
      0, along * sin(angle) - thick * cos(angle), foot + along * cos(angle) + thick * sin(angle)};
  sbr_collider_set_transform(
      s.world, ramp, middle, (sbf_quat){-(float)sin(angle / 2), 0, 0, (float)cos(angle / 2)});
  sbr_character_set_drive(s.world, s.walker, 0.3f, 0, 0);
  double before = position_of(&s, pup).y;
  run(&s, 8 * SECOND);
  sbr_double3 at = position_of(&s, pup);
  ck_assert_msg(at.z > foot + 0.2, "it came to %g m", at.z);
  ck_assert_double_eq_tol(at.y - before, (at.z - foot) * tan(angle), 0.15);
  end_scene(&s);
}
END_TEST

START_TEST(stairs_of_boxes_are_climbed)
{
  scene s = scene_of(pup_model, 0, 0);
  for (int k = 1; k <= 6; k++)
    box(&s, (sbr_double3){0, 0.025 * k, 0.5 + 0.3 * k + 2}, (sbf_vec3){2, 0.025f * (float)k, 2});
  check_climb(&s, 12, 2.4, 0.3, 0.03);
}
END_TEST

/* Its host moves it, and its feet step: those that stand stay where they are. A wall keeps it out all the
 * same. */
START_TEST(a_displaced_one_steps)
{
  scene s = scene_of(pup_model, 0, 0);
  sbr_leg_state before[LEGS], legs[LEGS];
  double z = position_of(&s, pup).z, slip = 0;
  box(&s, (sbr_double3){0, 0.5, 2.5}, (sbf_vec3){2, 0.5f, 0.1f});
  for (int i = 0; i < 3 * SECOND; i++) {
    sbr_character_get_legs(s.world, s.walker, before, LEGS);
    sbr_character_displace(s.world, s.walker, (sbf_vec3){0, 0, 0.2f / SECOND}, 0);
    sbr_character_displace(s.world, s.walker, (sbf_vec3){0, 0, 0.2f / SECOND}, 0);
    sbr_world_tick(s.world);
    sbr_character_get_legs(s.world, s.walker, legs, LEGS);
    for (int k = 0; k < 4; k++)
      if (before[k].planted && legs[k].planted)
        slip = fmax(slip, fabs((double)(legs[k].foot.z - before[k].foot.z)));
  }
  ck_assert_double_eq_tol(position_of(&s, pup).z - z, 1.2, 0.03);
  for (int k = 0; k < 4; k++) ck_assert_uint_ge(legs[k].steps_taken, 4);
  ck_assert_double_le(slip, 1e-4);
  for (int i = 0; i < 3 * SECOND; i++) {
    sbr_character_displace(s.world, s.walker, (sbf_vec3){0, 0, 0.4f / SECOND}, 0);
    sbr_world_tick(s.world);
  }
  ck_assert_double_lt(position_of(&s, pup).z, 2.4);
  end_scene(&s);
}
END_TEST

/* A wall at 45 degrees turns its way aside. */
START_TEST(it_slides_along_a_wall)
{
  scene s = scene_of(pup_model, 0, 0);
  sbr_collider_id wall = box(&s, (sbr_double3){0, 0.5, 1.2}, (sbf_vec3){5, 0.5f, 0.1f});
  sbr_collider_set_transform(
      s.world, wall, (sbr_double3){0, 0.5, 1.2}, (sbf_quat){0, 0.38268343f, 0, 0.92387953f});
  sbr_character_set_drive(s.world, s.walker, 0.4f, 0, 0);
  run(&s, 6 * SECOND);
  sbr_double3 at = position_of(&s, pup);
  ck_assert_msg(fabs(at.x) > 0.3 && at.z > 0.3, "it is at %g, %g", at.x, at.z);
  end_scene(&s);
}
END_TEST

START_TEST(a_low_box_is_stepped_on)
{
  scene s = scene_of(pup_model, 0, 0);
  box(&s, (sbr_double3){0, 0.02, 1.8}, (sbf_vec3){2, 0.02f, 1});
  check_climb(&s, 6, 1.2, 0.04, 0.012);
}
END_TEST

START_TEST(a_bridge_is_walked_under)
{
  scene s = scene_of(pup_model, 0, 0);
  box(&s, (sbr_double3){0, 1, 1.2}, (sbf_vec3){2, 0.1f, 0.3f});
  check_climb(&s, 6, 1.5, 0, 0.02);
}
END_TEST

/* The ground is far below: it stands on a floor of colliders. */
START_TEST(a_lift_lifts_it)
{
  scene s = scene_of(pup_model, -50, 0);
  double y = 0;
  sbr_collider_id floor = box(&s, (sbr_double3){0, -0.1, 0}, (sbf_vec3){2, 0.1f, 2});
  run(&s, SECOND / 2);
  double before = position_of(&s, pup).y;
  for (int i = 0; i < 2 * SECOND; i++) {
    y += 0.5 / SECOND;
    sbr_collider_move(s.world, floor, (sbr_double3){0, y - 0.1, 0}, (sbf_quat){0, 0, 0, 1});
    sbr_world_tick(s.world);
  }
  ck_assert_double_eq_tol(position_of(&s, pup).y - before, y, 0.01);
  end_scene(&s);
}
END_TEST

/* Without legs too, and faster than its floor could be told from one that is gone. */
START_TEST(a_lift_lowers_a_snake)
{
  sbf_asset *asset = built("examples/snake/snake.glb");
  sbr_model *model;
  ck_assert_int_eq(sbr_model_create(asset, NULL, &model, NULL), SBF_OK);
  scene s = scene_of(model, -50, 0);
  double y = 0;
  sbr_collider_id floor = box(&s, (sbr_double3){0, -0.1, 0}, (sbf_vec3){3, 0.1f, 3});
  run(&s, SECOND / 2);
  double before = position_of(&s, asset).y;
  for (int i = 1; i <= SECOND; i++) { /* up to 4 m/s */
    y -= 4.0 * i / SECOND / SECOND;
    sbr_collider_move(s.world, floor, (sbr_double3){0, y - 0.1, 0}, (sbf_quat){0, 0, 0, 1});
    sbr_world_tick(s.world);
    ck_assert_double_eq_tol(position_of(&s, asset).y - before, y, 0.02);
    ck_assert_uint_eq(sbr_world_get_foot_events(s.world).landed_count, 0);
  }
  end_scene(&s);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(a_turntable_carries_and_rotates_it)
{
  scene s = scene_of(pup_model, -50, 0);
  sbr_collider_id floor = box(&s, (sbr_double3){0.5, -0.1, 0}, (sbf_vec3){2, 0.1f, 2});
  run(&s, SECOND / 2);
  sbr_double3 before = position_of(&s, pup);
  for (int i = 1; i <= SECOND; i++) { /* a quarter turn to the left about (0.5, 0) */
    float half = 0.25f * 3.14159265f * (float)i / SECOND;
    sbr_collider_move(s.world, floor, (sbr_double3){0.5, -0.1, 0}, (sbf_quat){0, sinf(half), 0, cosf(half)});
    sbr_world_tick(s.world);
  }
  sbr_double3 at = position_of(&s, pup);
  ck_assert_double_eq_tol(at.x, 0.5 + before.z, 0.03);
  ck_assert_double_eq_tol(at.z, 0.5 - before.x, 0.03);
  end_scene(&s);
}
END_TEST

START_TEST(it_falls_when_the_floor_is_removed)
{
  scene s = scene_of(pup_model, 0, 2);
  sbr_collider_id floor = box(&s, (sbr_double3){0, 1.9, 0}, (sbf_vec3){1, 0.1f, 1});
  uint32_t landed = 0;
  run(&s, SECOND);
  sbr_double3 before = position_of(&s, pup);
  sbr_collider_destroy(s.world, floor);
  int ticks = 0;
  for (; ticks < 2 * SECOND && !landed; ticks++) {
    sbr_world_tick(s.world);
    landed += sbr_world_get_foot_events(s.world).landed_count;
  }
  run(&s, SECOND);
  ck_assert_uint_eq(landed, 1);
  ck_assert_double_eq_tol(before.y - position_of(&s, pup).y, 2, 0.01);
  /* sqrt(2 h / g), a tick for the collider to go and one of the steps' error. */
  ck_assert_int_ge(ticks, (int)(SECOND * sqrt(2 * 2 / 9.81)) - 1);
  ck_assert_int_le(ticks, (int)(SECOND * sqrt(2 * 2 / 9.81)) + 3);
  end_scene(&s);
}
END_TEST

START_TEST(a_door_pushes_it)
{
  scene s = scene_of(pup_model, 0, 0);
  double z = -1.2;
  sbr_collider_id door = box(&s, (sbr_double3){0, 0.5, z}, (sbf_vec3){1, 0.5f, 0.1f});
  for (int i = 0; i < 4 * SECOND; i++) {
    z += 0.4 / SECOND;
    sbr_collider_move(s.world, door, (sbr_double3){0, 0.5, z}, (sbf_quat){0, 0, 0, 1});
    sbr_world_tick(s.world);
  }
  run(&s, SECOND);
  ck_assert_msg(position_of(&s, pup).z > z + 0.1, "the door is at %g m, it at %g", z, position_of(&s, pup).z);
  end_scene(&s);
}
END_TEST

/* A ball of 20 g is no wall; one of 10 t is. */
START_TEST(light_obstacles_are_pushed_away)
{
  const float masses[2] = {0.02f, 1e4f};
  scene s = scene_of(pup_model, 0, 0);
  sbr_shape_definition form = sbr_default_shape_definition();
  form.radius = 0.25f;
  collider_of(&s, &form, (sbr_double3){0, 0.25, 1}, masses[_i]);
  sbr_character_set_drive(s.world, s.walker, 0.4f, 0, 0);
  run(&s, 4 * SECOND);
  double z = position_of(&s, pup).z;
  ck_assert_msg(_i ? z < 0.8 : z > 1, "it came to %g m", z);
  end_scene(&s);
}
END_TEST

START_TEST(a_fish_stays_in_its_tank)
{
  scene s = scene_of(koi_model, 0, 1);
  for (int k = -1; k <= 1; k += 2) {
    box(&s, (sbr_double3){2.0 * k, 1, 0}, (sbf_vec3){0.5f, 2, 3});
    box(&s, (sbr_double3){0, 1, 2.0 * k}, (sbf_vec3){3, 2, 0.5f});
  }
  box(&s, (sbr_double3){0, 2.5, 0}, (sbf_vec3){3, 0.5f, 3});
  sbr_character_set_drive(s.world, s.walker, 0.6f, 0, 0.1f);
  sbr_character_set_vertical_speed(s.world, s.walker, 0.5f);
  run(&s, 8 * SECOND);
  sbr_double3 at = position_of(&s, koi);
  ck_assert_msg(fabs(at.x) < 1.5 && fabs(at.z) < 1.5 && at.y < 2, "it is at %g, %g, %g", at.x, at.y, at.z);
  end_scene(&s);
}
END_TEST

/* No wall is jumped over, however fast it is driven. */
START_TEST(no_wall_is_passed_at_speed)
{
  scene s = scene_of(koi_model, 0, 1);
  box(&s, (sbr_double3){0, 1, 4}, (sbf_vec3){30, 30, 0.02f});
  sbr_character_set_drive(s.world, s.walker, 60, 0, 0);
  run(&s, 3 * SECOND);
  ck_assert_double_lt(position_of(&s, koi).z, 4);
  end_scene(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("surroundings");
  TCase *tests = tcase_create("all");
  tcase_add_unchecked_fixture(tests, make_models, free_models);
  tcase_set_timeout(tests, 300);
  tcase_add_loop_test(tests, a_wall_stops_it, 0, 2);
  tcase_add_loop_test(tests, every_kind_is_stopped, 0, 3);
  tcase_add_test(tests, a_ramp_is_climbed);
  tcase_add_test(tests, stairs_of_boxes_are_climbed);
  tcase_add_test(tests, a_displaced_one_steps);
  tcase_add_test(tests, it_slides_along_a_wall);
  tcase_add_test(tests, a_low_box_is_stepped_on);
  tcase_add_test(tests, a_bridge_is_walked_under);
  tcase_add_test(tests, a_lift_lifts_it);
  tcase_add_test(tests, a_lift_lowers_a_snake);
  tcase_add_test(tests, a_turntable_carries_and_rotates_it);
  tcase_add_test(tests, it_falls_when_the_floor_is_removed);
  tcase_add_test(tests, a_door_pushes_it);
  tcase_add_loop_test(tests, light_obstacles_are_pushed_away, 0, 2);
  tcase_add_test(tests, a_fish_stays_in_its_tank);
  tcase_add_test(tests, no_wall_is_passed_at_speed);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
