#include "xml/xml_writer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/diagnostic.h"
#include "fill_asset.h"
#include "xml_samples.h"

static char *written(const sbf_asset *asset, const sbfi_xml_selection *selection) {
  sbfi_text text;
  sbf_diagnostic error = {0};
  sbfi_text_init(&text, NULL);
  ck_assert_msg(sbfi_xml_write(asset, selection, &text, NULL, &error) == SBF_OK, "%s", error.message);
  sbfi_text_char(&text, 0);
  return text.at; /* malloc's */
}

static void expect(const char *inside, const char *canonical) {
  char expected[8192];
  sbf_diagnostic error;
  sbf_asset *asset = samples_load(samples_document(inside), &error);
  ck_assert_msg(asset != NULL, "%s", error.message);
  char *text = written(asset, NULL);
  snprintf(expected, sizeof expected,
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<sbf version=\"1.0\"%s%s%s\n", *canonical ? ">\n" : "",
      canonical, *canonical ? "</sbf>" : "/>");
  ck_assert_str_eq(text, expected);
  free(text);
  sbf_asset_free(asset);
}

START_TEST(test_defaults_are_left_out)
{
  expect("", "");
  expect(
      "<environment gravity='0 -9.81 0' wind='0 0 0'/><relaxation stiffness='.3'/><skeleton/><asset/>", "");
  expect("<soft_body id='a'><polygon_mesh target='surface'/><attributes/><collision/></soft_body>",
      "  <soft_body id=\"a\"/>\n");
  expect("<environment wind='-0 0 0'/>",
      "  <environment wind=\"-0 0 0\"/>\n"); /* other bits, so another value */
  expect("<environment control_tick='0.01666666753590106964'/>", "");
  expect("<environment control_tick='0.0166'/>", "  <environment control_tick=\"0.0166\"/>\n");
}
END_TEST

START_TEST(test_required_values_are_written)
{
  expect(
      "<rigid_bodies><rigid_body id='a'/></rigid_bodies><joints><prismatic_joint id='j' body_b='a'><limits>"
      "<limit max='0' min='0' target='linear_x'/></limits></prismatic_joint></joints>",
      "  <rigid_bodies>\n"
      "    <rigid_body id=\"a\"/>\n"
      "  </rigid_bodies>\n"
      "  <joints>\n"
      "    <prismatic_joint id=\"j\" body_b=\"a\">\n"
      "      <limits>\n"
      "        <limit target=\"linear_x\" min=\"0\" max=\"0\"/>\n"
      "      </limits>\n"
      "    </prismatic_joint>\n"
      "  </joints>\n");
}
END_TEST

START_TEST(test_order_is_the_schemas)
{
  expect("<environment/><soft_body bone='b' id='a'/><skeleton><bone head='0 0 0' id='b'/></skeleton>",
      "  <skeleton>\n"
      "    <bone id=\"b\" head=\"0 0 0\"/>\n"
      "  </skeleton>\n"
      "  <soft_body id=\"a\" bone=\"b\"/>\n");
}
END_TEST

START_TEST(test_lines_of_lists)
{
  expect("<soft_body id='a'><interior>1 2 3 4 5 6 7 8 9 10 11 12</interior></soft_body>",
      "  <soft_body id=\"a\">\n"
      "    <interior>1 2 3 4 5 6 7 8 9 10 11 12</interior>\n"
      "  </soft_body>\n");
  expect("<soft_body id='a'><interior>1 2 3 4 5 6 7 8 9 10 11 12 13 14 15</interior></soft_body>",
      "  <soft_body id=\"a\">\n"
      "    <interior>\n"
      "1 2 3 4 5 6 7 8 9 10 11 12\n"
      "13 14 15\n"
      "    </interior>\n"
      "  </soft_body>\n");
  expect("<textures><texture id='t'><bytes>"
         "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA==</bytes></"
         "texture></textures>",
      "  <textures>\n"
      "    <texture id=\"t\">\n"
      "      <bytes>\n"
      "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA\n"
      "AA==\n"
      "      </bytes>\n"
      "    </texture>\n"
      "  </textures>\n");
}
END_TEST

START_TEST(test_texts)
{
  expect("<asset title='&lt;&amp;\"&#39;> \xc3\xa9&#10;&#9;'/>",
      "  <asset title=\"&lt;&amp;&quot;'&gt; \xc3\xa9&#10;&#9;\"/>\n");
  expect("<extensions><extension name='x'><data> a\n\t\"&lt;&amp;&#13;]]&gt;</data></extension></extensions>",
      "  <extensions>\n"
      "    <extension name=\"x\">\n"
      "      <data> a\n\t\"&lt;&amp;&#13;]]&gt;</data>\n"
      "    </extension>\n"
      "  </extensions>\n");
}
END_TEST

/* --- selections --- */

