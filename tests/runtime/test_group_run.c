/* Bodies of characters that meet each other. */
#include <math.h>
#include <stdlib.h>

#include "collision_scenes.h"
#include "contact_scenes.h"
#include "harness.h"
#include "host_threads.h"
#include "momentum.h"
#include "state/world.h"

static const sbf_vec3 weight = {0, -9.81f, 0};

static double size(sbf_vec3 v) {
  return sqrt((double)(v.x * v.x + v.y * v.y + v.z * v.z));
}

/* ---- Momentum ---- */

static double off(const scene_momentum *a, const scene_momentum *b) {
  double worst = 0;
  for (int k = 0; k < 3; k++) {
    worst = fmax(worst, fabs(a->linear[k] - b->linear[k]));
    worst = fmax(worst, fabs(a->angular[k] - b->angular[k]));
  }
  return worst;
}

/* ---- Rigid with rigid ---- */

START_TEST(boxes_stand_on_each_other)
{
  enum { BOXES = 6 };
  scene s = contact_scene_begin(weight);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  for (int i = 0; i < BOXES; i++)
    rigid_box(&s, (sbf_vec3){0.01f * (float)(i % 2), 0.101f + 0.202f * (float)i, 0},
        (sbf_vec3){0.2f, 0.2f, 0.2f}, i == 5 ? 5 : 1);
  contact_scene_start(&s);
  scene_ticks(&s, 300);
  for (uint32_t i = 0; i < BOXES; i++) {
    ck_assert_float_eq_tol(rigid_state(&s, i).center.y, 0.1f + 0.2f * (float)i, 2e-3f);
    ck_assert_double_le(size(rigid_state(&s, i).velocity), 1e-3);
  }
  scene_free(&s);
}
END_TEST

START_TEST(a_hit_conserves_momentum)
{
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.3f, 0.2f}, 1);
  rigid_box(&s, (sbf_vec3){0, 0.1f, 1}, (sbf_vec3){0.2f, 0.2f, 0.4f}, 30);
  rigid_body(&s, 0)->friction = 0.5f;
  contact_scene_start(&s);
  contact_scene_throw(&s, s.character, 0, (sbf_vec3){0.2f, 0, 4});
  scene_momentum before = scene_momentum_of(&s);
  scene_ticks(&s, 60);
  scene_momentum after = scene_momentum_of(&s);
  ck_assert_double_le(off(&before, &after), 1e-5);
  ck_assert_double_ge(size(rigid_state(&s, 1).velocity), 0.02);
  scene_free(&s);
}
END_TEST

