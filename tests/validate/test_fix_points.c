#include "rules.h"

#define PATH "/sbf/soft_body[1]/polygon_mesh/positions"
/* Its points 1 and 4 are in no polygon; 5 is inside. */
#define STRAY                                                                                                \
  SURFACE("0 0 0 9 9 9 0.2 0 0 0 0.2 0 8 8 8 0 0 0.2", "3 3 3 3", "0 3 2 0 2 5 0 5 3 2 3 5")                 \
  "<interior>0.05 0.05 0.05</interior>"

START_TEST(test_all_lists_of_points)
{
  sbf_asset *asset = rules_expect_fix(
      ROOT_BONE SECTION(
          STRAY "<source_points>10 11 12 13 14 15</source_points>"
                "<weight_map property=\"density\"><values>1 2 3 4 5 6 7</values></weight_map>" PINS(
                    "bone=\"root\"", "0 5 6", "")),
      "POINT_UNUSED " PATH " #1", "");
  const sbf_soft_body *body = &asset->soft_bodies.at[0];
  ck_assert_uint_eq(body->surface.positions.count, 4);
  ck_assert(body->surface.positions.at[1].x == 0.2f);
  ck_assert_mem_eq(body->surface.polygon_points.at, ((uint32_t[]){0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}),
      12 * sizeof(uint32_t));
  ck_assert_mem_eq(body->source_points.at, ((uint32_t[]){10, 12, 13, 15}), 4 * sizeof(uint32_t));
  ck_assert_mem_eq(body->pins.at[0].points.at, ((uint32_t[]){0, 3, 4}), 3 * sizeof(uint32_t));
  ck_assert_uint_eq(body->weight_maps.at[0].values.count, 5);
  ck_assert(body->weight_maps.at[0].values.at[1] == 3 && body->weight_maps.at[0].values.at[4] == 7);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_levels_keep_their_points)
{
  sbf_asset *asset = rules_expect_fix(
      BODY(STRAY LEVEL("", "0 0 0 9 9 9 0.2 0 0 0 0.2 0 8 8 8 0 0 0.2 0.05 0.05 0.05",
          SPRINGS("", "0 2 2 3 3 5 5 0 6 0 6 2 6 3 0 1 1 4",
              "") "<embedding><points>0 0 0 0 1 1 1 1 2 2 2 2 3 3 3 3 4 4 4 4 5 5 5 5</points><weights>1 0 0 "
                  "0 1 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0</weights></embedding>")
              LEVEL("model=\"tetrahedra\"", "0 0 0.2 0 0.2 0 0.2 0 0 0 0 0",
                  "<new_from_old>3 9 2 1 9 0</new_from_old>" LATTICE("3 2 1 0", ""))),
      "POINT_UNUSED " PATH " #1", "");
  const sbf_level *level = &asset->soft_bodies.at[0].levels.at[0];
  ck_assert_uint_eq(level->positions.count, 7);
  ck_assert_uint_eq(level->new_from_old.count, 5);
  ck_assert_mem_eq(level->new_from_old.at, ((uint32_t[]){0, 2, 3, 5, 6}), 5 * sizeof(uint32_t));
  ck_assert_uint_eq(level->embeddings.at[0].points.count, 4);
  ck_assert_uint_eq(level->embeddings.at[0].points.at[1].at[0], 2);
  ck_assert_mem_eq(asset->soft_bodies.at[0].levels.at[1].new_from_old.at, ((uint32_t[]){3, 2, 1, 0}),
      4 * sizeof(uint32_t));
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_named_points_stay)
{
  sbf_asset_free(rules_expect_fix(ROOT_BONE SECTION(STRAY PINS("bone=\"root\"", "1 4", "")), "",
      "POINT_UNUSED " PATH " #1\nPOINT_UNUSED " PATH " #4"));
}
END_TEST

START_TEST(test_points_without_polygons_stay)
{
  sbf_asset_free(rules_expect_fix(
      BODY("<polygon_mesh target=\"surface\"><positions>0 0 0 1 0 0</positions></polygon_mesh>" LEVEL(
          "", "0 0 0 1 0 0", SPRINGS("", "0 1", ""))),
      "", ""));
}
END_TEST

RULES_MAIN("fix_points", test_all_lists_of_points, test_levels_keep_their_points, test_named_points_stay,
    test_points_without_polygons_stay)
