#include "rules.h"

#define PATH "/sbf/soft_body[1]/level[1]/tetrahedron_mesh/tetrahedra"
#define OF(points, tetrahedra, more) BODY(LEVEL("model=\"tetrahedra\"", points, LATTICE(tetrahedra, more)))

START_TEST(test_turned_round)
{
  sbf_asset *asset = rules_expect_fix(
      OF(TETRA_POINTS " 0.2 0.2 0.2", "0 1 2 3 2 1 3 4", "<young_modulus>1 2</young_modulus>"),
      "TETRAHEDRON_INVERTED " PATH " #1", "");
  const sbf_tetrahedron_mesh *mesh = &asset->soft_bodies.at[0].levels.at[0].lattice;
  static const uint32_t expected[] = {2, 1, 4, 3};
  ck_assert_mem_eq(mesh->tetrahedra.at[1].at, expected, sizeof expected);
  ck_assert_mem_eq(mesh->tetrahedra.at[0].at, ((uint32_t[]){0, 1, 2, 3}), sizeof expected);
  ck_assert_uint_eq(mesh->young_modulus.count, 2);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_flat_and_repeated)
{
  sbf_asset *asset = rules_expect_fix(
      OF(TETRA_POINTS " 0.2 0.2 0 0.2 0.2 0.2", "0 1 2 4 0 1 2 3 1 2 3 5 1 0 3 2 1 2 4 5",
          "<young_modulus>1 2 3 2 5</young_modulus><densities>900</densities><color_counts>3 "
          "2</color_counts>"),
      "TETRAHEDRON_INVERTED " PATH " #4\nTETRAHEDRON_INVERTED " PATH " #0\nTETRAHEDRON_DUPLICATE " PATH " #3",
      "COLORS_SHARED " PATH " #1\nCOLORS_SHARED " PATH " #1\nCOLORS_SHARED " PATH " #1");
  const sbf_tetrahedron_mesh *mesh = &asset->soft_bodies.at[0].levels.at[0].lattice;
  ck_assert_uint_eq(mesh->tetrahedra.count, 3);
  ck_assert_uint_eq(mesh->young_modulus.count, 3);
  ck_assert(
      mesh->young_modulus.at[0] == 2 && mesh->young_modulus.at[1] == 3 && mesh->young_modulus.at[2] == 5);
  ck_assert_uint_eq(mesh->densities.count, 1);
  ck_assert_uint_eq(mesh->color_counts.at[0], 2);
  ck_assert_uint_eq(mesh->color_counts.at[1], 1);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_repeated_elements_that_differ_are_kept)
{
  sbf_asset_free(rules_expect_fix(OF(TETRA_POINTS, "0 1 2 3 1 2 0 3", "<young_modulus>1 2</young_modulus>"),
      "", "TETRAHEDRON_DUPLICATE " PATH " #1"));
}
END_TEST

RULES_MAIN(
    "fix_tetrahedra", test_turned_round, test_flat_and_repeated, test_repeated_elements_that_differ_are_kept)
