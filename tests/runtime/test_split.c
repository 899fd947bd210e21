#include <stdlib.h>
#include <string.h>

#include "event_log.h"
#include "harness.h"
#include "mechanics/neo_hookean.h"
#include "model/kernels.h"
#include "momentum.h"
#include "scene_state.h"
#include "scenes.h"
#include "state/state.h"
#include "state/world.h"

/* A bar of 1 x 0.2 x 0.2 m, weakest in its middle, whose halves fly apart. */
static lattice_box box;
static scene s;
enum { COLUMNS = 20, ROWS = 3 }; /* quads of its skin, along the top */

static const float SPEED = 2; /* m/s: slow enough to tear at the weakest section */
static const float WEAK_FROM = 0.45f, WEAK_TO = 0.55f;

static void weaken_middle(void) {
  sbf_soft_body *body = scene_body(&s, 0);
  body->surface.positions = (sbf_vec3_list){box.positions, box.point_count};
  float *weights = sbf_asset_allocate(s.asset, box.point_count, sizeof *weights);
  for (uint32_t i = 0; i < box.point_count; i++)
    weights[i] = box.positions[i].x > WEAK_FROM && box.positions[i].x < WEAK_TO ? 0.5f : 1;
  sbf_weight_map *map = sbf_asset_allocate(s.asset, 1, sizeof *map);
  sbf_weight_map_init(map);
  map->property = SBF_WEIGHT_PROPERTY_TEAR_STRAIN;
  map->values = (sbf_f32_list){weights, box.point_count};
  body->weight_maps = (sbf_weight_map_list){map, 1};
}

/* The tetrahedron that contains the position, and its weights there. */
static sbf_uint4 find_element(sbfi_d3 at, sbf_vec4 *weights) {
  for (uint32_t t = 0; t < box.tetrahedron_count; t++) {
    sbfi_tetrahedron element;
    sbfi_d3 rest[4];
    for (int k = 0; k < 4; k++) rest[k] = sbfi_d3_of(box.positions[box.tetrahedra[t].at[k]]);
    ck_assert(sbfi_tetrahedron_make(&element, rest, sbfi_lame_of(1, 0.3)));
    sbfi_d3 off = sbfi_d3_sub(at, rest[0]);
    double w[4];
    for (int k = 1; k < 4; k++) w[k] = sbfi_d3_dot(element.gradients[k], off);
    w[0] = 1 - w[1] - w[2] - w[3];
    if (w[0] < -1e-6 || w[1] < -1e-6 || w[2] < -1e-6 || w[3] < -1e-6) continue;
    *weights = (sbf_vec4){(float)w[0], (float)w[1], (float)w[2], (float)w[3]};
    return box.tetrahedra[t];
  }
  ck_abort_msg("no tetrahedron is there");
}

static void add_skin(void) {
  enum { VERTICES = (COLUMNS + 1) * (ROWS + 1), QUADS = COLUMNS * ROWS };
  sbf_render_mesh *mesh = sbf_asset_allocate(s.asset, 1, sizeof *mesh);
  sbf_embedding *embedding = sbf_asset_allocate(s.asset, 1, sizeof *embedding);
  sbf_vec3 *positions = sbf_asset_allocate(s.asset, VERTICES, sizeof *positions);
  sbf_uint4 *points = sbf_asset_allocate(s.asset, VERTICES, sizeof *points);
  sbf_vec4 *weights = sbf_asset_allocate(s.asset, VERTICES, sizeof *weights);
  uint32_t *sizes = sbf_asset_allocate(s.asset, QUADS, sizeof *sizes);
  uint32_t *corners = sbf_asset_allocate(s.asset, 4 * QUADS, sizeof *corners), quad = 0;
  sbf_render_mesh_init(mesh);
  sbf_embedding_init(embedding);
  for (uint32_t i = 0; i <= COLUMNS; i++)
    for (uint32_t k = 0; k <= ROWS; k++) {
      uint32_t v = i * (ROWS + 1) + k;
      positions[v] = (sbf_vec3){(float)i / COLUMNS, 0.199f, 0.02f + 0.16f * (float)k / ROWS};
      points[v] = find_element(sbfi_d3_of(positions[v]), &weights[v]);
      if (i == COLUMNS || k == ROWS) continue;
      const uint32_t at[4] = {v, v + 1, v + ROWS + 2, v + ROWS + 1};
      memcpy(corners + 4 * quad, at, sizeof at);
      sizes[quad++] = 4;
    }
  mesh->mesh.positions = (sbf_vec3_list){positions, VERTICES};
  mesh->mesh.polygon_sizes = (sbf_u32_list){sizes, QUADS};
  mesh->mesh.polygon_points = (sbf_u32_list){corners, 4 * QUADS};
  embedding->render_mesh = 0;
  embedding->points = (sbf_uint4_list){points, VERTICES};
  embedding->weights = (sbf_vec4_list){weights, VERTICES};
  s.asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  ((sbf_level *)(uintptr_t)&scene_body(&s, 0)->levels.at[0])->embeddings = (sbf_embedding_list){embedding, 1};
}

