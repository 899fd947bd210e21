#include "rules.h"

#define WITH(attributes) BODY(TETRA "<collision " attributes "/>")
#define TABLE(attributes)                                                                                    \
  "<rigid_bodies><rigid_body id=\"t\" name=\"T\" mass=\"1\" " attributes "/></rigid_bodies>"

START_TEST(test_self)
{
  rules_expect(WITH("self=\"true\" layer=\"2\" mask=\"3\""), "");
  rules_expect(
      WITH("self=\"true\" layer=\"2\" mask=\"1\""), "COLLISION_SELF_MASKED /sbf/soft_body[1]/collision");
  rules_expect(WITH("layer=\"2\" mask=\"1\""), ""); /* it is not asked to */
}
END_TEST

START_TEST(test_pairs)
{
  rules_expect(WITH("layer=\"2\" mask=\"3\"") TABLE("layer=\"1\" mask=\"2\""), "");
  rules_expect(WITH("layer=\"2\" mask=\"3\"") TABLE("layer=\"1\" mask=\"1\""),
      "COLLISION_ONE_SIDED /sbf/soft_body[1]");
  rules_expect(WITH("layer=\"2\" mask=\"2\"") TABLE("layer=\"1\" mask=\"3\""),
      "COLLISION_ONE_SIDED /sbf/rigid_bodies/rigid_body[1]");
  rules_expect(WITH("layer=\"2\" mask=\"2\"") TABLE("layer=\"1\" mask=\"1\""), "");
}
END_TEST

START_TEST(test_sizes)
{
  rules_expect(WITH("particle_radius=\"0.3\""), "");
  rules_expect(WITH("particle_radius=\"0.4\""), "PARTICLE_TOO_LARGE /sbf/soft_body[1]/collision");
}
END_TEST

RULES_MAIN("collision_rules", test_self, test_pairs, test_sizes)
