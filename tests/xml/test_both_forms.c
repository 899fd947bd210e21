/* The two forms of the format hold the same: from either to the other and back, the bytes are those of
 * before. */
#include <stdlib.h>
#include <string.h>

#include "fill_asset.h"
#include "harness.h"
#include "sbfmt/io.h"

static sbf_diagnostic error;

static void require(sbf_status status) {
  ck_assert_msg(status == SBF_OK, "%s: %s", error.path, error.message);
}

static sbf_buffer save_xml(const sbf_asset *asset) {
  sbf_buffer buffer;
  require(sbf_xml_save_memory(asset, NULL, NULL, &buffer, &error));
  return buffer;
}

static sbf_buffer save_packed(const sbf_asset *asset, bool store) {
  sbf_buffer buffer;
  require(sbf_packed_save_memory(asset, &(sbf_save_options){.store = store}, NULL, &buffer, &error));
  return buffer;
}

static void require_same(const sbf_buffer *a, const sbf_buffer *b) {
  ck_assert_uint_eq(a->size, b->size);
  ck_assert_mem_eq(a->at, b->at, a->size);
}

/* XML, packed, XML; and packed, XML, packed. */
static void go_round(const sbf_asset *asset, const sbf_load_options *options, bool store) {
  sbf_asset *from_xml, *from_packed, *from_second_xml;
  sbf_buffer xml = save_xml(asset);
  require(sbf_xml_load_memory(xml.at, xml.size, options, &from_xml, &error));
  sbf_buffer packed = save_packed(from_xml, store);
  require(sbf_packed_load_memory(packed.at, packed.size, options, &from_packed, &error));
  sbf_buffer xml_again = save_xml(from_packed);
  require_same(&xml, &xml_again);
  require(sbf_xml_load_memory(xml_again.at, xml_again.size, options, &from_second_xml, &error));
  sbf_buffer packed_again = save_packed(from_second_xml, store);
  require_same(&packed, &packed_again);
  char path[256];
  ck_assert_msg(sbf_asset_equal(asset, from_second_xml, path, sizeof path), "%s", path);
  sbf_asset *assets[] = {from_xml, from_packed, from_second_xml};
  sbf_buffer buffers[] = {xml, packed, xml_again, packed_again};
  for (int i = 0; i < 3; i++) sbf_asset_free(assets[i]);
  for (int i = 0; i < 4; i++) sbf_buffer_free(&buffers[i]);
}

START_TEST(test_filled_assets_round_trip)
{
  for (uint64_t seed = 0; seed < 8; seed++)
    for (int store = 0; store < 2; store++) {
      sbf_asset *asset = fill_asset(&(fill_options){.seed = seed, .items = seed % 2 ? 300 : 0});
      sbf_load_options options = fill_load_options(asset);
      go_round(asset, &options, store);
      sbf_asset_free(asset);
    }
}
END_TEST

START_TEST(test_an_empty_asset_round_trips)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  go_round(asset, NULL, false);
  go_round(asset, NULL, true);
  sbf_asset_free(asset);
}
END_TEST

/* An extension that nobody here knows: optional, it is kept byte for byte; required, it is refused by name.
 */
START_TEST(test_unknown_extensions)
{
  sbf_extension extension;
  sbf_extension_init(&extension);
  extension.name = "ACME_fur";
  extension.data = " { \"length\": [1, 2] } <b a='1'>&amp;</b>\n\t\r\n \xc3\xa9 ]]> ";
  sbf_asset *asset = sbf_asset_create(NULL), *none;
  asset->extensions = (sbf_extension_list){&extension, 1};
  go_round(asset, NULL, false);
  go_round(asset, NULL, true);
  extension.required = true;
  sbf_buffer forms[] = {save_xml(asset), save_packed(asset, false), save_packed(asset, true)};
  for (int i = 0; i < 3; i++) {
    const char *known[] = {"ACME_scales", "ACME_fur"};
    sbf_load_options options = {.extensions = known, .extension_count = 1};
    sbf_status (*load)(const void *, size_t, const sbf_load_options *, sbf_asset **, sbf_diagnostic *) =
        i ? sbf_packed_load_memory : sbf_xml_load_memory;
    ck_assert_int_eq(load(forms[i].at, forms[i].size, &options, &none, &error), SBF_BAD_INPUT);
    ck_assert_int_eq(error.code, SBF_CODE_EXTENSION_REQUIRED);
    ck_assert_ptr_nonnull(strstr(error.message, "`ACME_fur`"));
    ck_assert_str_eq(error.path, "/sbf/extensions/extension[1]");
    ck_assert_ptr_null(none);
    options.extension_count = 2;
    require(load(forms[i].at, forms[i].size, &options, &none, &error));
    ck_assert_str_eq(none->extensions.at[0].data, extension.data);
    sbf_asset_free(none);
    sbf_buffer_free(&forms[i]);
  }
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("both_forms");
  TCase *tests = tcase_create("both_forms");
  tcase_add_test(tests, test_filled_assets_round_trip);
  tcase_add_test(tests, test_an_empty_asset_round_trips);
  tcase_add_test(tests, test_unknown_extensions);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
