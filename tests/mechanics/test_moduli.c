#include "harness.h"
#include "sbfmt/mechanics.h"

static const sbf_vec3 positions[5];
static const sbf_uint4 tetrahedra[2] = {{{0, 1, 2, 3}}, {{1, 2, 3, 4}}};
static const float factors[] = {1, 3, 1, 1, 5}, one[] = {7e4f}, each[] = {1e4f, 2e4f};
static sbf_soft_body body;
static sbf_level level;
static sbf_weight_map map;
static float scratch[5], moduli[2];

static void setup(void) {
  sbf_soft_body_init(&body);
  sbf_level_init(&level);
  sbf_weight_map_init(&map);
  body.attributes.young_modulus = 1000;
  level.positions = (sbf_vec3_list){positions, 5};
  level.lattice.tetrahedra = (sbf_uint4_list){tetrahedra, 2};
  map.property = SBF_WEIGHT_PROPERTY_YOUNG_MODULUS;
  map.values = (sbf_f32_list){factors, 5};
}

START_TEST(the_body_s)
{
  sbf_level_moduli(&body, &level, scratch, moduli);
  ck_assert_float_eq(moduli[0], 1000);
  ck_assert_float_eq(moduli[1], 1000);
  body.weight_maps = (sbf_weight_map_list){&map, 1};
  sbf_level_moduli(&body, &level, scratch, moduli);
  ck_assert_float_eq(moduli[0], 1500);
  ck_assert_float_eq(moduli[1], 2500);
}
END_TEST

START_TEST(the_modulus_of_the_lattice_has_precedence)
{
  body.weight_maps = (sbf_weight_map_list){&map, 1};
  level.lattice.young_modulus = (sbf_f32_list){one, 1};
  sbf_level_moduli(&body, &level, scratch, moduli);
  ck_assert_float_eq(moduli[1], 7e4f);
  level.lattice.young_modulus = (sbf_f32_list){each, 2};
  sbf_level_moduli(&body, &level, scratch, moduli);
  ck_assert_float_eq(moduli[0], 1e4f);
  ck_assert_float_eq(moduli[1], 2e4f);
}
END_TEST

int main(void) {
  Suite *s = suite_create("moduli");
  TCase *c = tcase_create("moduli");
  tcase_add_checked_fixture(c, setup, NULL);
  tcase_add_test(c, the_body_s);
  tcase_add_test(c, the_modulus_of_the_lattice_has_precedence);
  suite_add_tcase(s, c);
  return harness_run(s);
}