static void begin(sbf_scheme scheme, uint32_t tear_points) {
  box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, 10, 2, 2, 1000, 1e5f, 0.4f);
  s = scene_begin();
  scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->attributes.tear_strain = 0.3f;
  s.world_definition.has_gravity = true, s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  s.model_options.scheme = scheme, s.model_options.tear_points = tear_points;
  weaken_middle();
  add_skin();
  scene_start(&s);
  sbri_character *c = &s.world->characters[0];
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++) {
    const sbri_point *x = &sbri_positions(c)[i];
    float *v = scene_velocity(&s, i);
    if (!(s.model->islands[0].masses[i] > 0)) continue;
    v[0] = SPEED * (x->x < 0.5f ? -1.0f : x->x > 0.5f ? 1.0f : 0) + 0.2f, v[SBRI_BLOCK] = 0.3f * x->x;
  }
}
static void end(void) {
  scene_free(&s);
  lattice_box_free(&box);
}

static uint32_t corner(uint32_t t, uint32_t k) {
  const sbri_island *island = &s.model->islands[0];
  uint32_t at = island->tetrahedra.lanes[2 * t], twin = island->tetrahedra.lanes[2 * t + 1];
  const sbri_tetrahedron_block *blocks = sbri_solids(&s.world->characters[0]);
  uint32_t slot = blocks[at / SBRI_BLOCK].corners[k][at % SBRI_BLOCK];
  ck_assert_uint_eq(blocks[twin / SBRI_BLOCK].corners[k][twin % SBRI_BLOCK], slot);
  return slot;
}

/* Number of parts of the whole tetrahedra that share points. */
static uint32_t count_parts(void) {
  const uint32_t *torn = sbri_torn(&s.world->characters[0]);
  uint32_t slots = s.model->slot_count, *group = calloc(slots, sizeof *group), parts = 0;
  for (uint32_t i = 0; i < slots; i++) group[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (uint32_t t = 0; t < box.tetrahedron_count; t++) {
      uint32_t min = UINT32_MAX;
      if (torn[t]) continue;
      for (uint32_t k = 0; k < 4; k++) min = group[corner(t, k)] < min ? group[corner(t, k)] : min;
      for (uint32_t k = 0; k < 4; k++)
        if (group[corner(t, k)] != min) group[corner(t, k)] = min, changed = true;
    }
  }
  for (uint32_t i = 0; i < slots; i++) {
    bool used = false;
    for (uint32_t t = 0; t < box.tetrahedron_count && group[i] == i; t++)
      for (uint32_t k = 0; k < 4; k++) used = used || (!torn[t] && corner(t, k) == i);
    parts += used;
  }
  free(group);
  return parts;
}

static const sbf_scheme schemes[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN};

START_TEST(a_bar_tears_in_two_where_it_is_weakest)
{
  begin(schemes[_i], 0);
  scene_momentum before = scene_momentum_of(&s);
  ck_assert_uint_eq(count_parts(), 1);
  scene_ticks(&s, 40);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(health.finite);
  ck_assert_uint_gt(health.torn, 10);
  ck_assert_uint_eq(health.unsplit, 0);
  ck_assert_uint_eq(health.recoveries, 0);
  const uint32_t *torn = sbri_torn(&s.world->characters[0]);
  for (uint32_t t = 0; t < box.tetrahedron_count; t++) {
    if (!torn[t]) continue;
    float low = 1, high = 0;
    for (int k = 0; k < 4; k++) {
      float x = box.positions[box.tetrahedra[t].at[k]].x;
      low = x < low ? x : low, high = x > high ? x : high;
    }
    ck_assert(low < WEAK_TO && high > WEAK_FROM);
  }
  ck_assert_uint_eq(count_parts(), 2);
  uint32_t splits = 0;
  for (uint32_t i = s.model->bodies[0].slots.first_spare; i < s.model->bodies[0].slots.real_end; i++)
    splits += sbri_origins(&s.world->characters[0])[i] != SBRI_UNUSED;
  ck_assert_uint_ge(splits, 3);
  scene_momentum after = scene_momentum_of(&s);
  ck_assert_double_eq_tol(after.mass, before.mass, 1e-5 * before.mass);
  for (int k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(after.linear[k], before.linear[k], 1e-3 * before.mass);
    ck_assert_double_eq_tol(after.angular[k], before.angular[k], 1e-2 * before.mass);
  }
  /* The halves fly on. */
  float left = scene_point(&s, 0, lattice_box_point(&box, 0, 0, 0)).x,
        right = scene_point(&s, 0, lattice_box_point(&box, 10, 0, 0)).x;
  ck_assert_float_gt(right - left, 2);
  end();
}
END_TEST

