#include "model/ids.h"

#include <stdio.h>
#include <string.h>

#include "fill_asset.h"
#include "harness.h"

START_TEST(test_many_ids)
{
  enum { COUNT = 3000 };
  static char names[COUNT][16];
  sbfi_ids ids;
  const sbfi_id_entry *first;
  sbfi_ids_init(&ids, NULL);
  ck_assert_ptr_null(sbfi_ids_find(&ids, "0"));
  for (uint32_t i = 0; i < COUNT; i++) {
    snprintf(names[i], sizeof names[i], "%x", i * 2654435761u);
    ck_assert(sbfi_ids_add(&ids, (sbfi_id_entry){.id = names[i], .index = i}, &first));
    ck_assert_ptr_null(first);
  }
  for (uint32_t i = 0; i < COUNT; i++) {
    char copy[sizeof names[i]];
    memcpy(copy, names[i], sizeof copy);
    ck_assert_uint_eq(sbfi_ids_find(&ids, copy)->index, i);
    ck_assert(sbfi_ids_add(&ids, (sbfi_id_entry){.id = copy, .index = 7}, &first));
    ck_assert_ptr_nonnull(first);
    ck_assert_uint_eq(first->index, i);
  }
  ck_assert_uint_eq(ids.count, COUNT);
  ck_assert_ptr_null(sbfi_ids_find(&ids, "nobody"));
  ck_assert_ptr_null(sbfi_ids_find(&ids, ""));
  sbfi_ids_free(&ids);
}
END_TEST

START_TEST(test_ids_that_differ_little)
{
  static const char *const names[] = {
      "a", "aa", "aaa", "aaaaaaaa", "aaaaaaaaa", "aaaaaaab", "baaaaaaa", "A", " a"};
  enum { COUNT = sizeof names / sizeof *names };
  sbfi_ids ids;
  const sbfi_id_entry *first;
  sbfi_ids_init(&ids, NULL);
  for (uint32_t i = 0; i < COUNT; i++) {
    ck_assert(sbfi_ids_add(&ids, (sbfi_id_entry){.id = names[i], .index = i}, &first));
    ck_assert_ptr_null(first);
  }
  for (uint32_t i = 0; i < COUNT; i++) ck_assert_uint_eq(sbfi_ids_find(&ids, names[i])->index, i);
  sbfi_ids_free(&ids);
}
END_TEST

START_TEST(test_references_to_ids_and_back)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 4, .children = 5});
  sbfi_ids ids;
  sbfi_ids_init(&ids, NULL);
  ck_assert(sbfi_ids_add_collections(&ids, asset));
  const sbfi_field *bodies = sbfi_element_field(&sbfi_asset_element, "soft_bodies");
  const sbfi_field *bone = sbfi_element_field(bodies->element, "bone");
  ck_assert_str_eq(sbfi_ref_collection(bone)->name, "bones");
  ck_assert_uint_eq(sbfi_ref_count(asset, bone), 5);
  for (int32_t i = 0; i < 5; i++) {
    const char *id = sbfi_ref_id(asset, bone, i);
    ck_assert_str_eq(id, asset->bones.at[i].id);
    const sbfi_id_entry *entry = sbfi_ids_find(&ids, id);
    ck_assert_ptr_eq(entry->collection, sbfi_ref_collection(bone));
    ck_assert_uint_eq(entry->index, (uint32_t)i);
  }
  ck_assert_ptr_null(sbfi_ref_id(asset, bone, SBF_NONE));
  ck_assert_ptr_null(sbfi_ref_id(asset, bone, 5));
  ck_assert_ptr_null(sbfi_ids_find(&ids, asset->environment.fields.at[0].id)); /* not in the root */
  sbfi_ids_free(&ids);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_memory_runs_out)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 4, .children = 40});
  for (size_t allowed = 0; allowed < 4; allowed++) {
    harness_memory memory;
    sbfi_ids ids;
    harness_memory_init(&memory, allowed);
    sbfi_ids_init(&ids, &memory.allocator);
    ck_assert(!sbfi_ids_add_collections(&ids, asset));
    sbfi_ids_free(&ids);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("ids");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_many_ids);
  tcase_add_test(all, test_ids_that_differ_little);
  tcase_add_test(all, test_references_to_ids_and_back);
  tcase_add_test(all, test_memory_runs_out);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
