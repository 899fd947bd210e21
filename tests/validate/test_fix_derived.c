#include <string.h>

#include "rules.h"
#include "sbfmt/build.h"

static sbf_asset *build(const char *inside, const sbf_build_options *options) {
  sbf_asset *asset = rules_load(inside, false), *built;
  ck_assert_int_eq(sbf_build(asset, options, &built, NULL, NULL), SBF_OK);
  sbf_asset_free(asset);
  return built;
}

static sbf_asset *fix(const sbf_asset *asset, bool rebuilt) {
  sbf_asset *fixed;
  sbf_fix_result result;
  ck_assert_int_eq(sbf_fix(asset, NULL, &fixed, &result, NULL), SBF_OK);
  ck_assert_int_eq(result.rebuilt, rebuilt);
  return fixed;
}

START_TEST(test_stale_parts_are_rebuilt_with_their_settings)
{
  sbf_build_options options = {.interior = SBF_BUILD_INTERIOR_NONE, .without_flexion = true};
  sbf_asset *built = build(ROOT_BONE SECTION(TETRA), &options);
  sbf_asset *fixed = fix(built, false);
  ck_assert(sbf_asset_equal(built, fixed, NULL, 0));
  sbf_asset_free(fixed);
  ((sbf_vec3 *)(uintptr_t)built->soft_bodies.at[0].surface.positions.at)[3].z = 0.25f;
  fixed = fix(built, true);
  ck_assert(fixed->soft_bodies.at[0].levels.at[0].positions.at[3].z == 0.25f);
  ck_assert_str_eq(fixed->derivations.at[0].settings, built->derivations.at[0].settings);
  ck_assert_uint_eq(fixed->soft_bodies.at[0].levels.at[0].positions.count, 4);
  ck_assert_ptr_null(strstr(rules_findings(fixed, NULL), "DERIVED_STALE"));
  sbf_asset_free(fixed);
  sbf_asset_free(built);
}
END_TEST

START_TEST(test_lattices_are_rebuilt_equally)
{
  static const sbf_build_options kinds[] = {
      {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .cell_m = 0.1 / 3, .without_calibration = true},
      {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = 300, .without_calibration = true},
      {.interior = SBF_BUILD_INTERIOR_LATTICE, .cell_m = 0.25, .without_calibration = true},
  };
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    sbf_asset *built = build(ROOT_BONE SECTION(TETRA), &kinds[i]), *expected;
    ((sbf_vec3 *)(uintptr_t)built->soft_bodies.at[0].surface.positions.at)[3].z = 1.25f;
    ck_assert_int_eq(sbf_build(built, &kinds[i], &expected, NULL, NULL), SBF_OK);
    sbf_asset *fixed = fix(built, true);
    ck_assert(sbf_asset_equal(fixed, expected, NULL, 0));
    sbf_asset_free(fixed);
    sbf_asset_free(expected);
    sbf_asset_free(built);
  }
}
END_TEST

START_TEST(test_parts_of_other_tools_are_kept)
{
  static const char *const texts[][2] = {{"another program", "interior=centroid"},
      {"sbfmt 9.9.9", "interior=centroid magic=true"}, {"sbfmt 0.1.0", "interior=unheard_of"},
      {"sbfmt 0.1.0", "interior=centroid"}};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    sbf_asset *built = build(ROOT_BONE SECTION(TETRA), NULL), *fixed;
    sbf_derivation *derivation = (sbf_derivation *)(uintptr_t)built->derivations.at;
    derivation->tool = texts[i][0];
    derivation->settings = texts[i][1]; /* the last states less than a build would: it cannot be the same */
    ((sbf_bone *)(uintptr_t)built->bones.at)->length = 0.3f;
    fixed = fix(built, false);
    ck_assert(sbf_asset_equal(built, fixed, NULL, 0));
    sbf_asset_free(fixed);
    sbf_asset_free(built);
  }
}
END_TEST

START_TEST(test_repairing_the_source_makes_derived_parts_stale)
{
  sbf_asset *built =
      build(ROOT_BONE SECTION(SURFACE(TETRA_POINTS " 9 9 9", "3 3 3 3", TETRA_POLYGONS)), NULL);
  sbf_asset *fixed = fix(built, true);
  ck_assert_uint_eq(fixed->soft_bodies.at[0].surface.positions.count, 4);
  ck_assert_str_eq(rules_findings(fixed, NULL), "");
  sbf_asset_free(fixed);
  sbf_asset_free(built);
}
END_TEST

START_TEST(test_without_build)
{
  sbf_asset *built = build(ROOT_BONE SECTION(TETRA), NULL), *fixed;
  sbf_fix_options options = {.without_build = true};
  ((sbf_bone *)(uintptr_t)built->bones.at)->length = 0.3f;
  ck_assert_int_eq(sbf_fix(built, &options, &fixed, NULL, NULL), SBF_OK);
  ck_assert(sbf_asset_equal(built, fixed, NULL, 0));
  sbf_asset_free(fixed);
  sbf_asset_free(built);
}
END_TEST

RULES_MAIN("fix_derived", test_stale_parts_are_rebuilt_with_their_settings, test_lattices_are_rebuilt_equally,
    test_parts_of_other_tools_are_kept, test_repairing_the_source_makes_derived_parts_stale,
    test_without_build)
