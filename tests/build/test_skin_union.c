#include "build/sections/skin_union.h"

#include <string.h>

#include "harness.h"
#include "skinned_limb.h"

static const skinned_limb tube = {.bones = 2, .sides = 8, .rings_a_bone = 4, .radius = 0.2f, .slope = 0.5f};
static sbf_asset *asset;
static sbfi_arena arena;

static void setup(void) {
  sbfi_arena_init(&arena, NULL, 0);
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

static sbfi_skin_union unite(const skinned_limb *of) {
  sbfi_skin_union skin;
  uint8_t chosen[2];
  uint32_t count;
  if (of) asset = skinned_limb_make(of);
  ck_assert(sbfi_skins_choose(asset, chosen, &count, &arena));
  ck_assert_uint_eq(count, asset->render_meshes.count);
  ck_assert(sbfi_skin_union_make(&skin, asset, chosen, &arena));
  return skin;
}

START_TEST(a_seam_is_sewn)
{
  skinned_limb seamed = tube;
  seamed.seam = true;
  sbfi_skin_union skin = unite(&seamed);
  ck_assert_uint_eq(skin.mesh.positions.count, 8 * 9);
  ck_assert_uint_eq(skin.mesh.polygon_sizes.count, 8 * 8 + 2);
  for (uint32_t r = 0; r < 9; r++)
    ck_assert_uint_eq(skin.points_of_mesh[0][9 * r], skin.points_of_mesh[0][9 * r + 8]);
  for (uint32_t p = 0; p < skin.mesh.positions.count; p++) {
    float sum = 0;
    for (uint32_t h = skin.bone_weight_begins[p]; h < skin.bone_weight_begins[p + 1]; h++)
      sum += skin.bone_weights[h].weight;
    ck_assert_float_eq_tol(sum, 1, 1e-6f);
  }
}
END_TEST

START_TEST(touching_lips_stay_separate)
{
  /* Two triangles back to back, each on a bone of its own, that share all three places. */
  asset = skinned_limb_make(&tube);
  static const sbf_vec3 at[] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  static const uint32_t ones[] = {1, 1, 1, 1, 1, 1}, bones[] = {0, 0, 0, 1, 1, 1}, sizes[] = {3, 3},
                        corners[] = {0, 1, 2, 3, 5, 4};
  static const float weights[] = {1, 1, 1, 1, 1, 1};
  sbf_skin lips = {{ones, 6}, {bones, 6}, {weights, 6}};
  sbf_render_mesh mesh = asset->render_meshes.at[0];
  mesh.mesh.positions = (sbf_vec3_list){at, 6};
  mesh.mesh.polygon_sizes = (sbf_u32_list){sizes, 2};
  mesh.mesh.polygon_points = (sbf_u32_list){corners, 6};
  mesh.skin = &lips;
  asset->render_meshes.at = &mesh;
  sbfi_skin_union skin = unite(NULL);
  ck_assert_uint_eq(skin.mesh.positions.count, 6);
  ck_assert_uint_eq(skin.mesh.polygon_sizes.count, 2);
  /* On one bone they are one sheet, drawn from both sides. */
  static const uint32_t same[] = {0, 0, 0, 0, 0, 0};
  lips.bones.at = same;
  skin = unite(NULL);
  ck_assert_uint_eq(skin.mesh.positions.count, 3);
  ck_assert_uint_eq(skin.mesh.polygon_sizes.count, 1);
}
END_TEST

START_TEST(meshes_join_and_pictures_of_bodies_do_not)
{
  asset = skinned_limb_make(&tube);
  sbf_render_mesh two[2] = {asset->render_meshes.at[0], asset->render_meshes.at[0]};
  asset->render_meshes = (sbf_render_mesh_list){two, 2};
  sbfi_skin_union skin = unite(NULL);
  ck_assert_uint_eq(skin.mesh.positions.count, 8 * 9);
  ck_assert_uint_eq(skin.mesh.polygon_sizes.count, 8 * 8 + 2);
  ck_assert_mem_eq(skin.points_of_mesh[0], skin.points_of_mesh[1], 8 * 9 * sizeof(uint32_t));
  sbf_soft_body body;
  sbf_soft_body_init(&body);
  body.surface.positions = two[1].mesh.positions;
  asset->soft_bodies = (sbf_soft_body_list){&body, 1};
  uint8_t chosen[2];
  uint32_t count;
  ck_assert(sbfi_skins_choose(asset, chosen, &count, &arena));
  ck_assert_uint_eq(count, 0);
  body.surface.positions.count--;
  ck_assert(sbfi_skins_choose(asset, chosen, &count, &arena));
  ck_assert_uint_eq(count, 2);
  asset->soft_bodies = (sbf_soft_body_list){NULL, 0};
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("skin_union");
  TCase *c = tcase_create("skin_union");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_seam_is_sewn);
  tcase_add_test(c, touching_lips_stay_separate);
  tcase_add_test(c, meshes_join_and_pictures_of_bodies_do_not);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
