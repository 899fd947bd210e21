#include "rules.h"

#define MESH_PATH "/sbf/soft_body[1]/polygon_mesh"

START_TEST(test_a_closed_surface_is_good)
{
  rules_expect(BODY(TETRA), "");
  rules_expect(
      BODY(SURFACE(TETRA_POINTS, "3 3 3 3", "2 1 0 3 0 1 2 0 3 3 1 2")), ""); /* with any first corner */
}
END_TEST

START_TEST(test_open)
{
  rules_expect(BODY(SURFACE("0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1", "4 4 4 4 4",
                   "0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2")),
      "SURFACE_OPEN " MESH_PATH);
}
END_TEST

START_TEST(test_a_sheet_may_be_open)
{
  rules_expect(BODY(SURFACE("0 0 0 1 0 0 1 0 1 0 0 1", "4", "0 3 2 1")), "");
  /* a body that states an area density is one as well */
  rules_expect(
      BODY(SURFACE(TETRA_POINTS, "3 3 3", "0 2 1 0 1 3 0 3 2") "<attributes area_density=\"0.2\"/>"), "");
}
END_TEST

START_TEST(test_nonmanifold)
{
  rules_expect(BODY(SURFACE(TETRA_POINTS " 0 -0.2 0 0 0 -0.2", "3 3 3 3 3 3 3 3",
                   TETRA_POLYGONS " 0 4 1 0 1 5 0 5 4 1 4 5")),
      "SURFACE_NONMANIFOLD " MESH_PATH);
}
END_TEST

START_TEST(test_winding)
{
  rules_expect(BODY(SURFACE(TETRA_POINTS, "3 3 3 3", "0 2 1 0 1 3 0 3 2 1 3 2")),
      "SURFACE_WINDING " MESH_PATH "/polygon_sizes #3");
  rules_expect(
      BODY(SURFACE(TETRA_POINTS, "3 3 3 3", "0 1 2 0 3 1 0 2 3 1 3 2")), "SURFACE_INSIDE_OUT " MESH_PATH);
}
END_TEST

START_TEST(test_unused_points)
{
  rules_expect(BODY(SURFACE("9 9 9 " TETRA_POINTS, "3 3 3 3", "1 3 2 1 2 4 1 4 3 2 3 4")),
      "POINT_UNUSED " MESH_PATH "/positions #0");
  /* points alone make no surface: nothing can be said about them */
  rules_expect(
      BODY("<polygon_mesh target=\"surface\"><positions>0 0 0 1 0 0</positions></polygon_mesh>" LEVEL(
          "", "0 0 0 1 0 0", SPRINGS("", "0 1", ""))),
      "");
}
END_TEST

START_TEST(test_degenerate_polygons)
{
  rules_expect(BODY(SURFACE(TETRA_POINTS, "4 3 3 3", "0 2 2 1 0 1 3 0 3 2 1 2 3")),
      "POLYGON_SIDE_EMPTY " MESH_PATH "/polygon_sizes #0");
  rules_expect(BODY(SURFACE(TETRA_POINTS " 0.1 0 0", "3 4 3 3 3", "0 2 1 0 4 1 3 0 3 2 1 2 3 0 1 4")),
      "POLYGON_FLAT " MESH_PATH "/polygon_sizes #4");
  rules_expect(BODY(SURFACE(TETRA_POINTS, "3 3 3 3 3", TETRA_POLYGONS " 2 1 0")),
      "POLYGON_REPEATED " MESH_PATH "/polygon_sizes #4\nSURFACE_NONMANIFOLD " MESH_PATH);
}
END_TEST

START_TEST(test_seams)
{
  /* the last polygon stands on points of its own, in the same places */
  rules_expect(BODY(SURFACE(TETRA_POINTS " 0.2 0 0 0 0.2 0 -0 0 0.2", "3 3 3 3", "0 2 1 0 1 3 0 3 2 4 5 6")),
      "SURFACE_UNWELDED " MESH_PATH "/positions #4\nSURFACE_PIECES " MESH_PATH "\nSURFACE_OPEN " MESH_PATH);
}
END_TEST

START_TEST(test_pieces)
{
  rules_expect(BODY(SURFACE(TETRA_POINTS " 5 0 0 5.2 0 0 5 0.2 0 5 0 0.2", "3 3 3 3 3 3 3 3",
                   TETRA_POLYGONS " 4 6 5 4 5 7 4 7 6 5 6 7")),
      "SURFACE_PIECES " MESH_PATH);
}
END_TEST

START_TEST(test_crossing)
{
  rules_expect(BODY(SURFACE(TETRA_POINTS " 0.03 0.03 0.03 0.5 0.03 0.03 0.03 0.5 0.03 0.03 0.03 0.5",
                   "3 3 3 3 3 3 3 3", TETRA_POLYGONS " 4 6 5 4 5 7 4 7 6 5 6 7")),
      "SURFACE_PIECES " MESH_PATH "\nSURFACE_CROSSES " MESH_PATH "/polygon_sizes #3");
}
END_TEST

START_TEST(test_interior_points)
{
  rules_expect(
      BODY(TETRA "<interior>0.05 0.05 0.05 0 0 0</interior>"), ""); /* on the surface is not outside */
  rules_expect(BODY(TETRA "<interior>0.05 0.05 0.05 0.2 0.2 0.2 -1 0 0</interior>"),
      "INTERIOR_OUTSIDE /sbf/soft_body[1]/interior #1\nINTERIOR_OUTSIDE /sbf/soft_body[1]/interior #2");
}
END_TEST

START_TEST(test_empty_surfaces)
{ rules_expect(BODY(""), "SURFACE_EMPTY /sbf/soft_body[1]"); }
END_TEST

RULES_MAIN("surface_rules", test_a_closed_surface_is_good, test_open, test_a_sheet_may_be_open,
    test_nonmanifold, test_winding, test_unused_points, test_degenerate_polygons, test_seams, test_pieces,
    test_crossing, test_interior_points, test_empty_surfaces)
