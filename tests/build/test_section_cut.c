#include "build/sections/section_cut.h"

#include "harness.h"
#include "skinned_limb.h"

/* Quads of the middle one of three bones, ten rings of eight sides each, at an overlap. */
static uint32_t polygons_at(double overlap_m) {
  const skinned_limb of = {.bones = 3, .sides = 8, .rings_a_bone = 10, .radius = 0.2f};
  sbf_asset *asset = skinned_limb_make(&of);
  sbfi_arena arena;
  sbfi_skin_union skin;
  sbfi_topology t;
  uint8_t chosen[1];
  uint32_t count, labels[8 * 30 + 2];
  sbf_polygon_mesh mesh;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_skins_choose(asset, chosen, &count, &arena));
  ck_assert(sbfi_skin_union_make(&skin, asset, chosen, &arena));
  ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
  for (uint32_t p = 0; p < t.polygon_count; p++) labels[p] = p < 80 ? 0 : p < 160 ? 1 : 2;
  sbfi_section_cutter cutter = {.skin = &skin, .t = &t, .labels = labels, .overlap_m = overlap_m};
  ck_assert(sbfi_section_cutter_init(&cutter, 3, &arena));
  sbf_polygon_mesh_init(&mesh);
  ck_assert(sbfi_section_cut(&cutter, 1, &mesh, &arena));
  ck_assert_uint_eq(mesh.positions.count, mesh.polygon_sizes.count + 8); /* whole rings */
  for (uint32_t i = 0; i < mesh.polygon_points.count; i++)
    ck_assert_uint_lt(mesh.polygon_points.at[i], mesh.positions.count);
  uint32_t polygons = mesh.polygon_sizes.count;
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
  return polygons;
}

START_TEST(an_overlap_in_metres)
{
  ck_assert_uint_eq(polygons_at(0), 80);
  ck_assert_uint_eq(polygons_at(0.04), 80);
  ck_assert_uint_eq(polygons_at(0.06), 80 + 16);
  ck_assert_uint_eq(polygons_at(0.26), 80 + 48);
}
END_TEST

START_TEST(an_overlap_by_the_radius)
{
  /* The border is 1.22 m around: a radius of 0.195 m. */
  ck_assert_uint_eq(polygons_at(-0.5), 80 + 16);
  ck_assert_uint_eq(polygons_at(-1), 80 + 32);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("section_cut");
  TCase *c = tcase_create("section_cut");
  tcase_add_test(c, an_overlap_in_metres);
  tcase_add_test(c, an_overlap_by_the_radius);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
