#include "rules.h"

START_TEST(test_bodies_are_attached)
{
  rules_expect(BODY(TETRA), ""); /* without a skeleton there is nothing to hang on */
  rules_expect(ROOT_BONE BODY(TETRA), "SECTION_NO_BONE /sbf/soft_body[1]");
  rules_expect(ROOT_BONE BODY(TETRA PINS("", "0", "")), "");
  rules_expect(ROOT_BONE SECTION(TETRA), "");
}
END_TEST

START_TEST(test_sections_are_near_their_bones)
{
#define AT(head, more) "<skeleton>" BONE("root", head, more) "</skeleton>" SECTION(TETRA)
  rules_expect(AT("0 0.5 0", "length=\"0.2\""), "");
  rules_expect(AT("0 2 0", "length=\"0.2\""), "SECTION_FAR /sbf/soft_body[1]");
  rules_expect(AT("0 -2 0", "length=\"2\""), ""); /* its tail is there */
  rules_expect(AT("2 0 0", "length=\"2\" rotation=\"0 0 0.70710677 0.70710677\""), "");
}
END_TEST

RULES_MAIN("section_rules", test_bodies_are_attached, test_sections_are_near_their_bones)
