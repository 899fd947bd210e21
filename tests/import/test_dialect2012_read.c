#include "import/paper/dialect2012.h"

#include <stdlib.h>
#include <string.h>

#include "harness.h"

#define BODY(inside) "<model><soft_body>" inside "</soft_body></model>"
#define CORNERS                                                                                              \
  "<tetrahedron_mesh><vertices><vertex id=\"9\" x=\"0\" y=\"0\" z=\"0\"/><vertex id=\"3\" x=\"1\" y=\"0\" "  \
  "z=\"0\"/><vertex id=\"5\" x=\"0\" y=\"1\" z=\"0\"/><vertex id=\"4\" x=\"0\" y=\"0\" z=\"1\"/></vertices>"

static sbf_status read_text(const char *text, sbf_asset **asset, sbf_diagnostic *error) {
  const char *path = harness_scratch("paper.xml");
  ck_assert(harness_write(path, text, strlen(text)));
  return sbf_convert(path, NULL, asset, error);
}

static void expect_fault(const char *text, sbf_code code) {
  sbf_asset *asset;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(read_text(text, &asset, &error), SBF_BAD_INPUT);
  ck_assert_msg(error.code == (int32_t)code, "%d: %s", (int)error.code, error.message);
  ck_assert_ptr_null(asset);
}

START_TEST(numbers_of_vertices_may_be_any)
{
  sbf_asset *asset;
  sbf_diagnostic error;
  ck_assert_msg(
      read_text(BODY(CORNERS "<tetrahedra><tetrahedron><node v=\"9\"/><node v=\"3\"/><node v=\"5\"/>"
                             "<node v=\"4\"/></tetrahedron></tetrahedra></tetrahedron_mesh>"),
          &asset, &error) == SBF_OK,
      "%s", error.message);
  const sbf_level *level = &asset->soft_bodies.at[0].levels.at[0];
  ck_assert_uint_eq(level->lattice.tetrahedra.count, 1);
  for (uint32_t k = 0; k < 4; k++) ck_assert_uint_eq(level->lattice.tetrahedra.at[0].at[k], k);
  ck_assert_ptr_null(asset->soft_bodies.at[0].legacy);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(inverted_tetrahedra_are_reversed)
{
  sbf_asset *asset;
  ck_assert_int_eq(
      read_text(BODY(CORNERS "<tetrahedra><tetrahedron><node v=\"3\"/><node v=\"9\"/><node v=\"5\"/>"
                             "<node v=\"4\"/></tetrahedron></tetrahedra></tetrahedron_mesh>"),
          &asset, NULL),
      SBF_OK);
  ck_assert_uint_eq(sbf_asset_check(asset, NULL, NULL, 0), 0);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(impossible_values_are_refused)
{
  expect_fault(
      BODY(CORNERS "<tetrahedra><tetrahedron><node v=\"9\"/></tetrahedron></tetrahedra></tetrahedron_mesh>"),
      SBF_CODE_WRONG_LENGTH);
  expect_fault(BODY(CORNERS "<tetrahedra><tetrahedron><node v=\"9\"/><node v=\"3\"/><node v=\"5\"/>"
                            "<node v=\"1\"/></tetrahedron></tetrahedra></tetrahedron_mesh>"),
      SBF_CODE_IMPORT_INDEX);
  expect_fault(
      BODY("<tetrahedron_mesh><vertices><vertex id=\"1\" x=\"0\" y=\"0\"/></vertices></tetrahedron_mesh>"),
      SBF_CODE_XML_BAD_VALUE);
  expect_fault(BODY("<tetrahedron_mesh><vertices><vertex id=\"0\" x=\"0\" y=\"0\" z=\"0\"/></vertices>"
                    "</tetrahedron_mesh>"),
      SBF_CODE_XML_BAD_VALUE);
  expect_fault(BODY("<attributes><mass>heavy</mass></attributes>"), SBF_CODE_XML_BAD_VALUE);
  expect_fault(BODY("<attributes><mass>-1</mass></attributes>"), SBF_CODE_VALUE_OUT_OF_RANGE);
  expect_fault(BODY("<polygon_mesh><faces><face><node v=\"1\"/></face></faces></polygon_mesh>"),
      SBF_CODE_IMPORT_POLYGON);
  expect_fault(BODY("loose words"), SBF_CODE_XML_STRAY_TEXT);
  expect_fault(
      "<model><rigid_bodies><joints><spherical_joint r1=\"1\" r2=\"2\"/></joints></rigid_bodies></model>",
      SBF_CODE_IMPORT_EMPTY);
  expect_fault("<model><rigid_bodies><rigid_body id=\"1\"/><joints><fixed_joint r1=\"1\" r2=\"2\"/></joints>"
               "</rigid_bodies></model>",
      SBF_CODE_IMPORT_INDEX);
  expect_fault("<model><rigid_bodies><rigid_body id=\"7\"/><rigid_body id=\"7\"/></rigid_bodies></model>",
      SBF_CODE_ID_REPEATED);
  expect_fault("<model/>", SBF_CODE_IMPORT_EMPTY);
  expect_fault("<model><soft_body></model>", SBF_CODE_XML_SYNTAX);
}
END_TEST

START_TEST(unknown_elements_are_skipped)
{
  sbfi_paper_model model;
  const char text[] =
      "<model><thing><soft_body/></thing><rigid_bodies><joints><bungee_joint><limits/></bungee_joint>"
      "</joints></rigid_bodies></model>";
  const char *path = harness_scratch("passed_over.xml");
  ck_assert(harness_write(path, text, strlen(text)));
  ck_assert(sbfi_paper_supports(path));
  ck_assert_int_eq(sbfi_paper_read(&model, path, NULL, NULL), SBF_OK);
  ck_assert_uint_eq(model.ignored_count, 2);
  ck_assert_str_eq(model.ignored_name, "thing");
  ck_assert_uint_eq(model.soft_bodies.count, 0);
  ck_assert_uint_eq(model.joints.count, 0);
  sbfi_paper_free(&model);
}
END_TEST

START_TEST(another_xml_is_not_of_the_dialect)
{
  const char *path = harness_scratch("other.xml");
  ck_assert(harness_write(path, "<mesh/>", 7));
  ck_assert(!sbfi_paper_supports(path));
  ck_assert(!sbfi_paper_supports("model.sbf"));
  ck_assert(!sbfi_paper_supports("no/such/file.xml"));
}
END_TEST

START_TEST(failed_allocations_are_reported)
{
  const char *path = harness_source("spec/samples/dialect2012/bar.xml");
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    sbf_asset *asset;
    sbf_diagnostic error;
    harness_memory_init(&memory, allowed);
    sbf_status status =
        sbf_convert(path, &(sbf_convert_options){.allocator = &memory.allocator}, &asset, &error);
    if (status == SBF_OK) {
      ck_assert_uint_gt(allowed, 20);
      sbf_asset_free(asset);
    }
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) break;
    if (sbfi_paper_supports(path) && error.code == SBF_CODE_OUT_OF_MEMORY)
      ck_assert_int_eq(status, SBF_FAILED);
  }
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("dialect2012_read");
  TCase *c = tcase_create("reading");
  tcase_add_test(c, numbers_of_vertices_may_be_any);
  tcase_add_test(c, inverted_tetrahedra_are_reversed);
  tcase_add_test(c, impossible_values_are_refused);
  tcase_add_test(c, unknown_elements_are_skipped);
  tcase_add_test(c, another_xml_is_not_of_the_dialect);
  tcase_add_test(c, failed_allocations_are_reported);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
