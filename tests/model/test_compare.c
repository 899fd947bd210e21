#include "sbfmt/asset.h"

#include <string.h>

#include "fill_asset.h"
#include "harness.h"
#include "model/element_path.h"

/* Changes the first of every field, in turn, and lets `visit` look at the asset in that state. */
typedef struct tour {
  sbf_asset *asset;
  void (*visit)(struct tour *tour, const sbfi_element_path *path, const sbfi_field *field, bool in_volatile);
  const sbf_asset *original;
  uint32_t visits;
} tour;

static void flip_byte(
    tour *t, void *at, const sbfi_element_path *path, const sbfi_field *field, bool in_volatile) {
  uint8_t *byte = at;
  *byte ^= 1;
  t->visit(t, path, field, in_volatile);
  *byte ^= 1;
}

static void visit_fields(tour *t, const sbfi_element_path *path, bool in_volatile) {
  for (uint32_t i = 0; i < path->element->field_count; i++) {
    const sbfi_field *field = &path->element->fields[i];
    char *at = (char *)(uintptr_t)path->object + field->offset;
    bool within = in_volatile || field->volatile_;
    uint32_t count = sbfi_child_count(path->object, field);
    for (uint32_t k = 0; k < count; k++) {
      sbfi_element_path child = sbfi_element_path_child(path, field, k);
      visit_fields(t, &child, within);
    }
    switch (field->type) {
    case SBFI_STRING:
    case SBFI_TEXT:
    case SBFI_ID: {
      char *text = (char *)(uintptr_t)sbfi_get_pointer(path->object, field);
      if (strlen(text) > 3) flip_byte(t, text, path, field, within); /* not a default, which is constant */
      break;
    }
    case SBFI_LIST: {
      sbfi_list list = sbfi_get_list(path->object, field);
      if (list.count)
        flip_byte(t, (char *)(uintptr_t)list.at + (size_t)list.count * sbfi_item_size(field) - 1, path, field,
            within);
      break;
    }
    case SBFI_ONE:
      break;
    case SBFI_OPTIONAL: {
      const void *child = sbfi_get_pointer(path->object, field);
      sbfi_set_pointer((void *)(uintptr_t)path->object, field, NULL);
      if (child) t->visit(t, path, field, within);
      sbfi_set_pointer((void *)(uintptr_t)path->object, field, child);
      break;
    }
    case SBFI_MANY: {
      sbfi_list list = sbfi_get_list(path->object, field);
      sbfi_set_list((void *)(uintptr_t)path->object, field, list.at, list.count - 1);
      if (list.count) t->visit(t, path, field, within);
      sbfi_set_list((void *)(uintptr_t)path->object, field, list.at, list.count);
      break;
    }
    default:
      flip_byte(t, at, path, field, within);
    }
  }
}

static void expect_difference(
    tour *t, const sbfi_element_path *location, const sbfi_field *field, bool in_volatile) {
  char path[256], expected[256];
  bool equal = sbf_asset_equal(t->original, t->asset, path, sizeof path);
  sbfi_element_path_print(location, field, expected, sizeof expected);
  ck_assert_msg(equal == in_volatile, "%s: %s", expected, equal ? "not seen" : "seen, though volatile");
  if (!equal && field->type != SBFI_ENUM) /* an enum may name the element: then both paths are right */
    ck_assert_msg(strncmp(path, expected, strlen(expected)) == 0, "%s, not %s", path, expected);
  t->visits++;
}

START_TEST(test_every_difference_is_found_and_named)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 3}), *same = fill_asset(&(fill_options){.seed = 3});
  char path[64] = "?";
  ck_assert(sbf_asset_equal(asset, same, path, sizeof path));
  ck_assert_str_eq(path, "");
  tour t = {asset, expect_difference, same, 0};
  sbfi_element_path root = sbfi_element_path_root(asset);
  visit_fields(&t, &root, false);
  ck_assert_uint_gt(t.visits, 500);
  ck_assert(sbf_asset_equal(asset, same, NULL, 0));
  sbf_asset_free(asset);
  sbf_asset_free(same);
}
END_TEST

START_TEST(test_item_of_a_list_is_named)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 3}), *same = fill_asset(&(fill_options){.seed = 3});
  char path[256];
  ((float *)(uintptr_t)asset->soft_bodies.at[1].surface.positions.at)[3 * 5 + 1] += 1;
  ck_assert(!sbf_asset_equal(asset, same, path, sizeof path));
  ck_assert_str_eq(path, "/sbf/soft_body[2]/polygon_mesh/positions item 5");
  sbf_asset_free(asset);
  sbf_asset_free(same);
}
END_TEST

START_TEST(test_signs_of_zero_differ)
{
  sbf_asset *a = sbf_asset_create(NULL), *b = sbf_asset_create(NULL);
  a->environment.wind.x = -0.0f;
  ck_assert(!sbf_asset_equal(a, b, NULL, 0));
  sbf_asset_free(a);
  sbf_asset_free(b);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("compare");
  TCase *tests = tcase_create("compare");
  tcase_add_test(tests, test_every_difference_is_found_and_named);
  tcase_add_test(tests, test_item_of_a_list_is_named);
  tcase_add_test(tests, test_signs_of_zero_differ);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
