#include "mechanics/bearing_modulus.h"

#include "harness.h"

static double needed(float height, float density) {
  const sbf_vec3 points[2] = {{0, 1, 0}, {0.1f, 1 + height, 0}};
  sbf_attributes is;
  sbf_attributes_init(&is);
  is.density = density;
  return sbfi_bearing_modulus(&is, &(sbf_vec3_list){points, 2});
}

/* rho g h / E = 1/20 */
START_TEST(by_weight)
{
  ck_assert_double_eq(needed(0.4f, 1000), 80000); /* the usual modulus bears that */
  ck_assert_double_eq(needed(2, 1000), 400000);   /* 392400, rounded up to two digits */
  ck_assert_double_eq(needed(2, 100), 80000);
  ck_assert_double_eq(needed(1e30f, 1e10f), 80000); /* no such thing */
  sbf_attributes is;
  sbf_attributes_init(&is);
  ck_assert_double_eq(sbfi_bearing_modulus(&is, &(sbf_vec3_list){NULL, 0}), 80000);
}
END_TEST

int main(void) {
  Suite *s = suite_create("bearing_modulus");
  TCase *c = tcase_create("bearing_modulus");
  tcase_add_test(c, by_weight);
  suite_add_tcase(s, c);
  return harness_run(s);
}
