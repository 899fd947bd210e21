/* A cloth whose tear jumps from one side of a point to the other. The point is the last connection of the
 * halves, and splits. */
#include <stdlib.h>
#include <string.h>

#include "event_log.h"
#include "harness.h"
#include "model/kernels.h"
#include "momentum.h"
#include "scene_state.h"
#include "scenes.h"
#include "state/state.h"
#include "state/world.h"

enum { CELLS = 6, MIDDLE = CELLS / 2, POINTS = (CELLS + 1) * (CELLS + 1), SPRINGS = 4 * CELLS * (CELLS + 1) };
static const sbf_scheme schemes[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN};
static scene s;
static sbf_vec3 positions[POINTS];

static uint32_t point(uint32_t x, uint32_t z) {
  return x * (CELLS + 1) + z;
}
/* -1 and 1: of the halves; 0: the point between them. */
static int side_of(uint32_t x, uint32_t z) {
  if (x != MIDDLE) return x < MIDDLE ? -1 : 1;
  return z < MIDDLE ? -1 : z > MIDDLE;
}

typedef struct spring_list {
  sbf_uint2 ends[SPRINGS];
  uint32_t count;
} spring_list;
static spring_list weak, strong;

/* Springs between the halves are weak, all others never tear. */
static void add(uint32_t x, uint32_t z, uint32_t to_x, uint32_t to_z) {
  if (to_x > CELLS || to_z > CELLS) return; /* one also below 0 */
  spring_list *list = side_of(x, z) * side_of(to_x, to_z) < 0 ? &weak : &strong;
  list->ends[list->count++] = (sbf_uint2){{point(x, z), point(to_x, to_z)}};
}

static void fill_set(sbf_spring_set *set, const spring_list *list, float stiffness_n_m, float tear_strain) {
  sbf_spring_set_init(set);
  float *stiffness = sbf_asset_allocate(s.asset, 1, sizeof *stiffness);
  *stiffness = stiffness_n_m;
  set->ends = (sbf_uint2_list){list->ends, list->count};
  set->stiffness = (sbf_f32_list){stiffness, 1};
  set->tear_strain = tear_strain;
  float *pressed = sbf_asset_allocate(s.asset, 1, sizeof *pressed);
  *pressed = 0.5f; /* rows that move keep the slack of their springs */
  set->compression_ratio = (sbf_f32_list){pressed, 1};
}

static void pull_apart(void) {
  sbri_character *c = &s.world->characters[0];
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++) {
    float *v = scene_velocity(&s, i);
    if (!(s.model->islands[0].masses[i] > 0)) continue;
    float x = sbri_positions(c)[i].x - 0.5f;
    v[0] = (x < 0 ? -2.0f : x > 0 ? 2.0f : 0) + 0.1f, v[SBRI_BLOCK] = 0.2f * x;
  }
}

static void begin(sbf_scheme scheme, uint32_t tear_points) {
  static float masses[POINTS];
  weak.count = strong.count = 0;
  for (uint32_t x = 0; x <= CELLS; x++)
    for (uint32_t z = 0; z <= CELLS; z++) {
      positions[point(x, z)] = (sbf_vec3){(float)x / CELLS, 0, (float)z / CELLS};
      masses[point(x, z)] = 1.0f / POINTS;
      add(x, z, x + 1, z), add(x, z, x, z + 1), add(x, z, x + 1, z + 1), add(x, z, x + 1, z - 1);
    }
  s = scene_begin();
  sbf_level *level = scene_points(&s, 0, positions, masses, POINTS);
  sbf_spring_set *sets = sbf_asset_allocate(s.asset, 2, sizeof *sets);
  fill_set(&sets[0], &weak, 5, 0.3f), fill_set(&sets[1], &strong, 50, 50);
  level->springs = (sbf_spring_set_list){sets, 2};
  s.model_options.scheme = scheme, s.model_options.tear_points = tear_points;
  s.world_definition.has_gravity = true, s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  pull_apart();
}

/* Number of parts of the used points that are connected by whole springs. Links and rows of points must
 * agree. */