static const char derived_asset[] =
    "<derivations><derivation id='d' source_hash='00'/></derivations>\n"
    "<rigid_bodies>\n"
    "  <rigid_body id='made' derived='d'/>\n"
    "  <rigid_body id='given' hull_derived='d'><polygon_mesh target='collision_detection'>\n"
    "    <positions>0 0 0</positions></polygon_mesh></rigid_body>\n"
    "</rigid_bodies>\n"
    "<soft_body id='a'>\n"
    "  <pins><pin_set derived='d'/></pins>\n"
    "  <level name='kept'><simulation><measured machine='m' microseconds='3'/></simulation></level>\n"
    "  <level name='made' derived='d'/>\n"
    "</soft_body>\n";

START_TEST(test_source_only)
{
  sbf_diagnostic error;
  sbf_asset *asset = samples_load(samples_document(derived_asset), &error);
  ck_assert_msg(asset != NULL, "%s", error.message);
  char *text = written(asset, &(sbfi_xml_selection){.source_only = true});
  ck_assert_str_eq(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                         "<sbf version=\"1.0\">\n"
                         "  <rigid_bodies>\n"
                         "    <rigid_body id=\"given\"/>\n"
                         "  </rigid_bodies>\n"
                         "  <soft_body id=\"a\">\n"
                         "    <level name=\"kept\"/>\n"
                         "  </soft_body>\n"
                         "</sbf>\n");
  free(text);
  sbf_asset_free(asset);
}
END_TEST

static bool keep_bodies(void *user, const sbfi_element_path *child) {
  (*(int *)user)++;
  return child->up->up || strcmp(child->field->name, "soft_bodies") == 0;
}

START_TEST(test_choice_of_parts)
{
  int asked = 0;
  sbf_diagnostic error;
  sbf_asset *asset = samples_load(
      samples_document("<materials><material id='m'/></materials><soft_body id='a'/><gait id='g' body='b'/>"
                       "<skeleton><bone id='b' head='0 0 0'/></skeleton>"),
      &error);
  ck_assert_msg(asset != NULL, "%s", error.message);
  char *text = written(asset, &(sbfi_xml_selection){.keep = keep_bodies, .user = &asked});
  ck_assert_str_eq(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                         "<sbf version=\"1.0\">\n"
                         "  <soft_body id=\"a\"/>\n"
                         "</sbf>\n");
  ck_assert_int_gt(asked, 3);
  free(text);
  sbf_asset_free(asset);
}
END_TEST

/* --- sinks --- */

typedef struct sunk {
  sbfi_text text;
  int writes, allowed;
} sunk;

static sbf_status sink(void *user, const void *bytes, size_t size, sbf_diagnostic *error) {
  sunk *s = user;
  if (s->writes++ == s->allowed) return sbfi_diagnose(error, SBF_CODE_IO_CANNOT_WRITE, "full");
  sbfi_text_append(&s->text, bytes, size);
  return SBF_OK;
}

START_TEST(test_sink_gets_the_same_bytes_in_pieces)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 5, .items = 4000});
  char *whole = written(asset, NULL);
  sunk s = {.allowed = -1};
  sbfi_text text;
  sbf_diagnostic error = {0};
  sbfi_text_init(&text, NULL);
  sbfi_text_init(&s.text, NULL);
  ck_assert_int_eq(sbfi_xml_write(asset, NULL, &text, &(sbfi_xml_sink){sink, &s}, &error), SBF_OK);
  sbfi_text_char(&s.text, 0);
  ck_assert_int_gt(s.writes, 5);
  ck_assert_uint_lt(text.capacity, strlen(whole) / 4); /* it was not all there at once */
  ck_assert_str_eq(s.text.at, whole);
  sbfi_text_clear(&s.text);
  sbfi_text_clear(&text);
  s.writes = 0;
  s.allowed = 2;
  ck_assert_int_eq(sbfi_xml_write(asset, NULL, &text, &(sbfi_xml_sink){sink, &s}, &error), SBF_FAILED);
  ck_assert_int_eq(s.writes, 3); /* not asked again */
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_WRITE);
  sbfi_text_free(&s.text);
  sbfi_text_free(&text);
  sbf_asset_free(asset);
  free(whole);
}
END_TEST

START_TEST(test_memory_runs_out)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 5});
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    sbfi_text text;
    sbf_diagnostic error = {0};
    harness_memory_init(&memory, allowed);
    sbfi_text_init(&text, &memory.allocator);
    sbf_status status = sbfi_xml_write(asset, NULL, &text, NULL, &error);
    sbfi_text_free(&text);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) break;
    ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    ck_assert_uint_lt(allowed, 1000);
  }
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("xml_writer");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_defaults_are_left_out);
  tcase_add_test(all, test_required_values_are_written);
  tcase_add_test(all, test_order_is_the_schemas);
  tcase_add_test(all, test_lines_of_lists);
  tcase_add_test(all, test_texts);
  tcase_add_test(all, test_source_only);
  tcase_add_test(all, test_choice_of_parts);
  tcase_add_test(all, test_sink_gets_the_same_bytes_in_pieces);
  tcase_add_test(all, test_memory_runs_out);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
