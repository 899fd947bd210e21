#include "rules.h"

#define PATH "/sbf/render_mesh[1]/render_level"
#define COARSER(attributes, sizes, points, more)                                                             \
  "<render_level " attributes "><polygon_sizes>" sizes "</polygon_sizes><polygon_points>" points             \
  "</polygon_points>" more "</render_level>"

START_TEST(test_order)
{
  rules_expect(
      RENDER(COARSER("error=\"0.2\"", "3 3", "0 1 2 0 2 3", "") COARSER("error=\"0.2\"", "3", "0 1 2", "")),
      "");
  rules_expect(RENDER(COARSER("error=\"0.2\"", "3", "0 1 2", "") COARSER("error=\"0.2\"", "3", "0 2 1", "")),
      "RENDER_LEVEL_ORDER " PATH "[2]");
}
END_TEST

/* Triangles are compared, not polygons: a mesh of one pentagon has three. */
START_TEST(test_order_of_long_polygons)
{
#define PENTAGON(levels)                                                                                     \
  "<render_mesh id=\"r\" name=\"R\">" MESH("rendering", "0 0 0 2 0 0 3 0 2 1 0 3 -1 0 2", "5", "0 4 3 2 1")  \
      levels "</render_mesh>"
  rules_expect(PENTAGON(COARSER("error=\"2\"", "3 3", "0 4 3 0 3 2", "")), "");
  rules_expect(
      PENTAGON(COARSER("error=\"2\"", "3 3 3", "0 4 3 0 3 2 0 2 1", "")), "RENDER_LEVEL_ORDER " PATH "[1]");
}
END_TEST

/* The full mesh's corners are at the points 0 2 1  0 1 3  0 3 2  1 2 3. */
START_TEST(test_corners)
{
  rules_expect(RENDER(COARSER("error=\"0.2\"", "3", "0 1 2", "<corners>6 9 1</corners>")), "");
  rules_expect(RENDER(COARSER("error=\"0.2\"", "3", "0 1 2", "<corners>6 9 2</corners>")),
      "RENDER_LEVEL_CORNER " PATH "[1]/corners #2");
}
END_TEST

/* The tetrahedron without its slanting face: the tip above the remaining one is 0.2 m off. */
START_TEST(test_errors)
{
  rules_expect(RENDER(COARSER("error=\"0.2\"", "3", "0 2 1", "")), "");
  rules_expect(RENDER(COARSER("error=\"0.199\"", "3", "0 2 1", "")), "RENDER_LEVEL_ERROR " PATH "[1]");
  rules_expect(RENDER(COARSER("", "3 3 3", "0 2 1 0 1 3 0 3 2", "")), ""); /* all its points are there */
}
END_TEST

RULES_MAIN("render_level_rules", test_order, test_order_of_long_polygons, test_corners, test_errors)
