#include "rules.h"

#define TETRAHEDRA "/sbf/soft_body[1]/level[1]/tetrahedron_mesh/tetrahedra"
#define BODY_OF(points, tetrahedra) BODY(LEVEL("model=\"tetrahedra\"", points, LATTICE(tetrahedra, "")))

START_TEST(test_a_good_lattice)
{ rules_expect(BODY_OF(TETRA_POINTS " 0.2 0.2 0.2", "0 1 2 3 1 2 3 4"), ""); }
END_TEST

START_TEST(test_slivers)
{
  /* its sharpest angle is 2 atan(0.05 sqrt(2)) = 8 degrees, and half of that */
  rules_expect(BODY_OF("0 0 0 1 0 0 0.5 0.5 0.05 0.5 -0.5 0.05", "0 1 2 3"), "");
  rules_expect(
      BODY_OF("0 0 0 1 0 0 0.5 0.5 0.02 0.5 -0.5 0.02", "0 1 2 3"), "TETRAHEDRON_SLIVER " TETRAHEDRA " #0");
}
END_TEST

START_TEST(test_duplicates)
{
  rules_expect(BODY_OF(TETRA_POINTS, "0 1 2 3 1 2 0 3 3 1 0 2"),
      "TETRAHEDRON_DUPLICATE " TETRAHEDRA " #1\nTETRAHEDRON_DUPLICATE " TETRAHEDRA " #2");
}
END_TEST

START_TEST(test_overlaps)
{
  rules_expect(
      BODY_OF(TETRA_POINTS " 0.05 0.05 0.3", "0 1 2 3 0 1 2 4"), "LATTICE_OVERLAP " TETRAHEDRA " #1");
  /* two below one face: the second of them stands on a full face, on the side of the first */
  rules_expect(BODY_OF(TETRA_POINTS " 0 0 -0.2 0.1 0.1 -0.2", "0 1 2 3 0 2 1 4 0 2 1 5"),
      "LATTICE_NONMANIFOLD " TETRAHEDRA " #2");
}
END_TEST

START_TEST(test_pieces_and_points)
{
  rules_expect(BODY_OF(TETRA_POINTS " 5 0 0 5.2 0 0 5 0.2 0 5 0 0.2", "0 1 2 3 4 5 6 7"),
      "LATTICE_PIECES /sbf/soft_body[1]/level[1]/tetrahedron_mesh");
  rules_expect(BODY_OF(TETRA_POINTS " 5 0 0", "0 1 2 3"),
      "LATTICE_POINT_UNUSED /sbf/soft_body[1]/level[1]/tetrahedron_mesh");
}
END_TEST

START_TEST(test_empty)
{
  rules_expect(BODY(LEVEL("model=\"tetrahedra\"", TETRA_POINTS, "")),
      "LEVEL_EMPTY /sbf/soft_body[1]/level[1]/tetrahedron_mesh");
}
END_TEST

RULES_MAIN("lattice_rules", test_a_good_lattice, test_slivers, test_duplicates, test_overlaps,
    test_pieces_and_points, test_empty)
