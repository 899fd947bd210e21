#include "rules.h"

#define SET "/sbf/soft_body[1]/level[1]/spring_set[1]"
#define COLORED(ends, counts)                                                                                \
  BODY(LEVEL("", TETRA_POINTS, SPRINGS("", ends, "<color_counts>" counts "</color_counts>")))

START_TEST(test_springs)
{
  rules_expect(COLORED("0 1 2 3 0 2 1 3 0 3 1 2", "2 2 2"), "");
  rules_expect(COLORED("0 1 2 3 0 2 1 3 0 3 1 2", "2 0 2 2"), ""); /* a colour may be empty */
  rules_expect(COLORED("0 1 2 3 0 2 1 3 0 3 1 2", "3 1 2"),
      "COLORS_SHARED " SET "/ends #2\nCOLORS_SHARED " SET "/ends #2");
  rules_expect(COLORED("0 1 2 3 0 2 1 3 0 3 1 2", "2 2 1"), "COLORS_COUNT " SET "/color_counts");
}
END_TEST

START_TEST(test_tetrahedra)
{
  rules_expect(BODY(LEVEL("model=\"tetrahedra\"", TETRA_POINTS " 0.2 0.2 0.2",
                   LATTICE("0 1 2 3 1 2 3 4", "<color_counts>1 1</color_counts>"))),
      "");
  rules_expect(BODY(LEVEL("model=\"tetrahedra\"", TETRA_POINTS " 0.2 0.2 0.2",
                   LATTICE("0 1 2 3 1 2 3 4", "<color_counts>2</color_counts>"))),
      "COLORS_SHARED /sbf/soft_body[1]/level[1]/tetrahedron_mesh/tetrahedra #1\n"
      "COLORS_SHARED /sbf/soft_body[1]/level[1]/tetrahedron_mesh/tetrahedra #1\n"
      "COLORS_SHARED /sbf/soft_body[1]/level[1]/tetrahedron_mesh/tetrahedra #1");
}
END_TEST

RULES_MAIN("color_rules", test_springs, test_tetrahedra)
