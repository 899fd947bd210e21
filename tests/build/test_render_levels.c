#include "build/render/render_levels.h"

#include <math.h>
#include <string.h>

#include "build/geometry/triangle_tree.h"
#include "harness.h"
#include "promises.h"
#include "random.h"
#include "sbfmt/build.h"
#include "sbfmt/validate.h"
#include "shapes.h"
#include "skinned_limb.h"

static sbf_asset *asset;

static void setup(void) {
  asset = sbf_asset_create(NULL);
}

static void teardown(void) {
  sbf_asset_free(asset);
}

/* A cube blown up into a sphere of `n` x `n` quads a side; each side has its own part of the texture. */
static sbf_render_mesh *add_sphere(uint32_t n) {
  sbf_render_mesh *mesh = sbf_asset_allocate(asset, 1, sizeof *mesh);
  sbf_uv_set *uv = sbf_asset_allocate(asset, 1, sizeof *uv);
  ck_assert(mesh && uv);
  sbf_render_mesh_init(mesh);
  sbf_uv_set_init(uv);
  mesh->id = mesh->name = "sphere";
  mesh->mesh = shape_cube(asset, n, 2, (sbf_vec3){0, 0, 0});
  mesh->mesh.target = SBF_MESH_TARGET_RENDERING;
  uint32_t corner_count = mesh->mesh.polygon_points.count, point_count = mesh->mesh.positions.count;
  sbf_vec2 *coordinates = sbf_asset_allocate(asset, corner_count, sizeof *coordinates);
  uint32_t *corners = sbf_asset_allocate(asset, corner_count, sizeof *corners);
  sbf_vec3 *at = sbf_asset_allocate(asset, point_count, sizeof *at);
  ck_assert(coordinates && corners && at);
  for (uint32_t c = 0; c < corner_count; c++) {
    sbf_vec3 p = mesh->mesh.positions.at[mesh->mesh.polygon_points.at[c]];
    float side = (float)(c / (4 * n * n));
    corners[c] = c;
    coordinates[c] = (sbf_vec2){side + p.x / 4 + p.z / 16, p.y / 4 + p.z / 32};
  }
  for (uint32_t i = 0; i < point_count; i++) {
    sbf_vec3 p = mesh->mesh.positions.at[i];
    float length = sqrtf(p.x * p.x + p.y * p.y + p.z * p.z);
    at[i] = (sbf_vec3){p.x / length, p.y / length, p.z / length};
  }
  uv->coordinates = (sbf_vec2_list){coordinates, corner_count};
  uv->corners = (sbf_u32_list){corners, corner_count};
  mesh->mesh.positions.at = at;
  mesh->uv_sets = (sbf_uv_set_list){uv, 1};
  asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  return mesh;
}

static sbf_asset *build(const sbf_asset *from, uint32_t levels, double error_m, sbf_build_report *report) {
  sbf_build_options options = {.render_levels = levels, .render_error_m = error_m};
  sbf_asset *built;
  sbf_diagnostic error;
  ck_assert_msg(sbf_build(from, &options, &built, report, &error) == SBF_OK, "%s", error.message);
  ck_assert_promises_kept(built);
  return built;
}

static sbf_polygon_mesh mesh_of(const sbf_render_mesh *mesh, const sbf_render_level *level) {
  sbf_polygon_mesh coarse = mesh->mesh;
  coarse.polygon_sizes = level->polygon_sizes;
  coarse.polygon_points = level->polygon_points;
  return coarse;
}

static uint32_t state = 1;

/* Maximum distance of `samples` points per triangle on one mesh from the other, for comparison with other
 * programs. */
