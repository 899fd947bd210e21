#include "rules.h"

#define SET(attributes) BODY(LEVEL("", TETRA_POINTS, SPRINGS(attributes, TETRA_EDGES, "")))
#define FOUND "STRAIN_ORDER /sbf/soft_body[1]/level[1]/spring_set[1]"

START_TEST(test_in_order)
{
  rules_expect(SET("yield_strain=\"0.2\" tear_strain=\"0.5\" strain_max=\"0.8\""), "");
  rules_expect(SET("tear_strain=\"0.5\""), "");
  rules_expect(SET("yield_strain=\"0.5\" strain_max=\"0.3\""), ""); /* it yields when pressed */
}
END_TEST

START_TEST(test_out_of_order)
{
  rules_expect(SET("tear_strain=\"0.5\" strain_max=\"0.5\""), FOUND);
  rules_expect(SET("yield_strain=\"0.6\" tear_strain=\"0.5\""), FOUND);
  rules_expect(SET("yield_strain=\"0.5\" strain_max=\"0.3\" strain_min=\"-0.4\""), FOUND);
}
END_TEST

START_TEST(test_of_the_body)
{
  rules_expect(BODY(TETRA "<attributes yield_strain=\"0.6\" tear_strain=\"0.5\"/>"),
      "STRAIN_ORDER /sbf/soft_body[1]/attributes");
}
END_TEST

RULES_MAIN("strain_order", test_in_order, test_out_of_order, test_of_the_body)
