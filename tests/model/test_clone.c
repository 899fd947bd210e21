#include "sbfmt/asset.h"

#include "fill_asset.h"
#include "harness.h"
#include "promises.h"

START_TEST(test_a_copy_is_equal_and_has_its_own_memory)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 11}), *same = fill_asset(&(fill_options){.seed = 11});
  sbf_asset *copy = sbf_asset_clone(asset, NULL);
  char path[256];
  ck_assert_msg(sbf_asset_equal(asset, copy, path, sizeof path), "%s", path);
  sbf_asset_free(asset); /* under the address sanitizer, anything shared is now an error */
  ck_assert_msg(sbf_asset_equal(same, copy, path, sizeof path), "%s", path);
  ck_assert_promises_kept(copy);
  sbf_asset_free(copy);
  sbf_asset_free(same);
}
END_TEST

START_TEST(test_a_copy_keeps_values_that_differ_by_machine)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 11}), *copy = sbf_asset_clone(asset, NULL);
  const sbf_simulation *simulation = &copy->soft_bodies.at[0].levels.at[0].simulation;
  ck_assert_uint_gt(simulation->measured.count, 0);
  ck_assert_str_eq(simulation->measured.at[0].machine,
      asset->soft_bodies.at[0].levels.at[0].simulation.measured.at[0].machine);
  sbf_asset_free(asset);
  sbf_asset_free(copy);
}
END_TEST

START_TEST(test_every_failed_allocation_frees_everything)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 11});
  size_t allowed = 0;
  for (sbf_asset *copy = NULL; !copy; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    copy = sbf_asset_clone(asset, &memory.allocator);
    if (copy) ck_assert(sbf_asset_equal(asset, copy, NULL, 0));
    sbf_asset_free(copy);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  ck_assert_uint_gt(allowed, 4);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("clone");
  TCase *tests = tcase_create("clone");
  tcase_add_test(tests, test_a_copy_is_equal_and_has_its_own_memory);
  tcase_add_test(tests, test_a_copy_keeps_values_that_differ_by_machine);
  tcase_add_test(tests, test_every_failed_allocation_frees_everything);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