static double farthest_sample(const sbf_polygon_mesh *from, const sbf_polygon_mesh *to, int samples) {
  sbfi_arena arena;
  sbfi_triangle_tree a, b;
  double max = 0;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_triangle_tree_build(&a, from, &arena) && sbfi_triangle_tree_build(&b, to, &arena));
  for (uint32_t t = 0; t < a.triangle_count; t++)
    for (int i = 0; i < samples + 3; i++) {
      float s = i < 3 ? (float)(i == 1) : random_between(&state, 0, 1),
            r = i < 3 ? (float)(i == 2) : (1 - s) * random_between(&state, 0, 1);
      const sbf_vec3 *p = &a.positions[a.triangles[t].points[0]], *q = &a.positions[a.triangles[t].points[1]],
                     *o = &a.positions[a.triangles[t].points[2]];
      sbf_vec3 at = {p->x + s * (q->x - p->x) + r * (o->x - p->x),
          p->y + s * (q->y - p->y) + r * (o->y - p->y), p->z + s * (q->z - p->z) + r * (o->z - p->z)};
      double squared = INFINITY;
      sbfi_triangle_tree_nearest(&b, at, &squared);
      if (squared > max) max = squared;
    }
  sbfi_arena_free(&arena);
  return sqrt(max);
}

static void check_error(const sbf_render_mesh *mesh, const sbf_render_level *level) {
  sbf_polygon_mesh coarse = mesh_of(mesh, level);
  double there = farthest_sample(&mesh->mesh, &coarse, 40), back = farthest_sample(&coarse, &mesh->mesh, 40);
  double far = there > back ? there : back;
  ck_assert_double_gt(far, 0);
  ck_assert_double_ge((double)level->error, far * (1 - 1e-6));
  ck_assert_double_le((double)level->error, far * 1.15);
}

START_TEST(halves_and_true_errors)
{
  add_sphere(16); /* 3072 triangles */
  sbf_build_report report;
  sbf_asset *built = build(asset, 4, 0, &report);
  const sbf_render_mesh *mesh = &built->render_meshes.at[0];
  ck_assert_uint_eq(mesh->levels.count, 4);
  ck_assert_uint_eq(report.render_levels, 4);
  for (uint32_t l = 0; l < 4; l++) {
    const sbf_render_level *level = &mesh->levels.at[l];
    uint32_t target = 3072u >> (l + 1);
    ck_assert_uint_le(level->polygon_sizes.count, target + target / 6);
    ck_assert_uint_ge(level->polygon_sizes.count, target - 2);
    ck_assert_int_eq(level->derived, 0);
    check_error(mesh, level);
    if (l) ck_assert_float_gt(level->error, mesh->levels.at[l - 1].error);
  }
  ck_assert_float_lt(mesh->levels.at[1].error, 0.02f); /* of a sphere of 1 m */
  sbf_validate_result result;
  ck_assert_int_eq(sbf_validate(built, NULL, &result, NULL), SBF_OK);
  ck_assert_uint_eq(result.errors, 0);
  sbf_asset_free(built);
}
END_TEST

/* Each corner has the appearance of the full mesh there, and no triangle crosses into another part of the
 * texture: the three corners of one are in the part of one side. */
START_TEST(texture_seams_are_kept)
{
  add_sphere(12);
  sbf_asset *built = build(asset, 3, 0, NULL);
  const sbf_render_mesh *mesh = &built->render_meshes.at[0];
  ck_assert_uint_ge(mesh->levels.count, 2);
  for (uint32_t l = 0; l < mesh->levels.count; l++) {
    const sbf_render_level *level = &mesh->levels.at[l];
    ck_assert_uint_eq(level->corners.count, level->polygon_points.count);
    for (uint32_t c = 0; c < level->corners.count; c++) {
      uint32_t corner = level->corners.at[c];
      ck_assert_uint_eq(mesh->mesh.polygon_points.at[corner], level->polygon_points.at[c]);
      ck_assert_uint_eq(corner / (4 * 144), level->corners.at[c / 3 * 3] / (4 * 144));
    }
  }
  sbf_asset_free(built);
}
END_TEST