/* Two boxes of the same mass, face to face: they part with e times the speed. */
START_TEST(boxes_bounce_by_their_restitution)
{
  const float es[3] = {0, 0.5f, 0.8f};
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  for (uint32_t i = 0; i < 2; i++) {
    rigid_box(&s, (sbf_vec3){0, 0, (float)i}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
    rigid_body(&s, i)->restitution = es[_i];
  }
  contact_scene_start(&s);
  contact_scene_throw(&s, s.character, 0, (sbf_vec3){0, 0, 2});
  scene_ticks(&s, 60);
  double separation = (double)(rigid_state(&s, 1).velocity.z - rigid_state(&s, 0).velocity.z);
  ck_assert_double_eq_tol(separation / 2, (double)es[_i], 0.02);
  scene_free(&s);
}
END_TEST

/* On a slab that slides on the ground: slows down by friction, and draws the slab along. */
START_TEST(friction_is_mutual)
{
  scene s = contact_scene_begin(weight);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  rigid_box(&s, (sbf_vec3){0, 0.1f, 0}, (sbf_vec3){4, 0.2f, 4}, 4);
  rigid_box(&s, (sbf_vec3){0, 0.3f, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  rigid_body(&s, 0)->friction = 0.05f, rigid_body(&s, 1)->friction = 1.8f; /* 0.3 between them */
  contact_scene_start(&s);
  contact_scene_throw(&s, s.character, 1, (sbf_vec3){2, 0, 0});
  scene_ticks(&s, 12);
  double v = (double)rigid_state(&s, 1).velocity.x, slab = (double)rigid_state(&s, 0).velocity.x;
  double drag = 0.3 * 9.81 * 0.2, ground = 0.05 * 5 * 9.81 * 0.2;
  ck_assert_double_eq_tol(v, 2 - drag, 0.02);
  ck_assert_double_eq_tol(slab, (drag - ground) / 4, 0.01);
  scene_free(&s);
}
END_TEST

/* ---- Soft with rigid ---- */

START_TEST(a_sheet_carries_fallen_bodies)
{
  scene s = contact_scene_begin(weight);
  scene_bodies(&s, 1);
  collision_sheet(&s, 0, (sbf_vec3){0, 0, 0}, 1, 16, true);
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  rigid_box(&s, (sbf_vec3){0.05f, 0.3f, 0}, (sbf_vec3){0.2f, 0.1f, 0.2f}, 0.1f);
  contact_scene_start(&s);
  double min = 9, fastest = 0; /* of the last second */
  for (int i = 0; i < 240; i++) {
    scene_ticks(&s, 1);
    min = fmin(min, (double)rigid_state(&s, 0).center.y);
    if (i >= 180) fastest = fmax(fastest, (double)size(rigid_state(&s, 0).velocity));
  }
  ck_assert_double_ge(min, -0.4);
  ck_assert_double_le(fastest, 0.4); /* it swings on the sheet: fell at 2.2 m/s */
  scene_free(&s);
}
END_TEST

START_TEST(a_fast_ball_does_not_pass_a_sheet)
{
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  scene_bodies(&s, 1);
  collision_sheet(&s, 0, (sbf_vec3){0, 0, 0}, 1, 24, false);
  rigid_box(&s, (sbf_vec3){0, 3, 0}, (sbf_vec3){0.05f, 0.05f, 0.05f}, 0.05f);
  contact_scene_start(&s);
  contact_scene_throw(&s, s.character, 0, (sbf_vec3){0, -5, 0});
  scene_momentum before = scene_momentum_of(&s);
  for (int i = 0; i < 20; i++) {
    scene_ticks(&s, 1);
    ck_assert_float_le(scene_point(&s, 0, 312).y, rigid_state(&s, 0).center.y);
  }
  scene_momentum after = scene_momentum_of(&s);
  for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(before.linear[k], after.linear[k], 1e-4);
  scene_free(&s);
}
END_TEST

/* Over a ball of 4 kg that lies on the ground and is then pushed away under it: no point gets inside,
 * nor nearer than half a millimetre of the five that the cloth keeps. */
START_TEST(cloth_rests_on_a_moving_ball)
{
  scene s = contact_scene_begin(weight);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  scene_bodies(&s, 1);
  collision_sheet(&s, 0, (sbf_vec3){0, 0.75f, 0}, 0.9f, 24, false);
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  rigid_box(&s, (sbf_vec3){0, 0.3f, 0}, (sbf_vec3){0.6f, 0.6f, 0.6f}, 4);
  contact_scene_ball(&s, 0, 0.3f);
  contact_scene_start(&s);
  double max = -9;
  for (int i = 0; i < 150; i++) {
    if (i == 60) contact_scene_throw(&s, s.character, 0, (sbf_vec3){6, 0, 0});
    scene_ticks(&s, 1);
    max = fmax(max, contact_scene_deepest(&s));
  }
  ck_assert_double_le(max, -5e-4);
  ck_assert_float_ge(rigid_state(&s, 0).center.x, 0.5f);
  scene_free(&s);
}
END_TEST

/* ---- Soft with soft ---- */

enum { CELLS = 3 };

/* The sides of the box over all its points. */
static void cube_surface(scene *s, uint32_t body, const lattice_box *box) {
  enum { MAX = 6 * CELLS * CELLS };
  uint32_t *sizes = sbf_asset_allocate(s->asset, MAX, sizeof *sizes);
  uint32_t *corners = sbf_asset_allocate(s->asset, 4 * MAX, sizeof *corners);
  sbf_vec3 *at = sbf_asset_allocate(s->asset, box->point_count, sizeof *at);
  uint32_t count = 0;
  ck_assert(sizes && corners && at);
  for (uint32_t i = 0; i < box->point_count; i++) at[i] = box->positions[i];
  for (uint32_t axis = 0; axis < 3; axis++)
    for (uint32_t far = 0; far < 2; far++)
      for (uint32_t u = 0; u < CELLS; u++)
        for (uint32_t v = 0; v < CELLS; v++, count++) {
          static const uint32_t turns[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
          sizes[count] = 4;
          for (int k = 0; k < 4; k++) {
            uint32_t c[3], turn = (uint32_t)(far ? k : 3 - k);
            c[axis] = far * CELLS;
            c[(axis + 1) % 3] = u + turns[turn][0], c[(axis + 2) % 3] = v + turns[turn][1];
            corners[4 * count + (uint32_t)k] = lattice_box_point(box, c[0], c[1], c[2]);
          }
        }
  sbf_polygon_mesh *mesh = &scene_body(s, body)->surface;
  mesh->positions = (sbf_vec3_list){at, box->point_count};
  mesh->polygon_sizes = (sbf_u32_list){sizes, count};
  mesh->polygon_points = (sbf_u32_list){corners, 4 * count};
}

static void cube(scene *s, uint32_t body, sbf_vec3 low, float side, float density) {
  lattice_box box =
      lattice_box_make(low, (sbf_vec3){side, side, side}, CELLS, CELLS, CELLS, density, 1e5f, 0.3f);
  (void)scene_lattice(s, body, &box);
  cube_surface(s, body, &box);
  scene_body(s, body)->attributes.damping_ratio = 0.1f;
  scene_body(s, body)->attributes.friction = 0.5f;
  lattice_box_free(&box);
}

/* Minimum and maximum height of a body's points, relative to the character's origin. */
static void heights(const scene *s, uint32_t body, float *min, float *max) {
  static sbf_vec3 at[512];
  uint32_t count = scene_read(s, body, at, 512);
  *min = 1e9f, *max = -1e9f;
  for (uint32_t i = 0; i < count; i++) {
    *min = at[i].y < *min ? at[i].y : *min;
    *max = at[i].y > *max ? at[i].y : *max;
  }
}

static double fastest_of(const scene *s) {
  double fastest = 0;
  const sbri_character *c = sbri_character_of(s->world, s->character);
  for (uint32_t k = 0; k < c->model->island_count; k++)
    for (uint32_t slot = 0; slot < c->model->islands[k].free_count; slot++)
      fastest = fmax(fastest, size(scene_slot_velocity(c, &c->model->islands[k], slot)));
  return fastest;
}

START_TEST(soft_cubes_stand_on_each_other)
{
  scene s = contact_scene_begin(weight);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  scene_bodies(&s, 3);
  cube(&s, 0, (sbf_vec3){0, 0.001f, 0}, 0.3f, 1000);
  cube(&s, 1, (sbf_vec3){0.04f, 0.305f, 0.05f}, 0.2f, 1000);
  cube(&s, 2, (sbf_vec3){0.06f, 0.509f, 0.08f}, 0.15f, 500);
  contact_scene_start(&s);
  float min[3], max[3];
  scene_ticks(&s, 300);
  for (uint32_t i = 0; i < 3; i++) { heights(&s, i, &min[i], &max[i]); }
  for (int i = 0; i < 2; i++) ck_assert_float_ge(min[i + 1], max[i] - 0.01f);
  ck_assert_float_ge(max[2], 0.62f);
  scene_ticks(&s, 60);
  ck_assert_double_le(fastest_of(&s), 1e-3);
  scene_free(&s);
}
END_TEST

START_TEST(a_soft_cube_rests)
{
  scene s = contact_scene_begin(weight);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  scene_bodies(&s, 1);
  cube(&s, 0, (sbf_vec3){0, 0.001f, 0}, 0.3f, 1000);
  contact_scene_start(&s);
  scene_ticks(&s, 360);
  for (int i = 0; i < 12; i++) {
    scene_ticks(&s, 1);
    ck_assert_double_le(fastest_of(&s), 1e-3);
  }
  scene_free(&s);
}
END_TEST

/* Contact impulses continue from a snapshot as without it. */
START_TEST(snapshots_store_contact_impulses)
{
  scene s = contact_scene_begin(weight);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  for (int i = 0; i < 3; i++)
    rigid_box(&s, (sbf_vec3){0.03f * (float)(i % 2), 0.101f + 0.202f * (float)i, 0},
        (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  contact_scene_start(&s);
  scene_ticks(&s, 20);
  size_t size = sbr_world_get_snapshot_size(s.world);
  unsigned char *kept = malloc(size);
  ck_assert(sbr_world_save_snapshot(s.world, kept, size) == SBF_OK);
  scene_ticks(&s, 40);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  ck_assert(sbr_world_restore_snapshot(s.world, kept, size) == SBF_OK);
  scene_ticks(&s, 40);
  ck_assert_uint_eq(hash, sbr_world_get_state_hash(s.world));
  free(kept);
  scene_free(&s);
}
END_TEST

/* At 60 m/s they are compressed flat within a tick and need shorter steps. Otherwise they would lose their
 * shape and be put back into the rest shape. */
START_TEST(soft_cubes_of_two_characters_conserve_momentum)
{
  const float speeds[3] = {2, 40, 60}, thrown = speeds[_i];
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  scene_bodies(&s, 1);
  cube(&s, 0, (sbf_vec3){-0.1f, -0.1f, -0.1f}, 0.2f, 2000);
  contact_scene_start(&s);
  sbr_character_id other =
      contact_scene_another(&s, (sbr_double3){0.05, s.character_definition.position.y, 0.4});
  sbri_character *c = sbri_character_of(s.world, s.character);
  const sbri_island *island = &c->model->islands[0];
  for (uint32_t slot = 0; slot < island->free_count; slot++)
    sbri_velocities(c)[3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + 2 * SBRI_BLOCK + slot % SBRI_BLOCK] = thrown;
  scene_momentum before = scene_momentum_of(&s);
  scene_ticks(&s, 60);
  scene_momentum after = scene_momentum_of(&s);
  const sbri_character *second = sbri_character_of(s.world, other);
  double speed = 0;
  for (uint32_t slot = 0; slot < island->free_count; slot++)
    speed += (double)scene_slot_velocity(second, island, slot).z / island->free_count;
  for (int k = 0; k < 3; k++)
    ck_assert_double_eq_tol(before.linear[k], after.linear[k], 1e-4 * before.linear[2]);
  ck_assert_double_ge(speed, 0.4 * (double)thrown);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).recoveries, 0);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, other, 0).recoveries, 0);
  scene_free(&s);
}
END_TEST

/* Overlaps at rest stay; bodies excluded by filters pass through each other. */
START_TEST(overlap_at_rest_causes_no_impulses)
{
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  scene_bodies(&s, 2);
  cube(&s, 0, (sbf_vec3){0, 0, 0}, 0.2f, 1000);
  cube(&s, 1, (sbf_vec3){0.15f, 0.02f, 0.02f}, 0.2f, 1000);
  rigid_box(&s, (sbf_vec3){0.1f, 0.1f, 0.1f}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 1);
  rigid_box(&s, (sbf_vec3){0.15f, 0.1f, 0.1f}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 1);
  contact_scene_start(&s);
  sbf_vec3 a = scene_point(&s, 0, 0), b = scene_point(&s, 1, 0);
  scene_ticks(&s, 60);
  sbf_vec3 a1 = scene_point(&s, 0, 0), b1 = scene_point(&s, 1, 0);
  ck_assert_float_le(fabsf(a1.x - a.x) + fabsf(b1.x - b.x), 1e-4f);
  ck_assert_double_le(size(rigid_state(&s, 0).velocity), 1e-4);
  scene_free(&s);
}
END_TEST

START_TEST(filters_disable_contacts)
{
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  rigid_box(&s, (sbf_vec3){0, 0, 1}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  rigid_body(&s, 0)->layer = 4, rigid_body(&s, 1)->mask = 3;
  contact_scene_start(&s);
  contact_scene_throw(&s, s.character, 0, (sbf_vec3){0, 0, 2});
  scene_ticks(&s, 60);
  ck_assert_float_eq_tol(rigid_state(&s, 0).velocity.z, 2, 1e-5f);
  ck_assert_float_eq(rigid_state(&s, 1).velocity.z, 0);
  scene_free(&s);
}
END_TEST

/* A heap of everything, several times: the same bits on any number of threads. */
static uint64_t run_heap(int threads) {
  scene s = contact_scene_begin(weight);
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.tasks = (sbr_tasks){.run = run_on_threads, .user = &threads};
  s.world_definition.sleep_after_s = 0.5;
  s.character_definition.position.y = 0;
  scene_bodies(&s, 2);
  cube(&s, 0, (sbf_vec3){0, 0.01f, 0}, 0.2f, 1000);
  collision_sheet(&s, 1, (sbf_vec3){0.1f, 0.5f, 0.1f}, 0.6f, 8, false);
  rigid_box(&s, (sbf_vec3){0.1f, 0.3f, 0.1f}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 1);
  rigid_box(&s, (sbf_vec3){0.12f, 0.42f, 0.1f}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 2);
  contact_scene_start(&s);
  (void)contact_scene_another(&s, (sbr_double3){0.05, 0.7, 0.05});
  (void)contact_scene_another(&s, (sbr_double3){3, 0, 0});
  scene_ticks(&s, 90);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  scene_free(&s);
  return hash;
}

START_TEST(any_number_of_threads_gives_the_same_bits)
{
  uint64_t one = run_heap(1);
  ck_assert_uint_eq(one, run_heap(3));
  ck_assert_uint_eq(one, run_heap(8));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("group_run");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, boxes_stand_on_each_other);
  tcase_add_test(tests, a_hit_conserves_momentum);
  tcase_add_loop_test(tests, boxes_bounce_by_their_restitution, 0, 3);
  tcase_add_test(tests, friction_is_mutual);
  tcase_add_test(tests, a_sheet_carries_fallen_bodies);
  tcase_add_test(tests, cloth_rests_on_a_moving_ball);
  tcase_add_test(tests, a_fast_ball_does_not_pass_a_sheet);
  tcase_add_test(tests, soft_cubes_stand_on_each_other);
  tcase_add_test(tests, a_soft_cube_rests);
  tcase_add_test(tests, snapshots_store_contact_impulses);
  tcase_add_loop_test(tests, soft_cubes_of_two_characters_conserve_momentum, 0, 3);
  tcase_add_test(tests, overlap_at_rest_causes_no_impulses);
  tcase_add_test(tests, filters_disable_contacts);
  tcase_add_test(tests, any_number_of_threads_gives_the_same_bits);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
