#include "fill_asset.h"
#include "rules.h"
#include "small_asset.h"

typedef struct report {
  uint32_t count;
  sbf_diagnostic last;
} report;

static void take(void *user, const sbf_diagnostic *d) {
  report *t = user;
  t->count++;
  t->last = *d;
}

#define MANY                                                                                                 \
  BODY(LEVEL("", TETRA_POINTS, SPRINGS("", TETRA_EDGES " 0 0 1 1 2 2 3 3 0 0 1 1 2 2 3 3 0 0 1 1", "")))

START_TEST(test_the_first_of_many_are_listed)
{
  sbf_asset *asset = rules_load(MANY, false);
  report t = {0};
  sbf_validate_result result;
  sbf_validate_options options = {.report = take, .user = &t};
  ck_assert_int_eq(sbf_validate(asset, &options, &result, NULL), SBF_OK);
  ck_assert_uint_eq(result.errors, 10);
  ck_assert_uint_eq(t.count, 9);
  ck_assert_str_eq(t.last.message, "and 2 more of this kind here");
  ck_assert_int_eq(t.last.index, -1);
  t.count = 0;
  options.repeats = 10;
  ck_assert_int_eq(sbf_validate(asset, &options, &result, NULL), SBF_OK);
  ck_assert_uint_eq(t.count, 10);
  ck_assert_int_eq(t.last.index, 15);
  ck_assert_int_eq(sbf_validate(asset, NULL, NULL, NULL), SBF_OK);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_messages_end_with_advice)
{
  sbf_asset *asset = rules_load(BODY(""), false);
  report t = {0};
  sbf_validate_options options = {.report = take, .user = &t};
  ck_assert_int_eq(sbf_validate(asset, &options, NULL, NULL), SBF_OK);
  ck_assert_str_eq(t.last.message, "'B' has neither polygons nor a level: add polygons or a level");
  ck_assert_str_eq(t.last.path, "/sbf/soft_body[1]");
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_an_older_caller)
{
  sbf_asset *asset = rules_load(MANY, false);
  report t = {0};
  sbf_validate_options options = {.report = take, .user = &t, .repeats = 1};
  options.struct_size = offsetof(sbf_validate_options, folder); /* before there was a folder */
  ck_assert_int_eq(sbf_validate(asset, &options, NULL, NULL), SBF_OK);
  ck_assert_uint_eq(t.count, 2);
  sbf_asset_free(asset);
}
END_TEST

/* Whatever allocation fails: it says so, and nothing is left held. */
START_TEST(test_memory_runs_out)
{
  sbf_asset *assets[] = {small_asset(), rules_load(MANY, false)};
  for (int i = 0; i < 2; i++) {
    for (size_t allowed = 0;; allowed++) {
      harness_memory memory;
      sbf_diagnostic error = {0};
      harness_memory_init(&memory, allowed);
      sbf_validate_options options = {.allocator = &memory.allocator};
      sbf_status status = sbf_validate(assets[i], &options, NULL, &error);
      ck_assert_uint_eq(memory.held_bytes, 0);
      if (status == SBF_OK) break;
      ck_assert_int_eq(status, SBF_FAILED);
      ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    }
    sbf_asset_free(assets[i]);
  }
}
END_TEST

/* Rules must accept everything that the structure allows: every field has random content. */
START_TEST(test_any_sound_structure)
{
  for (uint32_t seed = 1; seed < 40; seed++) {
    fill_options options = {.seed = seed};
    sbf_asset *asset = fill_asset(&options), *fixed = NULL;
    ck_assert_ptr_nonnull(asset);
    ck_assert_int_eq(sbf_validate(asset, NULL, NULL, NULL), SBF_OK);
    ck_assert_int_eq(sbf_fix(asset, NULL, &fixed, NULL, NULL), SBF_OK);
    ck_assert_int_eq(sbf_validate(fixed, NULL, NULL, NULL), SBF_OK);
    sbf_asset_free(fixed);
    sbf_asset_free(asset);
  }
}
END_TEST

RULES_MAIN("validate", test_the_first_of_many_are_listed, test_messages_end_with_advice, test_an_older_caller,
    test_memory_runs_out, test_any_sound_structure)