START_TEST(materials_and_borders_are_kept)
{
  sbf_render_mesh *mesh = add_sphere(2);
  mesh->uv_sets.count = 0;
  mesh->mesh = shape_sheet(asset, 24, 24);
  mesh->mesh.target = SBF_MESH_TARGET_RENDERING;
  uint32_t count = mesh->mesh.polygon_sizes.count;
  uint32_t *slots = sbf_asset_allocate(asset, count, sizeof *slots);
  sbf_material_slot *two = sbf_asset_allocate(asset, 2, sizeof *two);
  ck_assert(slots && two);
  double areas[2] = {0, 0};
  sbf_material_slot_init(&two[0]);
  sbf_material_slot_init(&two[1]);
  for (uint32_t p = 0; p < count; p++) {
    slots[p] = mesh->mesh.positions.at[mesh->mesh.polygon_points.at[4 * p]].x < 9;
    areas[slots[p]]++;
  }
  mesh->material_slots = (sbf_material_slot_list){two, 2};
  mesh->polygon_materials = (sbf_u32_list){slots, count};
  sbf_asset *built = build(asset, 4, 0, NULL);
  mesh = (sbf_render_mesh *)(uintptr_t)built->render_meshes.at;
  ck_assert_uint_eq(mesh->levels.count, 4);
  for (uint32_t l = 0; l < 4; l++) {
    const sbf_render_level *level = &mesh->levels.at[l];
    double found[2] = {0, 0};
    ck_assert_uint_eq(level->polygon_materials.count, level->polygon_sizes.count);
    ck_assert_uint_eq(level->corners.count, 0); /* positions only, no other attributes */
    for (uint32_t t = 0; t < level->polygon_sizes.count; t++) {
      sbf_vec3 p[3];
      for (int k = 0; k < 3; k++) p[k] = mesh->mesh.positions.at[level->polygon_points.at[3 * t + k]];
      double area =
          0.5 * fabs((double)((p[1].x - p[0].x) * (p[2].z - p[0].z) - (p[1].z - p[0].z) * (p[2].x - p[0].x)));
      found[level->polygon_materials.at[t]] += area;
    }
    for (int m = 0; m < 2; m++) ck_assert_double_eq_tol(found[m], areas[m], 1e-4 * areas[m]);
    ck_assert_float_lt(level->error, 0.2f); /* flat: a hundredth of a triangle at most */
  }
  sbf_asset_free(built);
}
END_TEST

/* No triangle of a level reaches from one bone's part of a limb into another's. */
START_TEST(joints_are_kept)
{
  sbf_asset *limb = skinned_limb_make(
      &(skinned_limb){.bones = 3, .sides = 24, .rings_a_bone = 12, .radius = 0.2f, .slope = 0.3f});
  sbf_build_options options = {.render_levels = 2, .sections = SBF_BUILD_SECTIONS_NONE};
  sbf_asset *built;
  ck_assert_int_eq(sbf_build(limb, &options, &built, NULL, NULL), SBF_OK);
  const sbf_render_mesh *mesh = &built->render_meshes.at[0];
  ck_assert_uint_eq(mesh->levels.count, 2);
  for (uint32_t l = 0; l < 2; l++)
    for (uint32_t t = 0; t < mesh->levels.at[l].polygon_sizes.count; t++) {
      float low = INFINITY, high = -INFINITY;
      for (int k = 0; k < 3; k++) {
        float y = mesh->mesh.positions.at[mesh->levels.at[l].polygon_points.at[3 * t + k]].y;
        low = fminf(low, y);
        high = fmaxf(high, y);
      }
      for (float joint = 1; joint < 2.5f; joint++) ck_assert(!(low < joint - 0.09f && high > joint + 0.09f));
    }
  sbf_asset_free(built);
  sbf_asset_free(limb);
}
END_TEST

START_TEST(errors_bound_the_levels)
{
  add_sphere(16);
  sbf_asset *free_levels = build(asset, 4, 0, NULL);
  const sbf_render_level_list *all = &free_levels->render_meshes.at[0].levels;
  double between = ((double)all->at[1].error + all->at[2].error) / 2;
  sbf_asset *built = build(asset, 0, between, NULL);
  ck_assert_uint_eq(built->render_meshes.at[0].levels.count, 2);
  ck_assert_float_eq(built->render_meshes.at[0].levels.at[1].error, all->at[1].error);
  sbf_asset_free(built);
  built = build(asset, 1, between, NULL);
  ck_assert_uint_eq(built->render_meshes.at[0].levels.count, 1);
  sbf_asset_free(built);
  built = build(asset, 0, 0, NULL);
  ck_assert_uint_eq(built->render_meshes.at[0].levels.count, 0);
  sbf_asset_free(built);
  sbf_asset_free(free_levels);
}
END_TEST

