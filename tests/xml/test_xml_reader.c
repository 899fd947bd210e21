/* Several findings at once, their lines, and references. */
#include "xml/xml_reader.h"

#include <stdio.h>
#include <string.h>

#include "model/options.h"
#include "xml_samples.h"

enum { ROOM = 8 };

typedef struct outcome {
  sbf_diagnostic at[ROOM];
  sbfi_xml_findings findings;
  sbf_status status;
} outcome;

static void read_all(outcome *o, const char *text, uint32_t capacity) {
  const sbfi_xml_source source = {.bytes = text, .size = strlen(text)};
  sbf_load_options options = sbfi_load_options_of(NULL);
  sbf_asset *asset;
  o->findings = (sbfi_xml_findings){o->at, capacity, 0};
  o->status = sbfi_xml_read(&source, &options, &o->findings, &asset);
  ck_assert_int_eq(o->status == SBF_OK, asset != NULL);
  ck_assert_int_eq(o->status == SBF_OK, o->findings.count == 0);
  sbf_asset_free(asset);
}

static void expect(
    const outcome *o, uint32_t i, sbf_code code, uint32_t line, const char *path, int64_t index) {
  ck_assert_uint_lt(i, o->findings.count);
  ck_assert_msg(o->at[i].code == (int32_t)code, "%d: %s", o->at[i].code, o->at[i].message);
  ck_assert_str_eq(o->at[i].path, path);
  ck_assert_uint_eq(o->at[i].line, line);
  ck_assert_int_eq(o->at[i].index, index);
}

static const char faulty[] = "<sbf version=\"1.0\">\n"
                             "<skeleton>\n"
                             "<bone id=\"a\" head=\"0 0 0\"/>\n"
                             "<bone id=\"a\" head=\"0 0 0\" length=\"-1\"/>\n"
                             "</skeleton>\n"
                             "<soft_body id=\"b\">\n"
                             "<level>\n"
                             "<positions>0 0 0 1 0 0</positions>\n"
                             "<spring_set kind=\"shear\"><ends>0 1</ends></spring_set>\n"
                             "<spring_set kind=\"shear\">\n"
                             "<ends>\n"
                             "0 1 1 0\n"
                             "0 1\n"
                             "1 9\n"
                             "</ends>\n"
                             "</spring_set>\n"
                             "</level>\n"
                             "</soft_body>\n"
                             "<soft_body id=\"c\">\n"
                             "<attributes density=\"0\"/>\n"
                             "</soft_body>\n"
                             "</sbf>\n";

START_TEST(test_all_findings_have_their_lines)
{
  outcome o;
  read_all(&o, faulty, ROOM);
  ck_assert_int_eq(o.status, SBF_BAD_INPUT);
  ck_assert_uint_eq(o.findings.count, 4);
  expect(&o, 0, SBF_CODE_ID_REPEATED, 4, "/sbf/skeleton/bone[2]/@id", -1);
  expect(&o, 1, SBF_CODE_VALUE_OUT_OF_RANGE, 4, "/sbf/skeleton/bone[2]/@length", -1);
  expect(&o, 2, SBF_CODE_INDEX_OUT_OF_RANGE, 14, "/sbf/soft_body[1]/level[1]/spring_set[2]/ends", 3);
  expect(&o, 3, SBF_CODE_VALUE_OUT_OF_RANGE, 20, "/sbf/soft_body[2]/attributes/@density", -1);
  read_all(&o, faulty, 3); /* no room for more */
  ck_assert_uint_eq(o.findings.count, 3);
  expect(&o, 2, SBF_CODE_INDEX_OUT_OF_RANGE, 14, "/sbf/soft_body[1]/level[1]/spring_set[2]/ends", 3);
}
END_TEST

START_TEST(test_all_unknown_references)
{
  outcome o;
  read_all(&o,
      "<sbf version=\"1.0\">\n"
      "<soft_body id=\"a\" bone=\"x\"/>\n"
      "<cross_springs body_a=\"a\" body_b=\"b\"/>\n"
      "<cross_springs body_a=\"c\" body_b=\"a\"/>\n"
      "</sbf>\n",
      ROOM);
  ck_assert_uint_eq(o.findings.count, 3);
  expect(&o, 0, SBF_CODE_REF_UNKNOWN, 2, "/sbf/soft_body[1]/@bone", -1);
  expect(&o, 1, SBF_CODE_REF_UNKNOWN, 3, "/sbf/cross_springs[1]/@body_b", -1);
  expect(&o, 2, SBF_CODE_REF_UNKNOWN, 4, "/sbf/cross_springs[2]/@body_a", -1);
}
END_TEST

/* The second "a" was meant to be "b". */
START_TEST(test_repeated_ids_stand_before_the_references_they_break)
{
  static const char text[] = "<sbf version=\"1.0\">\n"
                             "<skeleton>\n"
                             "<bone id=\"a\" head=\"0 0 0\"/>\n"
                             "<bone id=\"a\" head=\"0 1 0\"/>\n"
                             "<bone id=\"c\" head=\"0 2 0\" parent=\"b\" length=\"-1\"/>\n"
                             "</skeleton>\n"
                             "<soft_body id=\"c\" bone=\"b\"/>\n"
                             "</sbf>\n";
  outcome o;
  read_all(&o, text, ROOM);
  ck_assert_uint_eq(o.findings.count, 4);
  expect(&o, 0, SBF_CODE_ID_REPEATED, 4, "/sbf/skeleton/bone[2]/@id", -1);
  expect(&o, 1, SBF_CODE_ID_REPEATED, 7, "/sbf/soft_body[1]/@id", -1);
  expect(&o, 2, SBF_CODE_REF_UNKNOWN, 5, "/sbf/skeleton/bone[3]/@parent", -1);
  expect(&o, 3, SBF_CODE_REF_UNKNOWN, 7, "/sbf/soft_body[1]/@bone", -1);
  read_all(&o, text, 1);
  ck_assert_uint_eq(o.findings.count, 1);
  expect(&o, 0, SBF_CODE_ID_REPEATED, 4, "/sbf/skeleton/bone[2]/@id", -1);
}
END_TEST

