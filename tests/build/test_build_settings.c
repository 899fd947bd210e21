#include <check.h>

#include "build/build_settings.h"
#include "harness.h"

START_TEST(test_recorded_settings)
{
  sbf_build_options options = {0};
  ck_assert(
      sbfi_build_settings_read("embeddings=false flexion=true hulls=false interior=centroid", &options));
  ck_assert(options.without_embeddings && !options.without_flexion && options.without_hulls);
  ck_assert_int_eq(options.interior, SBF_BUILD_INTERIOR_CENTROID);
  ck_assert(sbfi_build_settings_read("", &options));
}
END_TEST

START_TEST(test_written_settings_are_read)
{
  static const sbf_build_options samples[] = {
      {0},
      {.cell_m = 0.0125, .interior = SBF_BUILD_INTERIOR_TETRAHEDRA},
      {.elements = 4000000000u, .interior = SBF_BUILD_INTERIOR_LATTICE, .without_hulls = true},
      {.cell_m = 1e-6, .elements = 1, .interior = SBF_BUILD_INTERIOR_BRUTE, .without_embeddings = true},
      {.levels = 4, .error_m = 0.002, .without_calibration = true, .interior = SBF_BUILD_INTERIOR_TETRAHEDRA},
      {.cell_m = 4000, .interior = SBF_BUILD_INTERIOR_NONE, .without_flexion = true},
  };
  for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
    const sbf_build_options *o = &samples[i];
    sbf_build_options read = {0};
    char text[SBFI_BUILD_SETTINGS_SIZE], again[SBFI_BUILD_SETTINGS_SIZE];
    sbfi_build_settings_write(o, text);
    ck_assert(sbfi_build_settings_read(text, &read));
    ck_assert(read.cell_m == sbfi_build_settings_cell(o->cell_m));
    ck_assert_uint_eq(read.elements, o->elements);
    ck_assert_int_eq(read.interior, o->interior);
    ck_assert_int_eq(read.without_embeddings, o->without_embeddings);
    ck_assert_int_eq(read.without_flexion, o->without_flexion);
    ck_assert_int_eq(read.without_hulls, o->without_hulls);
    ck_assert_int_eq(read.without_calibration, o->without_calibration);
    ck_assert_uint_eq(read.levels, o->levels);
    ck_assert(read.error_m == o->error_m);
    sbfi_build_settings_write(&read, again);
    ck_assert_str_eq(text, again);
  }
}
END_TEST

START_TEST(test_cells_are_whole_micrometres)
{
  ck_assert(sbfi_build_settings_cell(0) == 0);
  ck_assert(sbfi_build_settings_cell(1e-9) == 1e-6);
  ck_assert(sbfi_build_settings_cell(0.1 / 3) == 33333 / 1e6);
  ck_assert(sbfi_build_settings_cell(1e9) == 4000);
}
END_TEST

START_TEST(test_unknown_settings)
{
  sbf_build_options options = {0};
  ck_assert(!sbfi_build_settings_read("interior=unheard_of", &options));
  ck_assert(!sbfi_build_settings_read("flexion=perhaps", &options));
  ck_assert(!sbfi_build_settings_read("magic=true", &options));
  ck_assert(!sbfi_build_settings_read("flexion", &options));
  ck_assert(!sbfi_build_settings_read("cell_um=0", &options));
  ck_assert(!sbfi_build_settings_read("cell_um=1.5", &options));
  ck_assert(!sbfi_build_settings_read("elements=", &options));
  ck_assert(!sbfi_build_settings_read("elements=5000000000", &options));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("build_settings");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_recorded_settings);
  tcase_add_test(all, test_written_settings_are_read);
  tcase_add_test(all, test_cells_are_whole_micrometres);
  tcase_add_test(all, test_unknown_settings);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
