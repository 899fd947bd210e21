#include "rules.h"

START_TEST(test_gravity)
{
  rules_expect("<environment gravity=\"0 0 0\"/>", ""); /* in space */
  rules_expect("<environment gravity=\"0 -24.8 0\"/>", "");
  rules_expect("<environment gravity=\"0 -981 0\"/>", "GRAVITY_LOOKS_WRONG /sbf/environment");
  rules_expect("<environment gravity=\"0 9.81 0\"/>", "GRAVITY_LOOKS_WRONG /sbf/environment");
}
END_TEST

START_TEST(test_fields)
{
#define FIELD(attributes) "<environment><force_field id=\"f\" strength=\"1\" " attributes "/></environment>"
  rules_expect(FIELD("kind=\"radial\""), "");
  rules_expect(FIELD("kind=\"uniform\" direction=\"0 0 1\""), "");
  rules_expect(FIELD("kind=\"uniform\""), "FIELD_NO_DIRECTION /sbf/environment/force_field[1]");
  rules_expect(FIELD("kind=\"vortex\""), "FIELD_NO_DIRECTION /sbf/environment/force_field[1]");
}
END_TEST

RULES_MAIN("environment_rules", test_gravity, test_fields)
