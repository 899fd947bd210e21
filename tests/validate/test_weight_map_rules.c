#include "rules.h"

#define MAP(property, values, more)                                                                          \
  BODY(TETRA more "<weight_map property=\"" property "\"><values>" values "</values></weight_map>")
#define PATH "/sbf/soft_body[1]/weight_map[1]"

START_TEST(test_density)
{
  rules_expect(MAP("density", "0.5 1 2 1", ""), "");
  rules_expect(MAP("density", "0 1 2 1", ""), "WEIGHT_MAP_ZERO " PATH "/values #0");
  rules_expect(
      BODY(TETRA "<weight_map property=\"density\"><values>0 1 1 1</values></weight_map>" PINS("", "0", "")),
      "");
}
END_TEST

START_TEST(test_modulus)
{
  rules_expect(MAP("young_modulus", "0 0 0 1", ""), "");
  rules_expect(MAP("young_modulus", "0 0 0 0", ""), "WEIGHT_MAP_ZERO " PATH "/values");
}
END_TEST

START_TEST(test_idle_maps)
{
  rules_expect(MAP("pressure", "1 1 1 2", ""), "WEIGHT_MAP_IDLE " PATH);
  rules_expect(MAP("pressure", "1 1 1 2", "<attributes pressure=\"9\" pressure_mode=\"gas\"/>"), "");
  rules_expect(MAP("mass_damping", "1 1 1 2", ""), "WEIGHT_MAP_IDLE " PATH);
  rules_expect(MAP("stiffness_damping", "1 1 1 2", ""), "WEIGHT_MAP_IDLE " PATH);
  rules_expect(MAP("friction", "1 1 1 2", ""), "");
  rules_expect(MAP("bending_stiffness", "1 1 1 2", ""), ""); /* 0 there stands for one from the modulus */
  rules_expect(MAP("tear_strain", "1 1 1 2", ""), "WEIGHT_MAP_IDLE " PATH);
  rules_expect(BODY(TETRA "<weight_map property=\"tear_strain\"><values>1 1 1 2</values></weight_map>" LEVEL(
                   "", TETRA_POINTS, SPRINGS("tear_strain=\"2\"", TETRA_EDGES, ""))),
      "");
}
END_TEST

RULES_MAIN("weight_map_rules", test_density, test_modulus, test_idle_maps)