static uint32_t count_parts(void) {
  const sbri_character *c = &s.world->characters[0];
  const sbri_island island = sbri_island_now(c, &s.model->islands[0]);
  const float *strengths = sbri_strengths(c);
  static uint32_t group[2 * POINTS + 2 * SBRI_BLOCK];
  uint32_t parts = 0, whole = 0, rows = 0;
  ck_assert_uint_le(island.slot_count, sizeof group / sizeof *group);
  for (uint32_t i = 0; i < island.slot_count; i++) group[i] = i;
  for (bool changed = true; changed;) {
    changed = false, whole = 0;
    for (uint32_t i = 0; i < island.links.block_count * SBRI_BLOCK; i++) {
      const sbri_link_block *link = &island.links.blocks[i / SBRI_BLOCK];
      uint32_t a = link->a[i % SBRI_BLOCK], b = link->b[i % SBRI_BLOCK];
      if (a == b || !(strengths[i] > 0)) continue;
      uint32_t min = group[a] < group[b] ? group[a] : group[b];
      changed = changed || group[a] != group[b];
      group[a] = group[b] = min, whole++;
    }
  }
  for (uint32_t slot = 0; slot < island.free_count; slot++) {
    uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    for (uint32_t cell = island.cells.begins[block]; cell < island.cells.ends[block]; cell++) {
      uint32_t at = island.cells.links[cell * SBRI_BLOCK + lane], other = island.cells.at[cell].others[lane];
      const sbri_link_block *link = &island.links.blocks[at / SBRI_BLOCK];
      if (other == slot || !(strengths[at] > 0)) continue;
      uint32_t a = link->a[at % SBRI_BLOCK], b = link->b[at % SBRI_BLOCK];
      ck_assert((a == slot && b == other) || (a == other && b == slot));
      if (island.cells.slack) ck_assert_float_eq(island.cells.slack[cell * SBRI_BLOCK + lane], 0.5f);
      rows++;
    }
    parts += group[slot] == slot && island.masses[slot] > 0;
  }
  ck_assert_uint_eq(rows, 2 * whole);
  return parts;
}
static uint32_t count_copies(void) {
  uint32_t copies = 0;
  for (uint32_t i = s.model->bodies[0].slots.first_spare; i < s.model->bodies[0].slots.real_end; i++)
    copies += sbri_origins(&s.world->characters[0])[i] != SBRI_UNUSED;
  return copies;
}

START_TEST(a_point_between_two_halves_splits)
{
  begin(schemes[_i], 0);
  scene_momentum before = scene_momentum_of(&s);
  ck_assert_uint_eq(count_parts(), 1);
  scene_ticks(&s, 60);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(health.finite);
  ck_assert_uint_eq(health.torn, weak.count);
  ck_assert_uint_eq(health.unsplit, 0);
  ck_assert_uint_eq(health.recoveries, 0);
  ck_assert_uint_eq(count_copies(), 1);
  ck_assert_uint_eq(count_parts(), 2);
  ck_assert_float_lt(health.max_strain, 1);
  scene_momentum after = scene_momentum_of(&s);
  ck_assert_double_eq_tol(after.mass, 1, 1e-5);
  for (int k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(after.linear[k], before.linear[k], 1e-4);
    ck_assert_double_eq_tol(after.angular[k], before.angular[k], 5e-3);
  }
  float left = scene_point(&s, 0, point(0, MIDDLE)).x, right = scene_point(&s, 0, point(CELLS, MIDDLE)).x;
  ck_assert_float_gt(right - left, 1.8f); /* the halves fly on */
  sbr_character_reset(s.world, s.character);
  ck_assert_uint_eq(count_parts(), 1);
  ck_assert_uint_eq(count_copies(), 0);
  scene_free(&s);
}
END_TEST

/* A rope is connected to itself at each of its points, and single springs carry the load. */
START_TEST(parts_never_connected_stay_separate)
{
  enum { LINKS = 8 };
  s = scene_begin();
  scene_chain(&s, 0, (sbf_vec3){0.1f, 0, 0}, LINKS, 5, 0.1f, 0.1f);
  scene_body(&s, 0)->attributes.tear_strain = 0.4f;
  s.model_options.scheme = schemes[_i];
  s.world_definition.has_gravity = true, s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  pull_apart();
  scene_ticks(&s, 60);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(health.finite);
  ck_assert_uint_gt(health.torn, 0);
  ck_assert_uint_eq(count_copies(), 0);
  ck_assert_uint_eq(count_parts(), health.torn + 1);
  scene_free(&s);
}
END_TEST

