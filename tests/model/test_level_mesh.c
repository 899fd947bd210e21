#include "model/level_mesh.h"

#include <string.h>

#include "harness.h"

/* Two quads side by side, 0 1 2 3 and 1 4 5 2, and a level of one triangle, 3 1 5. */
static const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
static const uint32_t sizes[] = {4, 4}, points[] = {0, 1, 2, 3, 1, 4, 5, 2}, level_sizes[] = {3},
                      level_points[] = {3, 1, 5}, slots[] = {1};

static sbf_render_mesh full;
static sbf_render_level level;
static sbfi_arena arena;

static void setup(void) {
  sbfi_arena_init(&arena, NULL, 0);
  sbf_render_mesh_init(&full);
  sbf_render_level_init(&level);
  full.mesh.positions = (sbf_vec3_list){positions, 6};
  full.mesh.polygon_sizes = (sbf_u32_list){sizes, 2};
  full.mesh.polygon_points = (sbf_u32_list){points, 8};
  level.polygon_sizes = (sbf_u32_list){level_sizes, 1};
  level.polygon_points = (sbf_u32_list){level_points, 3};
  level.polygon_materials = (sbf_u32_list){slots, 1};
}

static void teardown(void) {
  sbfi_arena_free(&arena);
}

static sbfi_level_mesh make(void) {
  sbfi_level_mesh made;
  ck_assert(sbfi_level_mesh_make(&made, &full, &level, &arena));
  return made;
}

START_TEST(used_vertices)
{
  sbfi_level_mesh made = make();
  ck_assert_uint_eq(made.vertex_count, 3);
  ck_assert_mem_eq(made.vertices, ((uint32_t[]){1, 3, 5}), 3 * sizeof(uint32_t));
  ck_assert_mem_eq(
      made.position_of, ((uint32_t[]){UINT32_MAX, 0, UINT32_MAX, 1, UINT32_MAX, 2}), 6 * sizeof(uint32_t));
  ck_assert_uint_eq(made.mesh.mesh.positions.count, 3);
  ck_assert(made.mesh.mesh.positions.at[2].x == 2 && made.mesh.mesh.positions.at[2].y == 1);
  ck_assert_mem_eq(made.mesh.mesh.polygon_points.at, ((uint32_t[]){1, 0, 2}), 3 * sizeof(uint32_t));
  ck_assert_uint_eq(made.mesh.polygon_materials.at[0], 1);
}
END_TEST

START_TEST(point_attributes)
{
  static const sbf_vec3 normals[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  static const sbf_vec2 coordinates[] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}};
  sbf_uv_set set;
  sbf_uv_set_init(&set);
  set.coordinates = (sbf_vec2_list){coordinates, 6};
  full.normals = (sbf_vec3_list){normals, 6};
  full.uv_sets = (sbf_uv_set_list){&set, 1};
  sbfi_level_mesh made = make();
  ck_assert_uint_eq(made.mesh.normals.count, 3);
  ck_assert(
      made.mesh.normals.at[0].y == 1 && made.mesh.normals.at[1].x == -1 && made.mesh.normals.at[2].z == -1);
  ck_assert_uint_eq(made.mesh.uv_sets.at[0].coordinates.count, 3);
  ck_assert(made.mesh.uv_sets.at[0].coordinates.at[2].x == 5);
}
END_TEST

/* Point 1 is a corner of both quads, with looks of its own in each. */
START_TEST(corner_attributes)
{
  static const uint32_t numbers[] = {0, 1, 2, 3, 4, 5, 6, 7}, named[] = {3, 4, 6};
  static const sbf_vec3 normals[8] = {{0, 0, 1}};
  static const sbf_vec2 coordinates[8] = {{0, 0}};
  sbf_uv_set sets[2];
  for (int u = 0; u < 2; u++) {
    sbf_uv_set_init(&sets[u]);
    sets[u].coordinates = (sbf_vec2_list){coordinates, 8};
    sets[u].corners = (sbf_u32_list){numbers, 8};
  }
  full.normals = (sbf_vec3_list){normals, 8};
  full.normal_corners = (sbf_u32_list){numbers, 8};
  full.uv_sets = (sbf_uv_set_list){sets, 2};
  for (int stated = 0; stated < 2; stated++) {
    level.corners = (sbf_u32_list){stated ? named : NULL, stated ? 3 : 0};
    sbfi_level_mesh made = make();
    const uint32_t expected[] = {3, stated ? 4 : 1, 6}; /* else the first at the point */
    ck_assert_mem_eq(made.mesh.normal_corners.at, expected, sizeof expected);
    for (int u = 0; u < 2; u++)
      ck_assert_mem_eq(made.mesh.uv_sets.at[u].corners.at, expected, sizeof expected);
    ck_assert_uint_eq(made.mesh.normals.count, 8);
  }
}
END_TEST

START_TEST(no_memory)
{
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    sbfi_level_mesh made;
    harness_memory_init(&memory, allowed);
    sbfi_arena small;
    sbfi_arena_init(&small, &memory.allocator, 0);
    bool good = sbfi_level_mesh_make(&made, &full, &level, &small);
    sbfi_arena_free(&small);
    if (good) break;
    ck_assert_uint_lt(allowed, 8);
  }
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("level_mesh");
  TCase *c = tcase_create("level_mesh");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, used_vertices);
  tcase_add_test(c, point_attributes);
  tcase_add_test(c, corner_attributes);
  tcase_add_test(c, no_memory);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
