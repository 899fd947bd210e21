#include "build/sections/section_level.h"

#include <math.h>
#include <string.h>

#include "harness.h"
#include "promises.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"
#include "skinned_limb.h"

static sbf_asset *asset, *built;

/* One section, 0.2 m thick and as long as told. */
static const sbf_level *level_of(float length) {
  const skinned_limb of = {.bones = 2, .sides = 12, .rings_a_bone = 6, .radius = 0.1f};
  asset = skinned_limb_make(&of);
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)asset->render_meshes.at[0].mesh.positions.at;
  for (uint32_t v = 0; v < asset->render_meshes.at[0].mesh.positions.count; v++) at[v].y *= length / 2;
  uint32_t *bones = (uint32_t *)(uintptr_t)asset->render_meshes.at[0].skin->bones.at;
  for (uint32_t i = 0; i < asset->render_meshes.at[0].skin->bones.count; i++) bones[i] = 0;
  ck_assert_int_eq(sbf_build(asset, NULL, &built, NULL, NULL), SBF_OK);
  ck_assert_promises_kept(built);
  ck_assert_uint_eq(built->soft_bodies.count, 1);
  return &built->soft_bodies.at[0].levels.at[0];
}

static void teardown(void) {
  sbf_asset_free(built);
  sbf_asset_free(asset);
}

static const sbf_pin_set *set_named(const sbf_level *level, const char *name) {
  for (uint32_t s = 0; s < level->pins.count; s++)
    if (strcmp(level->pins.at[s].name, name) == 0) return &level->pins.at[s];
  ck_abort_msg("no pin set is named %s", name);
  return NULL;
}

START_TEST(points_along_the_whole_bone_are_pinned)
{
  const sbf_level *level = level_of(4);
  const sbf_pin_set *core = set_named(level, "interior");
  /* Nowhere is the core farther away than two springs are long. */
  for (float y = 0.2f; y < 3.8f; y += 0.1f) {
    float nearest = INFINITY;
    for (uint32_t i = 0; i < core->points.count; i++)
      nearest = fminf(nearest, fabsf(level->positions.at[core->points.at[i]].y - y));
    ck_assert_float_lt(nearest, 2 * level->cell);
  }
}
END_TEST

START_TEST(free_points_have_goals_springs_and_mass)
{
  const sbf_level *level = level_of(0.4f);
  const sbf_pin_set *core = set_named(level, "interior"), *goals = set_named(level, "shape");
  uint32_t frame = set_named(level, "frame")->points.count;
  ck_assert_uint_eq(level->positions.count, core->points.count + goals->points.count + frame);
  ck_assert_uint_eq(level->masses.count, level->positions.count);
  double mass = 0;
  for (uint32_t i = 0; i < level->masses.count; i++) mass += (double)level->masses.at[i];
  ck_assert_double_gt(mass, 0);
  sbf_body_measures measures;
  sbf_body_measure(&built->soft_bodies.at[0], &measures);
  ck_assert_double_le(mass, measures.mass * (1 + 1e-6));
  ck_assert_float_gt(goals->stiffness, 0);
  for (uint32_t i = 0; i < goals->points.count; i++) {
    ck_assert_float_gt(level->masses.at[goals->points.at[i]], 0);
    ck_assert_float_gt(goals->weights.at[i], 0);
    ck_assert_float_le(goals->weights.at[i], 0.5f);
  }
  for (uint32_t i = 0; i < core->points.count; i++)
    ck_assert_float_eq(level->masses.at[core->points.at[i]], 0);
  ck_assert_uint_eq(level->springs.count, 1);
  ck_assert_uint_gt(level->springs.at[0].ends.count, 100);
}
END_TEST

START_TEST(a_sheet_is_pinned_at_its_centre)
{
  asset = skinned_limb_make(&(skinned_limb){.bones = 2, .sides = 3, .rings_a_bone = 1, .radius = 1});
  sbf_polygon_mesh sheet = shape_sheet(asset, 4, 4);
  static uint32_t ones[25], bones[25];
  static float weights[25];
  for (uint32_t i = 0; i < 25; i++) ones[i] = 1, weights[i] = 1;
  sbf_skin skin = {{ones, 25}, {bones, 25}, {weights, 25}};
  sbf_render_mesh mesh = asset->render_meshes.at[0];
  mesh.mesh.positions = sheet.positions;
  mesh.mesh.polygon_sizes = sheet.polygon_sizes;
  mesh.mesh.polygon_points = sheet.polygon_points;
  mesh.skin = &skin;
  asset->render_meshes = (sbf_render_mesh_list){&mesh, 1};
  ck_assert_int_eq(sbf_build(asset, NULL, &built, NULL, NULL), SBF_OK);
  ck_assert_promises_kept(built);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_uint_gt(set_named(level, "interior")->points.count, 0);
  ck_assert_uint_gt(level->springs.count, 0);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("section_level");
  TCase *c = tcase_create("section_level");
  tcase_add_checked_fixture(c, NULL, teardown);
  tcase_add_test(c, points_along_the_whole_bone_are_pinned);
  tcase_add_test(c, free_points_have_goals_springs_and_mass);
  tcase_add_test(c, a_sheet_is_pinned_at_its_centre);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
