#include <stdio.h>
#include <stdlib.h>

#include "rules.h"
#include "validate/repair/repair.h"

START_TEST(test_nothing_to_do)
{
  sbf_asset *asset, *fixed;
  sbf_fix_result result = {7, true};
  ck_assert_int_eq(
      sbf_load_file(harness_source("spec/samples/valid/everything.sbf"), NULL, &asset, NULL), SBF_OK);
  ck_assert_int_eq(sbf_fix(asset, NULL, &fixed, &result, NULL), SBF_OK);
  ck_assert(sbf_asset_equal(asset, fixed, NULL, 0));
  ck_assert_uint_eq(result.repaired, 0);
  ck_assert(!result.rebuilt);
  sbf_asset_free(fixed);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_lists_shrink)
{
  float *numbers = malloc(4 * sizeof *numbers);
  for (int i = 0; i < 4; i++) numbers[i] = (float)i;
  sbf_f32_list list = {numbers, 4};
  sbfi_list_drop(&list, sizeof *list.at, (const uint8_t[]){1, 0, 0, 1});
  ck_assert_uint_eq(list.count, 2);
  ck_assert(list.at[0] == 1 && list.at[1] == 2);
  sbfi_list_drop(&list, sizeof *list.at, (const uint8_t[]){1, 1});
  ck_assert_uint_eq(list.count, 0);
  ck_assert_ptr_null(list.at);
  free(numbers);
}
END_TEST

START_TEST(test_colors_shrink)
{
  uint32_t counts[] = {2, 0, 3};
  sbf_u32_list list = {counts, 3};
  sbfi_colors_drop(&list, (const uint8_t[]){0, 1, 1, 0, 1}, 5);
  ck_assert_uint_eq(counts[0], 1);
  ck_assert_uint_eq(counts[1], 0);
  ck_assert_uint_eq(counts[2], 1);
  sbfi_colors_drop(&list, (const uint8_t[]){1, 1, 1}, 3); /* they do not sum up: they stay */
  ck_assert_uint_eq(counts[0], 1);
}
END_TEST

START_TEST(test_unrepairable_faults)
{
  sbf_asset *asset = rules_load(ROOT_BONE RENDER("<skin><influence_counts>1 1 1 1</influence_counts><bones>0 "
                                                 "0 0 0</bones><weights>1 1 1 -1</weights></skin>"),
      true);
  sbf_asset *fixed = asset;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(sbf_fix(asset, NULL, &fixed, NULL, &error), SBF_BAD_INPUT);
  ck_assert_ptr_null(fixed);
  ck_assert_int_eq(error.code, SBF_CODE_VALUE_OUT_OF_RANGE);
  ck_assert_str_eq(error.path, "/sbf/render_mesh[1]/skin/weights");
  sbf_asset_free(asset);
}
END_TEST

/* Files with repairable errors load for repair; others are refused. */
START_TEST(test_loads_for_repair)
{
  static const struct {
    const char *inside;
    bool repairable;
  } cases[] = {
      {BODY(LEVEL("model=\"tetrahedra\"", TETRA_POINTS, LATTICE("1 0 2 3", ""))), true},
      {BODY(LEVEL("model=\"tetrahedra\"", TETRA_POINTS, LATTICE("1 0 2 4", ""))), false},
      {BODY(TETRA PINS("", "0", "<weights>1.5</weights>")), true},
      {BODY(TETRA PINS("maximum=\"1.5\"", "0", "")), false},
      {BODY(TETRA "<attributes restitution=\"2\"/>"), false},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    for (int repairable = 0; repairable < 2; repairable++) {
      char text[4096];
      sbf_asset *asset;
      sbf_load_options options = {.repairable = repairable};
      int length = snprintf(text, sizeof text, "<sbf version=\"1.0\">%s</sbf>", cases[i].inside);
      sbf_status status = sbf_xml_load_memory(text, (size_t)length, &options, &asset, NULL);
      ck_assert_msg((status == SBF_OK) == (repairable && cases[i].repairable), "case %zu, %d", i, repairable);
      sbf_asset_free(asset);
    }
}
END_TEST

START_TEST(test_memory_runs_out)
{
  sbf_asset *asset = rules_load(
      ROOT_BONE RENDER("") SECTION(SURFACE(TETRA_POINTS " 1 1 1", "3 3 3 3", "0 2 1 0 1 3 0 3 2 1 3 2")
              PINS("bone=\"root\"", "0 0", "") LEVEL(
                  "", TETRA_POINTS, SPRINGS("", "0 1 1 0 2 2 0 3 1 2 1 3 2 3", "") LATTICE("1 0 2 3", ""))),
      true);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    sbf_diagnostic error = {0};
    sbf_asset *fixed;
    harness_memory_init(&memory, allowed);
    sbf_fix_options options = {.allocator = &memory.allocator};
    sbf_status status = sbf_fix(asset, &options, &fixed, NULL, &error);
    if (status == SBF_OK) {
      sbf_asset_free(fixed);
      ck_assert_uint_eq(memory.held_bytes, 0);
      break;
    }
    ck_assert_ptr_null(fixed);
    ck_assert_uint_eq(memory.held_bytes, 0);
    ck_assert_int_eq(status, SBF_FAILED);
    ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
  }
  sbf_asset_free(asset);
}
END_TEST

RULES_MAIN("fix", test_nothing_to_do, test_lists_shrink, test_colors_shrink, test_unrepairable_faults,
    test_loads_for_repair, test_memory_runs_out)
