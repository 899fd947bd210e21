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
  ck_assert_double_eq(needed(0.4f, 1000), 80000); /* the usual modulus supports that */
  ck_assert_double_eq(needed(2, 1000), 400000);   /* 392400, rounded up to two digits */
  ck_assert_double_eq(needed(2, 100), 80000);
  ck_assert_double_eq(needed(1e30f, 1e10f), 80000); /* no such thing */
  sbf_attributes is;
  sbf_attributes_init(&is);
  ck_assert_double_eq(sbfi_bearing_modulus(&is, &(sbf_vec3_list){NULL, 0}), 80000);
}
END_TEST

/* A box of 4 x 1 x 4 m on a leg of 1 x 1 x 1 m: at the middle of the leg 16.5 m^3 above 1 m^2, near its foot
 * 16.9; as one surface, the leg's top inside of it. On its head it stands as a column of 2 m does. */
START_TEST(a_column_needs_a_modulus_for_its_load)
{
  static const uint32_t quads[6][4] = {
      {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  sbf_vec3 points[16];
  uint32_t corners[48], sizes[12], count = 0;
  for (uint32_t i = 0; i < 16; i++) {
    float half = i < 8 ? 0.5f : 2, low = i < 8 ? 0 : 1, x = i & 1 ? half : -half, z = i & 4 ? half : -half;
    points[i] = (sbf_vec3){x, _i ? 2 - (low + (i & 2 ? 1.0f : 0)) : low + (i & 2 ? 1.0f : 0), _i ? -z : z};
  }
  for (uint32_t q = 0; q < 12; q++) {
    sizes[q] = 4;
    for (uint32_t k = 0; k < 4; k++) corners[count++] = quads[q % 6][k] + (q < 6 ? 0 : 8);
  }
  sbf_attributes is;
  sbf_attributes_init(&is);
  is.density = 1000;
  sbf_polygon_mesh mesh = {
      .positions = {points, 16}, .polygon_sizes = {sizes, 12}, .polygon_points = {corners, 48}};
  double expected =
      1000 * 9.81 * (_i ? 4 : 16.8) / 0.05; /* it is 4 m wide, the least that is reckoned with */
  ck_assert_double_eq_tol(sbfi_standing_modulus(&is, &mesh), expected, 0.04 * expected); /* two digits */
  ck_assert_double_eq_tol(sbfi_bearing_modulus(&is, &mesh.positions), 1000 * 9.81 * 4 / 0.05, 2e4);
  mesh.polygon_sizes.count = 0; /* nothing is enclosed: as a column */
  ck_assert_double_eq(sbfi_standing_modulus(&is, &mesh), sbfi_bearing_modulus(&is, &mesh.positions));
}
END_TEST

int main(void) {
  Suite *s = suite_create("bearing_modulus");
  TCase *c = tcase_create("bearing_modulus");
  tcase_add_test(c, by_weight);
  tcase_add_loop_test(c, a_column_needs_a_modulus_for_its_load, 0, 2);
  suite_add_tcase(s, c);
  return harness_run(s);
}
