#include "model/unique_id.h"

#include "harness.h"
#include "sbfmt/asset.h"

START_TEST(taken_ids_get_a_number)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  sbfi_ids ids;
  sbfi_ids_init(&ids, NULL);
  const sbfi_id_entry *first;
  ck_assert(sbfi_ids_add(&ids, (sbfi_id_entry){.id = "hull_b"}, &first));
  ck_assert_str_eq(sbfi_unique_id(&ids, "hull_", "a", 5, asset), "hull_a");
  ck_assert_str_eq(sbfi_unique_id(&ids, "hull_", "b", 6, asset), "hull_b.2");
  ck_assert_str_eq(sbfi_unique_id(&ids, "hull_", "b", 7, asset), "hull_b.3");
  ck_assert_uint_eq(sbfi_ids_find(&ids, "hull_a")->index, 5);
  ck_assert_uint_eq(sbfi_ids_find(&ids, "hull_b.3")->index, 7);
  sbfi_ids_free(&ids);
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("unique_id");
  TCase *c = tcase_create("unique_id");
  tcase_add_test(c, taken_ids_get_a_number);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
