#include "build/sections/section_hulls.h"

#include "harness.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena scratch;
static sbf_bone bone;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&scratch, NULL, 0);
  sbf_bone_init(&bone);
  bone.id = bone.name = "bone";
  asset->bones = (sbf_bone_list){&bone, 1};
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&scratch);
}

/* An L of 3 m^3, 1 m deep, in a hull of 3.5 m^3. */
static sbf_polygon_mesh angle_iron(void) {
  static const float profile[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  static sbf_vec3 positions[12];
  static const uint32_t sizes[] = {6, 6, 4, 4, 4, 4, 4, 4};
  static uint32_t points[36] = {5, 4, 3, 2, 1, 0, 6, 7, 8, 9, 10, 11};
  for (uint32_t i = 0; i < 6; i++) {
    positions[i] = (sbf_vec3){profile[i][0], profile[i][1], 0};
    positions[6 + i] = (sbf_vec3){profile[i][0], profile[i][1], 1};
    uint32_t next = (i + 1) % 6, *side = points + 12 + 4 * i;
    side[0] = i, side[1] = next, side[2] = 6 + next, side[3] = 6 + i;
  }
  return (sbf_polygon_mesh){
      .positions = {positions, 12}, .polygon_sizes = {sizes, 8}, .polygon_points = {points, 36}};
}

/* The rigid body that the L gets, with a level of its own or without. */
static const sbf_rigid_body *rigid_body_of(bool with_level) {
  static sbf_soft_body body;
  static sbf_level level;
  sbfi_ids ids;
  uint32_t made;
  sbfi_ids_init(&ids, NULL);
  sbf_soft_body_init(&body);
  sbf_level_init(&level);
  body.id = body.name = "iron";
  body.bone = 0;
  body.surface = angle_iron();
  body.attributes.density = 500;
  if (with_level) body.levels = (sbf_level_list){&level, 1};
  asset->soft_bodies = (sbf_soft_body_list){&body, 1};
  ck_assert(sbfi_section_hulls_make(asset, 0, &ids, NULL, &made, (sbfi_progress){0}, &scratch));
  asset->soft_bodies = (sbf_soft_body_list){NULL, 0};
  sbfi_ids_free(&ids);
  ck_assert_uint_eq(made, 1);
  ck_assert_uint_eq(asset->rigid_bodies.count, 1);
  return &asset->rigid_bodies.at[0];
}

START_TEST(a_section_has_the_mass_of_its_hull)
{
  const sbf_rigid_body *body = rigid_body_of(true);
  ck_assert_float_eq_tol(body->mass, 500 * 3.5f, 1e-2f);
  ck_assert_float_eq(body->density, 500);
}
END_TEST

START_TEST(a_part_without_levels_has_the_mass_of_its_volume)
{
  sbf_vec3 of_hull = rigid_body_of(true)->inertia;
  asset->rigid_bodies = (sbf_rigid_body_list){NULL, 0};
  const sbf_rigid_body *body = rigid_body_of(false);
  ck_assert_float_eq_tol(body->mass, 500 * 3, 1e-2f);
  ck_assert_float_eq(body->density, 500);
  ck_assert_float_eq_tol(body->inertia.x / of_hull.x, 3 / 3.5f, 1e-5f);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("section_hulls");
  TCase *tests = tcase_create("all");
  tcase_add_checked_fixture(tests, setup, teardown);
  tcase_add_test(tests, a_section_has_the_mass_of_its_hull);
  tcase_add_test(tests, a_part_without_levels_has_the_mass_of_its_volume);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