START_TEST(a_snapshot_stores_the_split)
{
  begin(schemes[_i], 0);
  scene_ticks(&s, 2);
  size_t size = sbr_world_get_snapshot_size(s.world);
  void *bytes = malloc(size);
  uint64_t hashes[2];
  ck_assert_int_eq(sbr_world_save_snapshot(s.world, bytes, size), SBF_OK);
  for (int n = 0; n < 2; n++) {
    scene_ticks(&s, 40);
    ck_assert_uint_eq(count_parts(), 2);
    hashes[n] = sbr_world_get_state_hash(s.world);
    if (n) break;
    ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_OK);
    ck_assert_uint_eq(count_parts(), 1);
  }
  ck_assert_uint_eq(hashes[0], hashes[1]);
  free(bytes);
  scene_free(&s);
}
END_TEST

START_TEST(every_lane_width_gives_the_same_bits)
{
  uint64_t hashes[2];
  for (int n = 0; n < 2; n++) {
    begin(schemes[_i], 0);
    if (n) s.model->kernels = &sbri_kernels_scalar;
    scene_ticks(&s, 60);
    ck_assert_uint_eq(count_parts(), 2);
    hashes[n] = sbr_world_get_state_hash(s.world);
    scene_free(&s);
  }
  ck_assert_uint_eq(hashes[0], hashes[1]);
}
END_TEST

/* Space for one copy, which is used up the second time. */
START_TEST(insufficient_storage_is_reported)
{
  begin(SBF_SCHEME_SYMPLECTIC, 1);
  scene_ticks(&s, 60);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).unsplit, 0);
  ck_assert_uint_eq(count_copies(), 1);
  sbri_character *c = &s.world->characters[0];
  sbri_tears_of(c)[0].count = 0;
  sbr_character_reset(s.world, s.character);
  sbri_origins(c)[s.model->bodies[0].slots.first_spare] = 0; /* taken */
  pull_apart();
  event_log log = {.unsplit_count = 0};
  scene_ticks_logged(&s, 60, &log);
  ck_assert_uint_gt(log.unsplit_count, 0);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert_uint_gt(health.unsplit, 0);
  ck_assert(health.finite);
  scene_free(&s);
}
END_TEST

/* Two pinned points and a spring between them, and a third on a goal spring, which does not tear. */
START_TEST(untearable_bodies_reserve_no_storage)
{
  s = scene_begin();
  const sbf_vec3 at[3] = {{0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
  const float masses[3] = {1, 1, 1}, k = 100;
  const uint32_t pinned[3] = {0, 1, 2};
  static float weights[3] = {1, 1, 0.5f};
  scene_body(&s, 0)->attributes.tear_strain = 0.1f;
  sbf_level *level = scene_points(&s, 0, at, masses, 3);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &k, 1);
  scene_pin(&s, level, -1, pinned, 3);
  sbf_pin_set *set = (sbf_pin_set *)(uintptr_t)level->pins.at;
  set->weights = (sbf_f32_list){weights, 3};
  set->stiffness = 200;
  scene_start(&s);
  const sbri_body *body = &s.model->bodies[0];
  ck_assert(!s.model->splits);
  ck_assert_uint_eq(
      body->slots.first_spare, body->slots.real_end); /* whose origins would lie beyond the state */
  scene_ticks(&s, 5);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  scene_free(&s);
}
END_TEST

START_TEST(memory_may_run_out)
{
  begin(SBF_SCHEME_SYMPLECTIC, 0);
  scene_models_survive_want(&s);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("split_springs");
  TCase *c = tcase_create("split_springs");
  tcase_add_loop_test(c, a_point_between_two_halves_splits, 0, 3);
  tcase_add_loop_test(c, parts_never_connected_stay_separate, 0, 3);
  tcase_add_loop_test(c, a_snapshot_stores_the_split, 0, 3);
  tcase_add_loop_test(c, every_lane_width_gives_the_same_bits, 0, 3);
  tcase_add_test(c, insufficient_storage_is_reported);
  tcase_add_test(c, untearable_bodies_reserve_no_storage);
  tcase_add_test(c, memory_may_run_out);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