START_TEST(derived_levels_are_rebuilt_and_authored_levels_kept)
{
  sbf_render_mesh *mesh = add_sphere(8);
  char path[256];
  sbf_asset *once = build(asset, 2, 0, NULL), *again = build(once, 2, 0, NULL),
            *none = build(once, 0, 0, NULL);
  ck_assert_msg(sbf_asset_equal(once, again, path, sizeof path), "%s", path);
  ck_assert_uint_eq(once->render_meshes.at[0].levels.count, 2);
  ck_assert_uint_eq(none->render_meshes.at[0].levels.count, 0);
  static const uint32_t sizes[] = {3}, points[] = {0, 1, 2};
  sbf_render_level own;
  sbf_render_level_init(&own);
  own.error = 2;
  own.polygon_sizes = (sbf_u32_list){sizes, 1};
  own.polygon_points = (sbf_u32_list){points, 3};
  mesh->levels = (sbf_render_level_list){&own, 1};
  sbf_asset *kept = build(asset, 2, 0, NULL);
  ck_assert_uint_eq(kept->render_meshes.at[0].levels.count, 1);
  ck_assert_uint_eq(kept->render_meshes.at[0].levels.at[0].polygon_sizes.count, 1);
  ck_assert_float_eq(kept->render_meshes.at[0].levels.at[0].error, 2);
  sbf_asset_free(once);
  sbf_asset_free(again);
  sbf_asset_free(none);
  sbf_asset_free(kept);
}
END_TEST

/* Facets, each with its own normal: hard edges everywhere would hold every point. */
START_TEST(facets_do_not_hinder)
{
  sbf_render_mesh *mesh = add_sphere(10);
  uint32_t polygons = mesh->mesh.polygon_sizes.count;
  sbf_vec3 *normals = sbf_asset_allocate(asset, polygons, sizeof *normals);
  uint32_t *corners = sbf_asset_allocate(asset, 4 * (size_t)polygons, sizeof *corners);
  ck_assert(normals && corners);
  mesh->uv_sets.count = 0;
  for (uint32_t c = 0; c < 4 * polygons; c++) corners[c] = c / 4;
  for (uint32_t p = 0; p < polygons; p++)
    normals[p] = mesh->mesh.positions.at[mesh->mesh.polygon_points.at[4 * p]];
  mesh->normals = (sbf_vec3_list){normals, polygons};
  mesh->normal_corners = (sbf_u32_list){corners, 4 * polygons};
  sbf_asset *built = build(asset, 1, 0, NULL);
  ck_assert_uint_eq(built->render_meshes.at[0].levels.count, 1);
  ck_assert_uint_le(built->render_meshes.at[0].levels.at[0].polygon_sizes.count, 610);
  sbf_asset_free(built);
}
END_TEST

START_TEST(small_and_empty_meshes)
{
  sbf_render_mesh *mesh = add_sphere(2); /* 48 triangles: half of it would be fewer than 32 */
  sbf_asset *built = build(asset, 3, 0, NULL);
  ck_assert_uint_eq(built->render_meshes.at[0].levels.count, 0);
  sbf_asset_free(built);
  mesh->uv_sets.count = 0;
  mesh->mesh.polygon_sizes = mesh->mesh.polygon_points = (sbf_u32_list){NULL, 0};
  built = build(asset, 3, 0, NULL);
  ck_assert_uint_eq(built->render_meshes.at[0].levels.count, 0);
  sbf_asset_free(built);
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  add_sphere(5);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbf_build_options options = {.allocator = &memory.allocator, .render_levels = 1};
    sbf_asset *built;
    sbf_diagnostic error;
    sbf_status status = sbf_build(asset, &options, &built, NULL, &error);
    sbf_asset_free(built);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) break;
    ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
  }
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("render_levels");
  TCase *c = tcase_create("render_levels");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, halves_and_true_errors);
  tcase_add_test(c, texture_seams_are_kept);
  tcase_add_test(c, materials_and_borders_are_kept);
  tcase_add_test(c, joints_are_kept);
  tcase_add_test(c, errors_bound_the_levels);
  tcase_add_test(c, derived_levels_are_rebuilt_and_authored_levels_kept);
  tcase_add_test(c, facets_do_not_hinder);
  tcase_add_test(c, small_and_empty_meshes);
  tcase_add_test(c, every_allocation_may_fail);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
