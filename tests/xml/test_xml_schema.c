#include "xml/xml_schema.h"

#include <libxml/xmlschemas.h>
#include <string.h>

#include "fill_asset.h"
#include "xml_samples.h"

static const sbfi_field *child(const sbfi_element *element, const char *name) {
  return sbfi_element_field(element, name);
}

START_TEST(test_elements)
{
  const sbfi_element *asset = &sbfi_asset_element;
  const sbfi_element *body = child(asset, "soft_bodies")->element;
  ck_assert_ptr_eq(sbfi_xml_find_element(asset, "skeleton"), child(asset, "bones"));
  ck_assert_ptr_eq(sbfi_xml_find_element(asset, "asset"), child(asset, "info"));
  ck_assert_ptr_null(sbfi_xml_find_element(asset, "bone")); /* only inside its wrapper */
  ck_assert_ptr_null(sbfi_xml_find_element(asset, "bones"));
  ck_assert_ptr_null(sbfi_xml_find_element(asset, "version")); /* an attribute */
  ck_assert_ptr_eq(sbfi_xml_find_element(body, "polygon_mesh"), child(body, "surface"));
  ck_assert_ptr_eq(sbfi_xml_find_element(body, "interior"), child(body, "interior"));
}
END_TEST

START_TEST(test_children)
{
  int32_t value;
  const sbfi_field *joints = child(&sbfi_asset_element, "joints");
  ck_assert(sbfi_xml_is_child(joints, "revolute_joint", &value));
  ck_assert_int_eq(value, SBF_JOINT_KIND_REVOLUTE);
  ck_assert(!sbfi_xml_is_child(joints, "joint", &value));
  ck_assert(!sbfi_xml_is_child(joints, "_joint", &value));
  ck_assert(!sbfi_xml_is_child(joints, "revolute", &value));
  ck_assert(sbfi_xml_is_child(child(&sbfi_asset_element, "bones"), "bone", &value));
  ck_assert_int_eq(value, -1);
}
END_TEST

START_TEST(test_attributes)
{
  const sbfi_field *joints = child(&sbfi_asset_element, "joints"),
                   *bodies = child(&sbfi_asset_element, "soft_bodies");
  ck_assert_ptr_nonnull(sbfi_xml_find_attribute(joints->element, joints, "body_a"));
  ck_assert_ptr_null(sbfi_xml_find_attribute(joints->element, joints, "kind")); /* the name says it */
  ck_assert_ptr_null(sbfi_xml_find_attribute(joints->element, joints, "frame_a"));
  ck_assert_ptr_null(sbfi_xml_find_attribute(bodies->element, bodies, "interior"));
}
END_TEST

START_TEST(test_suggestions)
{
  const sbfi_field *joints = child(&sbfi_asset_element, "joints");
  ck_assert_str_eq(
      sbfi_xml_suggest_element(&sbfi_asset_element, "softbody").at, ": did you mean `soft_body`?");
  ck_assert_str_eq(sbfi_xml_suggest_child(joints, "revolut_joint").at, ": did you mean `revolute_joint`?");
  ck_assert_str_eq(
      sbfi_xml_suggest_attribute(joints->element, joints, "body_c").at, ": did you mean `body_a`?");
  ck_assert_str_eq(sbfi_xml_suggest_attribute(joints->element, joints, "kind").at, "");
  ck_assert_str_eq(
      sbfi_xml_words_of(child(child(&sbfi_asset_element, "chains")->element, "kind")).at, "lag, distance");
}
END_TEST

/* --- the XML Schema, which is generated, against files that are written --- */

static xmlSchemaPtr schema;

static void expect_schema_accepts(const char *path) {
  xmlDocPtr document = xmlReadFile(path, NULL, 0);
  xmlSchemaValidCtxtPtr context = xmlSchemaNewValidCtxt(schema);
  ck_assert_msg(
      document && xmlSchemaValidateDoc(context, document) == 0, "%s does not follow spec/sbf.xsd", path);
  xmlSchemaFreeValidCtxt(context);
  xmlFreeDoc(document);
}

START_TEST(test_written_files_follow_the_xml_schema)
{
  xmlSchemaParserCtxtPtr parser = xmlSchemaNewParserCtxt(harness_source("spec/sbf.xsd"));
  schema = xmlSchemaParse(parser);
  xmlSchemaFreeParserCtxt(parser);
  ck_assert_ptr_nonnull(schema);
  for (uint64_t seed = 0; seed < 3; seed++) {
    sbf_asset *asset = fill_asset(&(fill_options){.seed = seed});
    const char *path = harness_scratch("filled.sbf");
    ck_assert_int_eq(sbf_xml_save_file(asset, path, NULL, NULL), SBF_OK);
    expect_schema_accepts(path);
    sbf_asset_free(asset);
  }
  samples_each("spec/samples/valid", ".sbf", expect_schema_accepts);
  xmlSchemaFree(schema);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("xml_schema");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_elements);
  tcase_add_test(all, test_children);
  tcase_add_test(all, test_attributes);
  tcase_add_test(all, test_suggestions);
  tcase_add_test(all, test_written_files_follow_the_xml_schema);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
