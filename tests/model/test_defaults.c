#include "model/defaults.h"

#include "fill_asset.h"
#include "harness.h"

static bool is_default(const sbf_asset *asset, const char *name) {
  sbfi_element_path root = sbfi_element_path_root(asset);
  return sbfi_field_is_default(&root, sbfi_element_field(root.element, name));
}

START_TEST(test_fresh_assets_are_at_their_defaults)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  sbfi_element_path root = sbfi_element_path_root(asset);
  for (uint32_t i = 0; i < root.element->field_count; i++)
    ck_assert_msg(sbfi_field_is_default(&root, &root.element->fields[i]), "%s", root.element->fields[i].name);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_filled_assets_are_not)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 1});
  sbfi_element_path root = sbfi_element_path_root(asset);
  for (uint32_t i = 1; i < root.element->field_count; i++) /* the version has no other value */
    ck_assert_msg(
        !sbfi_field_is_default(&root, &root.element->fields[i]), "%s", root.element->fields[i].name);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_bits_decide)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  asset->environment.wind.x = -0.0f;
  ck_assert(!is_default(asset, "environment"));
  asset->environment.wind.x = 0;
  ck_assert(is_default(asset, "environment"));
  asset->environment.gravity.y = -9.809999f;
  ck_assert(!is_default(asset, "environment"));
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_fixed_values_count_as_defaults)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_soft_body body;
  sbf_soft_body_init(&body);
  asset->soft_bodies = (sbf_soft_body_list){&body, 1};
  sbfi_element_path root = sbfi_element_path_root(asset);
  sbfi_element_path path = sbfi_element_path_child(&root, sbfi_element_field(root.element, "soft_bodies"), 0);
  const sbfi_field *surface = sbfi_element_field(path.element, "surface");
  ck_assert_int_eq(body.surface.target, SBF_MESH_TARGET_SURFACE);
  ck_assert(sbfi_field_is_default(&path, surface));
  body.surface.target = SBF_MESH_TARGET_RENDERING; /* the schema's first word, and wrong here */
  ck_assert(!sbfi_field_is_default(&path, surface));
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("defaults");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_fresh_assets_are_at_their_defaults);
  tcase_add_test(all, test_filled_assets_are_not);
  tcase_add_test(all, test_bits_decide);
  tcase_add_test(all, test_fixed_values_count_as_defaults);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