START_TEST(test_siblings_of_several_names)
{
  outcome o;
  read_all(&o,
      "<sbf version=\"1.0\">\n"
      "<rigid_bodies><rigid_body id=\"r\"/></rigid_bodies>\n"
      "<joints>\n"
      "<fixed_joint id=\"1\" body_b=\"r\"/>\n"
      "<revolute_joint id=\"2\" body_b=\"r\" break_force=\"-1\"/>\n"
      "<fixed_joint id=\"3\" body_b=\"r\" break_force=\"-1\"/>\n"
      "</joints>\n"
      "</sbf>\n",
      ROOM);
  ck_assert_uint_eq(o.findings.count, 2);
  expect(&o, 0, SBF_CODE_VALUE_OUT_OF_RANGE, 5, "/sbf/joints/revolute_joint[1]/@break_force", -1);
  expect(&o, 1, SBF_CODE_VALUE_OUT_OF_RANGE, 6, "/sbf/joints/fixed_joint[2]/@break_force", -1);
  /* the reader numbers them in the same way */
  samples_expect("<sbf version=\"1.0\">\n"
                 "<rigid_bodies><rigid_body id=\"r\"/></rigid_bodies>\n"
                 "<joints>\n"
                 "<fixed_joint id=\"1\" body_b=\"r\"/>\n"
                 "<revolute_joint id=\"2\" body_b=\"r\"/>\n"
                 "<fixed_joint id=\"3\" body_b=\"r\"><frame_a position=\"x\"/></fixed_joint>\n"
                 "</joints>\n"
                 "</sbf>\n",
      SBF_CODE_XML_BAD_VALUE, 6, "/sbf/joints/fixed_joint[2]/frame_a/@position", -1);
}
END_TEST

START_TEST(test_a_word_in_a_long_list)
{
  static char text[300000];
  int length = snprintf(text, sizeof text, "<sbf version=\"1.0\"><soft_body id=\"a\"><interior>\n");
  for (int i = 0; i < 9000; i++)
    length += snprintf(text + length, 64, "0.25 0.5 %s\n", i == 8765 ? "nil" : "-100.125");
  snprintf(text + length, 64, "</interior></soft_body></sbf>\n");
  samples_expect(text, SBF_CODE_XML_BAD_VALUE, 8767, "/sbf/soft_body[1]/interior", 8765);
}
END_TEST

START_TEST(test_references_point_forward_and_back)
{
  sbf_diagnostic error;
  sbf_asset *asset = samples_load(samples_document("<gait id='g' body='hip'><tail chain='t'/></gait>"
                                                   "<chains><chain id='s'/><chain id='t'/></chains>"
                                                   "<skeleton><bone id='hip' head='0 0 0'/></skeleton>"),
      &error);
  ck_assert_msg(asset != NULL, "%s", error.message);
  ck_assert_int_eq(asset->gaits.at[0].body, 0);
  ck_assert_int_eq(asset->gaits.at[0].hips, SBF_NONE);
  ck_assert_int_eq(asset->gaits.at[0].tails.at[0].chain, 1);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_values)
{
  sbf_diagnostic error;
  sbf_asset *asset = samples_load(
      samples_document(
          "<environment gravity=' 1\n2\t3 ' control_tick=' .5 '/>"
          "<skeleton><bone id=' b ' head='0 0 0' inherit_scale=' 0 '/></skeleton>"
          "<soft_body id='a' bone=' b '><collision self='1' layer='4294967295' mask='0'/></soft_body>"),
      &error);
  ck_assert_msg(asset != NULL, "%s", error.message);
  ck_assert_float_eq(asset->environment.gravity.z, 3);
  ck_assert_float_eq(asset->environment.control_tick, .5f);
  ck_assert_str_eq(asset->bones.at[0].id, " b "); /* an id is what stands there, spaces and all */
  ck_assert_int_eq(asset->soft_bodies.at[0].bone, 0);
  ck_assert(!asset->bones.at[0].inherit_scale);
  ck_assert(asset->soft_bodies.at[0].collision.self);
  ck_assert_uint_eq(asset->soft_bodies.at[0].collision.layer, UINT32_MAX);
  ck_assert_uint_eq(asset->soft_bodies.at[0].collision.mask, 0);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("xml_reader");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_all_findings_have_their_lines);
  tcase_add_test(all, test_all_unknown_references);
  tcase_add_test(all, test_repeated_ids_stand_before_the_references_they_break);
  tcase_add_test(all, test_siblings_of_several_names);
  tcase_add_test(all, test_a_word_in_a_long_list);
  tcase_add_test(all, test_references_point_forward_and_back);
  tcase_add_test(all, test_values);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