START_TEST(the_skin_opens_and_follows)
{
  enum { QUADS = COLUMNS * ROWS, VERTICES = (COLUMNS + 1) * (ROWS + 1) };
  uint8_t torn[QUADS];
  sbf_vec3 positions[VERTICES];
  begin(SBF_SCHEME_SYMPLECTIC, 0);
  ck_assert_uint_eq(sbr_character_get_torn_polygons(s.world, s.character, 0, 0, torn, QUADS), QUADS);
  for (int q = 0; q < QUADS; q++) ck_assert_uint_eq(torn[q], 0);
  scene_ticks(&s, 40);
  ck_assert_uint_eq(
      sbr_character_get_skin(s.world, s.character, 0, positions, NULL, NULL, VERTICES), VERTICES);
  sbr_character_get_torn_polygons(s.world, s.character, 0, 0, torn, QUADS);
  const sbf_polygon_mesh *mesh = &s.asset->render_meshes.at[0].mesh;
  uint32_t open = 0;
  for (uint32_t q = 0; q < QUADS; q++) {
    open += torn[q];
    for (uint32_t k = 0; k < 4 && !torn[q]; k++) { /* remaining polygons do not span the gap */
      uint32_t a = mesh->polygon_points.at[4 * q + k], b = mesh->polygon_points.at[4 * q + (k + 1) % 4];
      double now = sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(positions[a]), sbfi_d3_of(positions[b])));
      double rest =
          sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(mesh->positions.at[a]), sbfi_d3_of(mesh->positions.at[b])));
      ck_assert_double_lt(now, 2.5 * rest);
    }
  }
  ck_assert_uint_ge(open, ROWS);
  ck_assert_uint_le(open, 4 * ROWS);
  sbr_character_reset(s.world, s.character);
  sbr_character_get_torn_polygons(s.world, s.character, 0, 0, torn, QUADS);
  for (int q = 0; q < QUADS; q++) ck_assert_uint_eq(torn[q], 0);
  sbr_character_get_skin(s.world, s.character, 0, positions, NULL, NULL, VERTICES);
  for (uint32_t v = 0; v < VERTICES; v++)
    ck_assert_float_eq_tol(positions[v].x, mesh->positions.at[v].x, 1e-5f);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).torn, 0);
  ck_assert_uint_eq(count_parts(), 1);
  end();
}
END_TEST

START_TEST(insufficient_storage_is_reported)
{
  begin(SBF_SCHEME_SYMPLECTIC, 1);
  event_log log = {.torn_count = 0};
  scene_ticks_logged(&s, 40, &log);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(health.finite);
  ck_assert_uint_gt(health.unsplit, 0);
  for (uint32_t i = 0; i < log.torn_count; i++) ck_assert_double_eq_tol(log.torn[i].position.x, 0.5, 1);
  ck_assert_uint_gt(log.torn_count, 0);
  ck_assert_uint_gt(log.unsplit_count, 0);
  end();
}
END_TEST

START_TEST(a_snapshot_stores_the_tear)
{
  begin(schemes[_i], 0);
  scene_ticks(&s, 5);
  size_t size = sbr_world_get_snapshot_size(s.world);
  void *bytes = malloc(size);
  ck_assert_int_eq(sbr_world_save_snapshot(s.world, bytes, size), SBF_OK);
  uint64_t begins = sbr_world_get_state_hash(s.world);
  scene_ticks(&s, 30);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  ck_assert_uint_eq(count_parts(), 2);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_OK);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), begins);
  scene_ticks(&s, 30);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hash);
  free(bytes);
  end();
}
END_TEST

START_TEST(every_lane_width_gives_the_same_bits)
{
  uint64_t hashes[2];
  for (int n = 0; n < 2; n++) {
    begin(schemes[_i], 0);
    if (n) s.model->kernels = &sbri_kernels_scalar;
    scene_ticks(&s, 40);
    ck_assert_uint_eq(count_parts(), 2);
    hashes[n] = sbr_world_get_state_hash(s.world);
    end();
  }
  ck_assert_uint_eq(hashes[0], hashes[1]);
}
END_TEST

START_TEST(memory_may_run_out)
{
  begin(SBF_SCHEME_SYMPLECTIC, 0);
  scene_models_survive_want(&s);
  end();
}
END_TEST

int main(void) {
  Suite *suite = suite_create("split");
  TCase *c = tcase_create("split");
  tcase_add_loop_test(c, a_bar_tears_in_two_where_it_is_weakest, 0, 3);
  tcase_add_test(c, the_skin_opens_and_follows);
  tcase_add_test(c, insufficient_storage_is_reported);
  tcase_add_loop_test(c, a_snapshot_stores_the_tear, 0, 3);
  tcase_add_loop_test(c, every_lane_width_gives_the_same_bits, 0, 3);
  tcase_add_test(c, memory_may_run_out);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
