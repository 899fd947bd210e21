/* Soft bodies that lie crosswise through each other come apart. */
#include <math.h>
#include <stdlib.h>

#include "collision_scenes.h"
#include "harness.h"
#include "host_threads.h"
#include "momentum.h"
#include "rigid_scenes.h"
#include "shapes.h"
#include "skin_depth.h"
#include "world/world.h"

/* A soft bar along X about its character; its lattice is of 15 x 3 x 3 cells, its skin of 24 x 4 x 4. */
enum { LONG = 15, WIDE = 3, SKIN_LONG = 24, SKIN_WIDE = 4, MOST = 512 };
static const float LENGTH = 0.6f, THICK = 0.1f;

static scene begin_bar(float young_pa) {
  scene s = rigid_begin();
  scene_bodies(&s, 1);
  lattice_box box = lattice_box_make((sbf_vec3){-0.5f * LENGTH, -0.5f * THICK, -0.5f * THICK},
      (sbf_vec3){LENGTH, THICK, THICK}, LONG, WIDE, WIDE, 1000, young_pa, 0.3f);
  sbf_level *level = scene_lattice(&s, 0, &box);
  sbf_polygon_mesh bar = shape_bar(s.asset, SKIN_LONG, SKIN_WIDE, LENGTH, THICK);
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)bar.positions.at;
  for (uint32_t i = 0; i < bar.positions.count; i++) at[i].x -= 0.5f * LENGTH;
  scene_body(&s, 0)->surface = bar;
  scene_body(&s, 0)->surface.target = SBF_MESH_TARGET_SURFACE;
  scene_embed(&s, level, &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = 0.5f;
  scene_body(&s, 0)->attributes.friction = 0.5f;
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

static void start(scene *s) {
  scene_start(s);
  ck_assert(sbr_world_bodies_meet(s->world, 0, NULL) == SBF_OK);
}

static uint32_t look(const scene *s, sbr_character_id who, sbf_vec3 at[MOST]) {
  sbr_double3 o = sbr_character_origin(s->world, who);
  uint32_t count = sbr_character_surface(s->world, who, 0, at, MOST);
  for (uint32_t i = 0; i < count; i++)
    at[i] = (sbf_vec3){at[i].x + (float)o.x, at[i].y + (float)o.y, at[i].z + (float)o.z};
  return count;
}

static double deepest(const scene *s, sbr_character_id one, sbr_character_id other) {
  static sbf_vec3 a[MOST], b[MOST];
  const sbf_polygon_mesh *mesh = &s->asset->soft_bodies.at[0].surface;
  uint32_t count = look(s, one, a);
  ck_assert_uint_eq(look(s, other, b), count);
  double most = 0;
  for (uint32_t i = 0; i < count; i++)
    most = fmax(most, fmax(skin_depth(mesh, b, a[i], UINT32_MAX), skin_depth(mesh, a, b[i], UINT32_MAX)));
  return most;
}

static double fastest(const scene *s, sbr_character_id who) {
  const sbri_character *c = sbri_character_of(s->world, who);
  double most = 0;
  for (uint32_t slot = 0; slot < c->model->islands[0].free_count; slot++)
    most = fmax(most, (double)sbri_length(scene_slot_velocity(c, &c->model->islands[0], slot)));
  return most;
}

/* Where the second lies: by so much off, and turned about Y. */
typedef struct crosswise {
  sbf_vec3 off;
  float heading;
} crosswise;
static const crosswise places[] = {
    {{0, 0.005f, 0}, 1.5708f},
    {{0.11f, 0.03f, 0.06f}, 1.5708f},
    {{0.02f, -0.02f, 0.05f}, 0.9f},
    {{0, 0, 0}, 1.2f},
};

static scene begin_crosswise(const crosswise *at, sbr_tasks tasks, sbr_character_id *other) {
  scene s = begin_bar(1e5f);
  s.world_definition.tasks = tasks;
  start(&s);
  *other = another(&s, at->off, at->heading);
  return s;
}

/* At the speed that they are let out with, about 0.2 m/s, not thrown about, and with the momentum that they
 * had. */
START_TEST(bars_that_lie_crosswise_come_apart)
{
  sbr_character_id other;
  scene s = begin_crosswise(&places[_i], (sbr_tasks){0}, &other);
  ck_assert_double_ge(deepest(&s, s.character, other), 0.035);
  double speed = 0;
  for (int i = 0; i < 180; i++) {
    scene_ticks(&s, 1);
    if (i > 3) speed = fmax(speed, fmax(fastest(&s, s.character), fastest(&s, other)));
  }
  scene_momentum after = scene_momentum_of(&s);
  ck_assert_double_le(deepest(&s, s.character, other), 5e-4);
  ck_assert_double_le(speed, 0.5);
  for (int k = 0; k < 3; k++) ck_assert_double_le(fabs(after.linear[k]), 1e-4 * after.mass);
  ck_assert(!sbr_character_health(s.world, other, 0).inverted);
  scene_free(&s);
}
END_TEST

/* On any number of threads, and from a snapshot on the way, which holds the way. */
START_TEST(the_way_out_is_of_the_same_bits)
{
  uint64_t hashes[2];
  for (int i = 0; i < 2; i++) {
    int threads = i ? 3 : 1;
    sbr_character_id other;
    scene s = begin_crosswise(&places[1], (sbr_tasks){.run = run_on_threads, .user = &threads}, &other);
    scene_ticks(&s, 12);
    size_t size = sbr_world_snapshot_size(s.world);
    unsigned char *kept = malloc(size);
    ck_assert(sbr_world_snapshot_save(s.world, kept, size) == SBF_OK);
    scene_ticks(&s, 30);
    hashes[i] = sbr_world_state_hash(s.world);
    ck_assert(sbr_world_snapshot_restore(s.world, kept, size) == SBF_OK);
    scene_ticks(&s, 30);
    ck_assert_uint_eq(hashes[i], sbr_world_state_hash(s.world));
    free(kept);
    scene_free(&s);
  }
  ck_assert_uint_eq(hashes[0], hashes[1]);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("find_through");
  TCase *tests = tcase_create("all");
  tcase_set_timeout(tests, 120);
  tcase_add_loop_test(tests, bars_that_lie_crosswise_come_apart, 0, sizeof places / sizeof *places);
  tcase_add_test(tests, the_way_out_is_of_the_same_bits);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
