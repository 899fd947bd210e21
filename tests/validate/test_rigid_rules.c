#include "rules.h"

#define RIGID(attributes, inside)                                                                            \
  "<rigid_bodies><rigid_body id=\"x\" name=\"X\" " attributes ">" inside "</rigid_body></rigid_bodies>"
#define HULL(polygons) MESH("collision_detection", TETRA_POINTS, "3 3 3 3", polygons)
#define PATH "/sbf/rigid_bodies/rigid_body[1]"

START_TEST(test_mass)
{
  rules_expect(RIGID("motion=\"dynamic\"", ""), "BODY_NO_MASS " PATH);
  rules_expect(RIGID("motion=\"dynamic\" mass=\"1\"", ""), "");
  rules_expect(RIGID("motion=\"dynamic\"", HULL(TETRA_POLYGONS)), "");
  rules_expect(RIGID("", ""), "");
}
END_TEST

START_TEST(test_hulls)
{
  rules_expect(
      RIGID("", HULL("0 1 2 0 3 1 0 2 3 1 3 2")), "HULL_NOT_CONVEX " PATH "/polygon_mesh"); /* inside out */
  rules_expect(
      RIGID("", HULL("0 2 1 0 1 3 0 3 2 1 3 2")), "HULL_OPEN " PATH "/polygon_mesh"); /* one turned round */
}
END_TEST

START_TEST(test_inertia)
{
  rules_expect(RIGID("mass=\"1\" inertia=\"1 1 2\"", ""), ""); /* a disc's */
  rules_expect(RIGID("mass=\"1\" inertia=\"2.1 1 1\"", ""), "INERTIA_IMPOSSIBLE " PATH);
  rules_expect(RIGID("mass=\"1\" inertia=\"0 1 0\"", ""), "INERTIA_IMPOSSIBLE " PATH);
}
END_TEST

START_TEST(test_center)
{
  rules_expect(RIGID("center=\"1 1 1\"", HULL(TETRA_POLYGONS)), ""); /* an origin, no centre of mass */
  rules_expect(
      RIGID("mass=\"1\" center=\"1 1 1\" inertia=\"1 1 1\"", HULL(TETRA_POLYGONS)), "CENTER_OUTSIDE " PATH);
  rules_expect(RIGID("mass=\"1\" center=\"0.05 0.05 0.05\" inertia=\"1 1 1\"", HULL(TETRA_POLYGONS)), "");
}
END_TEST

RULES_MAIN("rigid_rules", test_mass, test_hulls, test_inertia, test_center)
