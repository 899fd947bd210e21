#include "build/render/wedges.h"

#include "harness.h"
#include "shapes.h"
#include "skinned_limb.h"

static sbf_asset *asset;
static sbfi_arena arena;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&arena, NULL, 0);
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

static const sbfi_wedge_rule all = {true, true}, none = {false, false};

static uint32_t count(const sbf_render_mesh *mesh, sbfi_wedge_rule rule) {
  sbfi_wedges wedges;
  ck_assert(sbfi_wedges_make(&wedges, mesh, rule, &arena));
  for (uint32_t c = 0; c < mesh->mesh.polygon_points.count; c++) {
    uint32_t wedge = wedges.of_corner[c];
    ck_assert_uint_lt(wedge, wedges.count);
    ck_assert_uint_le(wedges.corners[wedge], c);
    ck_assert_uint_eq(mesh->mesh.polygon_points.at[wedges.corners[wedge]], mesh->mesh.polygon_points.at[c]);
  }
  return wedges.count;
}

/* Two quads side by side: the points 1 and 4 are in both. */
static sbf_render_mesh two_quads(void) {
  sbf_render_mesh mesh;
  sbf_render_mesh_init(&mesh);
  mesh.mesh = shape_sheet(asset, 2, 1);
  return mesh;
}

START_TEST(attributes_that_split_a_point)
{
  sbf_render_mesh mesh = two_quads();
  ck_assert_uint_eq(count(&mesh, all), 6);
  static const uint32_t slots[] = {0, 1};
  mesh.polygon_materials = (sbf_u32_list){slots, 2};
  ck_assert_uint_eq(count(&mesh, none), 8);
  mesh.polygon_materials.count = 0;
  /* Coordinates of equal value do not split, at any index. */
  static const sbf_vec2 same[] = {{0.5f, 0.5f}, {0.5f, 0.5f}};
  static const uint32_t by_polygon[] = {0, 0, 0, 0, 1, 1, 1, 1};
  sbf_uv_set uv;
  sbf_uv_set_init(&uv);
  uv.coordinates = (sbf_vec2_list){same, 2};
  uv.corners = (sbf_u32_list){by_polygon, 8};
  mesh.uv_sets = (sbf_uv_set_list){&uv, 1};
  ck_assert_uint_eq(count(&mesh, none), 6);
  static const sbf_vec2 unlike[] = {{0.5f, 0.5f}, {0.25f, 0.5f}};
  uv.coordinates.at = unlike;
  ck_assert_uint_eq(count(&mesh, none), 8);
  mesh.uv_sets.count = 0;
  static const sbf_vec3 normals[] = {{0, 1, 0}, {0.6f, 0.8f, 0}};
  mesh.normals = (sbf_vec3_list){normals, 2};
  mesh.normal_corners = (sbf_u32_list){by_polygon, 8};
  ck_assert_uint_eq(count(&mesh, none), 6);
  ck_assert_uint_eq(count(&mesh, all), 8);
}
END_TEST

/* Where the influence of the other bone begins: one ring of the tube belongs to both. */
START_TEST(bones_split_one_ring)
{
  sbf_asset *limb = skinned_limb_make(&(skinned_limb){
      .bones = 2, .sides = 8, .rings_a_bone = 4, .radius = 0.2f, .slope = 0.5f, .open = true});
  const sbf_render_mesh *mesh = &limb->render_meshes.at[0];
  ck_assert_uint_eq(count(mesh, all), count(mesh, none) + 8);
  sbf_asset_free(limb);
}
END_TEST

START_TEST(triangles_are_fans)
{
  sbf_render_mesh mesh = two_quads();
  sbfi_wedges wedges;
  ck_assert(sbfi_wedges_make(&wedges, &mesh, all, &arena));
  ck_assert_uint_eq(wedges.triangle_count, 4);
  uint32_t points[8];
  memcpy(points, mesh.mesh.polygon_points.at, sizeof points);
  points[2] = points[1]; /* one triangle of the first names a point twice, the other is left */
  mesh.mesh.polygon_points.at = points;
  ck_assert(sbfi_wedges_make(&wedges, &mesh, all, &arena));
  ck_assert_uint_eq(wedges.triangle_count, 3);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("wedges");
  TCase *c = tcase_create("wedges");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, attributes_that_split_a_point);
  tcase_add_test(c, bones_split_one_ring);
  tcase_add_test(c, triangles_are_fans);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
