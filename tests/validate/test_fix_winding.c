#include "rules.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

#define PATH "/sbf/soft_body[1]/polygon_mesh/polygon_sizes"
#define OF(polygons) BODY(SURFACE(TETRA_POINTS, "3 3 3 3", polygons))

START_TEST(test_one_polygon)
{
  sbf_asset *asset = rules_expect_fix(OF("0 2 1 0 1 3 0 3 2 1 3 2"), "SURFACE_WINDING " PATH " #3", "");
  static const uint32_t expected[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  ck_assert_mem_eq(asset->soft_bodies.at[0].surface.polygon_points.at, expected, sizeof expected);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_orientation_against_the_majority)
{ sbf_asset_free(rules_expect_fix(OF("0 1 2 0 3 1 0 3 2 1 3 2"), "SURFACE_WINDING " PATH " #0", "")); }
END_TEST

START_TEST(test_inside_out)
{ sbf_asset_free(rules_expect_fix(OF("0 1 2 0 3 1 0 2 3 1 3 2"), "SURFACE_INSIDE_OUT " PATH, "")); }
END_TEST

START_TEST(test_the_smaller_part_of_an_open_surface)
{
  sbf_asset *asset = rules_expect_fix(
      BODY(SURFACE("0 0 0 1 0 0 2 0 0 3 0 0 0 0 1 1 0 1 2 0 1 3 0 1", "4 4 4", "0 4 5 1 1 2 6 5 2 6 7 3")),
      "SURFACE_WINDING " PATH " #1", "");
  ck_assert_uint_eq(asset->soft_bodies.at[0].surface.polygon_points.at[5], 5);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_an_inner_cavity_is_kept)
{
  /* a small tetrahedron inside, facing into itself, with one polygon wrong */
#define HOLLOW(inner)                                                                                        \
  BODY(SURFACE("0 0 0 9 0 0 0 9 0 0 0 9 1 1 1 2 1 1 1 2 1 1 1 2", "3 3 3 3 3 3 3 3",                         \
      TETRA_POLYGONS " " inner) "<attributes young_modulus=\"1e8\"/>")
  sbf_asset_free(rules_expect_fix(HOLLOW("4 5 6 4 7 5 4 7 6 5 7 6"), "SURFACE_WINDING " PATH " #6",
      "SURFACE_PIECES /sbf/soft_body[1]/polygon_mesh"));
}
END_TEST

START_TEST(test_one_sided)
{
  /* Moebius' strip of three quads has no right answer */
  const char *strip = BODY(SURFACE("0 0 0 0 1 0 2 0 0 2 1 0 1 0 2 1 1 2", "4 4 4",
      "0 2 3 1 2 4 5 3 4 1 0 5") "<attributes area_density=\"1\"/>");
  sbf_asset *asset = rules_load(strip, true), *fixed;
  ck_assert_int_eq(sbf_fix(asset, NULL, &fixed, NULL, NULL), SBF_OK);
  ck_assert(sbf_asset_equal(asset, fixed, NULL, 0));
  sbf_asset_free(fixed);
  sbf_asset_free(asset);
}
END_TEST

/* Any polygons of a cube turned, also most of them: the cube comes back. */
START_TEST(test_any_of_a_cube)
{
  uint32_t seed = 3;
  for (int round = 0; round < 20; round++) {
    sbf_asset *asset = sbf_asset_create(NULL), *fixed;
    sbf_polygon_mesh cube = shape_cube(asset, 3, 1, (sbf_vec3){0, 2, 0});
    sbf_soft_body *body = shape_add_body(asset, "cube", &cube, false);
    uint32_t *corners = (uint32_t *)(uintptr_t)body->surface.polygon_points.at;
    sbf_surface_measures before, after;
    sbf_surface_measure(&cube, NULL, &before);
    for (uint32_t p = 0; p < cube.polygon_sizes.count; p++, corners += 4) {
      seed = seed * 1664525 + 1013904223;
      if (seed >> 24 >= 220) continue;
      uint32_t swap = corners[1];
      corners[1] = corners[3];
      corners[3] = swap;
    }
    ck_assert_int_eq(sbf_fix(asset, NULL, &fixed, NULL, NULL), SBF_OK);
    sbf_surface_measure(&fixed->soft_bodies.at[0].surface, NULL, &after);
    ck_assert(after.volume > 0.999999 && after.volume < 1.000001 && after.opening < 1e-9);
    ck_assert_str_eq(rules_findings(fixed, NULL), "");
    sbf_asset_free(fixed);
    sbf_asset_free(asset);
  }
}
END_TEST

RULES_MAIN("fix_winding", test_one_polygon, test_orientation_against_the_majority, test_inside_out,
    test_the_smaller_part_of_an_open_surface, test_an_inner_cavity_is_kept, test_one_sided,
    test_any_of_a_cube)
