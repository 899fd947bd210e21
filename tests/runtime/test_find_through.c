/* Soft bodies that lie crosswise through each other come apart. */
#include <math.h>
#include <stdlib.h>

#include "collision_scenes.h"
#include "contact_scenes.h"
#include "harness.h"
#include "host_threads.h"
#include "momentum.h"
#include "shapes.h"
#include "skin_depth.h"
#include "state/world.h"

/* A soft bar along X about its character; its lattice is of 15 x 3 x 3 cells, its skin of 24 x 4 x 4. */
enum { LONG = 15, WIDE = 3, SKIN_LONG = 24, SKIN_WIDE = 4, MAX = 512 };
static const float LENGTH = 0.6f, THICK = 0.1f;

/* About `center`, along X or along Z. */
static void add_bar(scene *s, uint32_t body, sbf_vec3 center, bool along_z, float young_pa) {
  lattice_box box = lattice_box_make((sbf_vec3){-0.5f * LENGTH, -0.5f * THICK, -0.5f * THICK},
      (sbf_vec3){LENGTH, THICK, THICK}, LONG, WIDE, WIDE, 1000, young_pa, 0.3f);
  sbf_polygon_mesh bar = shape_bar(s->asset, SKIN_LONG, SKIN_WIDE, LENGTH, THICK);
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)bar.positions.at;
  for (uint32_t i = 0; i < bar.positions.count; i++) at[i].x -= 0.5f * LENGTH;
  for (uint32_t k = 0; k < 2; k++) {
    sbf_vec3 *list = k ? at : box.positions;
    uint32_t count = k ? bar.positions.count : box.point_count;
    for (uint32_t i = 0; i < count; i++) {
      sbf_vec3 x = along_z ? (sbf_vec3){-list[i].z, list[i].y, list[i].x} : list[i];
      list[i] = (sbf_vec3){x.x + center.x, x.y + center.y, x.z + center.z};
    }
  }
  contact_scene_soft_box(s, body, &box, &bar);
}

static scene begin_bar(float young_pa) {
  scene s = rigid_begin();
  scene_bodies(&s, 1);
  add_bar(&s, 0, (sbf_vec3){0, 0, 0}, false, young_pa);
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  return s;
}

static sbr_character_id another(scene *s, sbf_vec3 off, float heading) {
  sbr_character_definition d = s->character_definition;
  sbr_character_id id;
  d.position.x += (double)off.x, d.position.y += (double)off.y, d.position.z += (double)off.z;
  d.heading = heading;
  ck_assert(sbr_character_create(s->world, s->model, &d, &id, NULL) == SBF_OK);
  return id;
}

static uint32_t check(const scene *s, sbr_character_id who, uint32_t body, sbf_vec3 at[MAX]) {
  sbr_double3 o = sbr_character_get_origin(s->world, who);
  uint32_t count = sbr_character_get_surface(s->world, who, body, at, MAX);
  for (uint32_t i = 0; i < count; i++)
    at[i] = (sbf_vec3){at[i].x + (float)o.x, at[i].y + (float)o.y, at[i].z + (float)o.z};
  return count;
}

/* Of the first body of one in the last of the other. */
static double deepest(const scene *s, sbr_character_id one, sbr_character_id other) {
  static sbf_vec3 a[MAX], b[MAX];
  const sbf_polygon_mesh *mesh = &s->asset->soft_bodies.at[0].surface;
  uint32_t count = check(s, one, 0, a);
  ck_assert_uint_eq(check(s, other, s->asset->soft_bodies.count - 1, b), count);
  double max = 0;
  for (uint32_t i = 0; i < count; i++)
    max = fmax(max, fmax(skin_depth(mesh, b, a[i], UINT32_MAX), skin_depth(mesh, a, b[i], UINT32_MAX)));
  return max;
}

/* Where the second lies: by so much off, and turned about Y. */
typedef struct crosswise {
  sbf_vec3 off;
  float heading;
} crosswise;
static const crosswise positions[] = {
    {{0, 0.005f, 0}, 1.5708f},
    {{0.11f, 0.03f, 0.06f}, 1.5708f},
    {{0.02f, -0.02f, 0.05f}, 0.9f},
    {{0, 0, 0}, 1.2f},
};

static scene begin_crosswise(const crosswise *at, sbr_tasks tasks, sbr_character_id *other) {
  scene s = begin_bar(1e5f);
  s.world_definition.tasks = tasks;
  contact_scene_start(&s);
  *other = another(&s, at->off, at->heading);
  return s;
}

