#include <string.h>

#include "harness.h"
#include "sbfmt/materials.h"

static const char *const asked_for[] = {
    "cotton", "denim", "fat", "flesh", "jelly", "leather", "muscle", "rubber", "silk"};

START_TEST(every_preset_is_found_and_sound)
{
  uint32_t count;
  const sbf_material_preset *presets = sbf_material_presets(&count);
  ck_assert_uint_eq(count, sizeof asked_for / sizeof *asked_for);
  for (uint32_t i = 0; i < count; i++) {
    const sbf_material_preset *p = &presets[i];
    ck_assert_str_eq(p->name, asked_for[i]);
    ck_assert_ptr_eq(sbf_material_find(p->name), p);
    ck_assert(p->density > 100 && p->density < 3000 && p->young_modulus > 0);
    ck_assert(p->poisson_ratio > 0 && p->poisson_ratio <= 0.48f);
    ck_assert_uint_gt(strlen(p->source), 20);
    ck_assert_int_eq(p->cloth, p->area_density > 0);
    if (!p->cloth) continue;
    /* A weave bends more easily than a plate, but not by more than the square of its threads. */
    double plate = p->young_modulus * p->thickness * p->thickness * p->thickness / 12;
    ck_assert(p->bending_stiffness < 1.2 * plate && p->bending_stiffness > 1e-3 * plate);
    ck_assert_float_eq_tol(p->density, p->area_density / p->thickness, 10);
  }
  ck_assert_ptr_null(sbf_material_find("unobtainium"));
}
END_TEST

START_TEST(a_preset_sets_its_own_values_only)
{
  sbf_attributes attributes;
  sbf_attributes_init(&attributes);
  attributes.mass = 7;
  attributes.gravity_scale = 0.5f;
  attributes.pressure_mode = SBF_PRESSURE_MODE_VOLUME;
  sbf_material_apply(sbf_material_find("fat"), &attributes);
  ck_assert_float_eq(attributes.young_modulus, 4000);
  ck_assert_float_eq(attributes.mass, 7);
  ck_assert_float_eq(attributes.gravity_scale, 0.5f);
  ck_assert_int_eq(attributes.pressure_mode, SBF_PRESSURE_MODE_VOLUME);
  sbf_material_apply(sbf_material_find("silk"), &attributes);
  ck_assert_float_eq(attributes.area_density, 0.06f);
  ck_assert_int_eq(attributes.pressure_mode, SBF_PRESSURE_MODE_NONE);
  sbf_material_apply(sbf_material_find("rubber"), &attributes);
  ck_assert_float_eq(attributes.area_density, 0);
  ck_assert_float_eq(attributes.bending_stiffness, 0);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("material_presets");
  TCase *c = tcase_create("material_presets");
  tcase_add_test(c, every_preset_is_found_and_sound);
  tcase_add_test(c, a_preset_sets_its_own_values_only);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