/* They separate at about 0.2 m/s, the recovery speed, without gaining speed or momentum. */
START_TEST(crossed_bars_separate)
{
  sbr_character_id other;
  scene s = begin_crosswise(&positions[_i], (sbr_tasks){0}, &other);
  ck_assert_double_ge(deepest(&s, s.character, other), 0.035);
  double speed = 0;
  for (int i = 0; i < 180; i++) {
    scene_ticks(&s, 1);
    if (i > 3)
      speed = fmax(speed, fmax(contact_scene_fastest(&s, s.character), contact_scene_fastest(&s, other)));
  }
  scene_momentum after = scene_momentum_of(&s);
  ck_assert_double_le(deepest(&s, s.character, other), 5e-4);
  ck_assert_double_le(speed, 0.5);
  for (int k = 0; k < 3; k++) ck_assert_double_le(fabs(after.linear[k]), 1e-4 * after.mass);
  ck_assert(!sbr_character_get_body_health(s.world, other, 0).inverted);
  scene_free(&s);
}
END_TEST

/* The same bits for any number of threads, and from a snapshot taken meanwhile, which stores the path out. */
START_TEST(separation_is_equal_on_threads_and_from_snapshots)
{
  uint64_t hashes[2];
  for (int i = 0; i < 2; i++) {
    int threads = i ? 3 : 1;
    sbr_character_id other;
    scene s = begin_crosswise(&positions[1], (sbr_tasks){.run = run_on_threads, .user = &threads}, &other);
    scene_ticks(&s, 12);
    size_t size = sbr_world_get_snapshot_size(s.world);
    unsigned char *kept = malloc(size);
    ck_assert(sbr_world_save_snapshot(s.world, kept, size) == SBF_OK);
    scene_ticks(&s, 30);
    hashes[i] = sbr_world_get_state_hash(s.world);
    ck_assert(sbr_world_restore_snapshot(s.world, kept, size) == SBF_OK);
    scene_ticks(&s, 30);
    ck_assert_uint_eq(hashes[i], sbr_world_get_state_hash(s.world));
    free(kept);
    scene_free(&s);
  }
  ck_assert_uint_eq(hashes[0], hashes[1]);
}
END_TEST

/* ---- Parts of one character ---- */

static scene begin_two_bars(sbf_vec3 off) {
  scene s = rigid_begin();
  scene_bodies(&s, 2);
  add_bar(&s, 0, (sbf_vec3){0, 0, 0}, false, 1e5f);
  add_bar(&s, 1, off, true, 1e5f);
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  contact_scene_start(&s);
  return s;
}

/* Moves all of its points at once, from their present positions. */
static void shift(const scene *s, uint32_t body, sbf_vec3 by) {
  sbri_character *c = sbri_character_of(s->world, s->character);
  const sbri_body *b = &c->model->bodies[body];
  sbri_point *points = sbri_positions(c) + c->model->islands[b->island].first_slot;
  for (uint32_t slot = b->slots.begin; slot < b->slots.real_end; slot++)
    points[slot].x += by.x, points[slot].y += by.y, points[slot].z += by.z;
}

/* Two that are separate at rest, placed through each other: they separate like two characters. */
START_TEST(interpenetrating_parts_of_one_body_separate)
{
  static const sbf_vec3 put[3] = {{0, 0.005f, 0}, {0.11f, 0.03f, 0.06f}, {0.02f, -0.06f, 0.25f}};
  scene s = begin_two_bars((sbf_vec3){0, 0.2f, 0});
  shift(&s, 1, (sbf_vec3){put[_i].x, put[_i].y - 0.2f, put[_i].z});
  double speed = 0;
  for (int i = 0; i < 180; i++) {
    scene_ticks(&s, 1);
    if (i == 0) ck_assert_double_ge(deepest(&s, s.character, s.character), 0.025);
    if (i > 3) speed = fmax(speed, contact_scene_fastest(&s, s.character));
  }
  scene_momentum after = scene_momentum_of(&s);
  ck_assert_double_le(deepest(&s, s.character, s.character), 5e-4);
  ck_assert_double_le(speed, 0.5);
  for (int k = 0; k < 3; k++) ck_assert_double_le(fabs(after.linear[k]), 1e-4 * after.mass);
  scene_free(&s);
}
END_TEST

/* Two that lie through each other at rest stay as they are. */
START_TEST(parts_that_overlap_at_rest_stay_at_rest)
{
  scene s = begin_two_bars((sbf_vec3){0.02f, 0.03f * (float)_i, 0.05f});
  static sbf_vec3 before[MAX], after[MAX];
  uint32_t count = check(&s, s.character, 1, before);
  ck_assert_double_ge(deepest(&s, s.character, s.character), 0.01);
  for (int i = 0; i < 120; i++) {
    scene_ticks(&s, 1);
    ck_assert_double_le(contact_scene_fastest(&s, s.character), 1e-4);
  }
  (void)check(&s, s.character, 1, after);
  for (uint32_t i = 0; i < count; i++) ck_assert_float_le(sbri_length(sbri_sub(after[i], before[i])), 1e-5f);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("find_through");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, crossed_bars_separate, 0, sizeof positions / sizeof *positions);
  tcase_add_test(tests, separation_is_equal_on_threads_and_from_snapshots);
  tcase_add_loop_test(tests, interpenetrating_parts_of_one_body_separate, 0, 3);
  tcase_add_loop_test(tests, parts_that_overlap_at_rest_stay_at_rest, 0, 3);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
