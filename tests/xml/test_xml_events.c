#include "xml/xml_events.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "harness.h"

/* What the handlers were told, as text: `<name attribute=value`, `'text'`, `/`; a number is a line. */
typedef struct record {
  sbfi_text text;
  sbfi_xml_events events;
  size_t stop_after, calls;
} record;

static bool advance(record *r) {
  return ++r->calls != r->stop_after;
}

static bool on_start(void *user, const char *name, const sbfi_xml_attribute *attributes, uint32_t count) {
  record *r = user;
  sbfi_text_char(&r->text, '<');
  sbfi_text_string(&r->text, name);
  for (uint32_t i = 0; i < count; i++) {
    sbfi_text_char(&r->text, ' ');
    sbfi_text_string(&r->text, attributes[i].name);
    sbfi_text_char(&r->text, '=');
    sbfi_text_append(&r->text, attributes[i].value, attributes[i].length);
  }
  sbfi_text_char(&r->text, ':');
  sbfi_text_u32(&r->text, r->events.line);
  return advance(r);
}

static bool on_text(void *user, const char *text, size_t length) {
  record *r = user;
  sbfi_text_append(&r->text, text, length);
  return advance(r);
}

static bool on_end(void *user) {
  record *r = user;
  sbfi_text_char(&r->text, '/');
  return advance(r);
}

static sbf_status parse(
    record *r, const char *text, size_t length, size_t stop_after, sbf_diagnostic *error) {
  const sbfi_xml_source source = {.bytes = text, .size = length};
  *r = (record){.events = {on_start, on_text, on_end, r, 0}, .stop_after = stop_after};
  sbfi_text_init(&r->text, NULL);
  return sbfi_xml_parse(&source, &r->events, NULL, error);
}

static void expect_events(const char *text, const char *expected) {
  record r;
  sbf_diagnostic error = {0};
  ck_assert_msg(parse(&r, text, strlen(text), 0, &error) == SBF_OK, "%s", error.message);
  sbfi_text_char(&r.text, 0);
  ck_assert_str_eq(r.text.at, expected);
  sbfi_text_free(&r.text);
}

static void expect_error(const char *text, size_t length, sbf_code code, uint32_t line) {
  record r;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(parse(&r, text, length, 0, &error), SBF_BAD_INPUT);
  ck_assert_msg(error.code == (int32_t)code, "%d: %s", error.code, error.message);
  ck_assert_uint_eq(error.line, line);
  sbfi_text_free(&r.text);
}

START_TEST(test_events)
{
  expect_events("<a x='1' y=\"2\"><b/>text</a>", "<a x=1 y=2:1<b:1/text/");
  expect_events("<?xml version=\"1.0\"?>\n<!-- c -->\n<a>\n<b\nx=''/></a>", "<a:3\n<b x=:5//");
  expect_events("<a>1<!-- c -->2<![CDATA[<3>]]></a>", "<a:1"
                                                      "12<3>/");
  expect_events(
      "<a xml:lang=\"en\" xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xsi:type=\"t\" b=\"c\"/>",
      "<a b=c:1/");
  expect_events("<a xmlns=\"u\"><p:b xmlns:p=\"v\" p:x=\"1\"/></a>", "<{u}a:1<{v}b p=1:1//");
}
END_TEST

START_TEST(test_entities_of_xml_itself)
{
  expect_events("<a>&lt;&gt;&amp;&quot;&apos;&#65;&#x20AC;</a>", "<a:1<>&\"'A\xe2\x82\xac/");
  expect_events("<a x='&lt;&gt;&amp;&quot;&apos;&#65;&#38;&#38;#38;&amp;#38;&amp;amp;' y='&amp;' z='plain'/>",
      "<a x=<>&\"'A&&#38;&#38;&amp; y=& z=plain:1/");
  expect_events("<a x='&#9;&#10;&#13; \t\n'/>", "<a x=\t\n\r   :2/"); /* as XML 1.0 normalizes */
}
END_TEST

START_TEST(test_errors)
{
  expect_error("", 0, SBF_CODE_XML_SYNTAX, 1);
  expect_error("<a>\n<b>\n</a>", 12, SBF_CODE_XML_SYNTAX, 3);
  expect_error("<a/><b/>", 8, SBF_CODE_XML_SYNTAX, 1);
  expect_error("<a x='1' x='2'/>", 16, SBF_CODE_XML_SYNTAX, 1);
  expect_error("<a><p:b/></a>", 13, SBF_CODE_XML_SYNTAX, 1); /* an unbound prefix */
  expect_error("<a>\n&nbsp;</a>", 14, SBF_CODE_XML_DOCTYPE, 2);
  expect_error("<!DOCTYPE a><a/>", 16, SBF_CODE_XML_DOCTYPE, 1);
  expect_error("<!DOCTYPE a [<!ENTITY e 'x'>]><a>&e;</a>", 40, SBF_CODE_XML_DOCTYPE, 1);
  expect_error("<a>\n\xff</a>", 9, SBF_CODE_NOT_UTF8, 2);
  expect_error("<a>\n\x01</a>", 9, SBF_CODE_XML_SYNTAX, 2);
  expect_error("<a>\n\0</a>", 9, SBF_CODE_XML_SYNTAX, 2);
  expect_error("\xff\xfe<\0a\0/\0>\0", 10, SBF_CODE_XML_SYNTAX, 1);
  expect_error("<?xml version='1.0' encoding='latin1'?><a/>", 43, SBF_CODE_XML_SYNTAX, 1);
  expect_error("<?xml version='1.0' encoding = \"UTF-7\"?><a/>", 44, SBF_CODE_XML_SYNTAX, 1);
}
END_TEST

static int write_attributes(char *text, int count) {
  int length = sprintf(text, "<a><!-- it's --><b x0='>'");
  for (int i = 1; i < count; i++) length += sprintf(text + length, " x%d = \n\"='>'\"", i);
  return length + sprintf(text + length, "/></a>");
}

/* Where every attribute is compared with every other, a file of nothing else would take minutes. */
START_TEST(test_many_attributes)
{
  static char text[1 << 22];
  record r;
  sbf_diagnostic error = {0};
  int length = write_attributes(text, 256);
  ck_assert_msg(parse(&r, text, (size_t)length, 0, &error) == SBF_OK, "%s", error.message);
  sbfi_text_free(&r.text);
  length = write_attributes(text, 100000);
  ck_assert_int_eq(parse(&r, text, (size_t)length, 0, &error), SBF_BAD_INPUT);
  ck_assert_ptr_nonnull(strstr(error.message, "attributes"));
  sbfi_text_free(&r.text);
  /* quotes in texts are none of them */
  length = sprintf(text, "<a><!-- don't -->");
  for (int i = 0; i < 100000; i++) length += sprintf(text + length, "\"x\": '%d',", i);
  length += sprintf(text + length, "<![CDATA[");
  for (int i = 0; i < 1000; i++) length += sprintf(text + length, "\"x\": '%d',", i);
  length += sprintf(text + length, "]]></a>");
  ck_assert_msg(parse(&r, text, (size_t)length, 0, &error) == SBF_OK, "%s", error.message);
  sbfi_text_free(&r.text);
}
END_TEST

START_TEST(test_handlers_may_stop)
{
  static const char text[] = "<a>x<b/>y</a>";
  for (size_t stop_after = 1; stop_after <= 6; stop_after++) {
    record r;
    sbf_diagnostic error = {0};
    ck_assert_int_eq(parse(&r, text, sizeof text - 1, stop_after, &error), SBF_OK);
    ck_assert_uint_eq(r.calls, stop_after);
    sbfi_text_free(&r.text);
  }
}
END_TEST

START_TEST(test_files)
{
  static const char text[] = "<a>from a file</a>";
  const char *path = harness_scratch("events.xml");
  ck_assert(harness_write(path, text, sizeof text - 1));
  sbfi_file file;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(sbfi_file_open(path, &file, &error), SBF_OK);
  sbfi_xml_source source = {.file = &file, .size = file.size};
  for (int i = 0; i < 2; i++) { /* as often as one likes */
    record r = {.events = {on_start, on_text, on_end, &r, 0}};
    sbfi_text_init(&r.text, NULL);
    ck_assert_int_eq(sbfi_xml_parse(&source, &r.events, NULL, &error), SBF_OK);
    sbfi_text_char(&r.text, 0);
    ck_assert_str_eq(r.text.at, "<a:1from a file/");
    sbfi_text_free(&r.text);
  }
  source.size += 10; /* as if it had been cut short meanwhile */
  record r = {.events = {on_start, on_text, on_end, &r, 0}};
  sbfi_text_init(&r.text, NULL);
  ck_assert_int_eq(sbfi_xml_parse(&source, &r.events, NULL, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IO_CANNOT_READ);
  sbfi_text_free(&r.text);
  sbfi_file_close(&file);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("xml_events");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_events);
  tcase_add_test(all, test_entities_of_xml_itself);
  tcase_add_test(all, test_errors);
  tcase_add_test(all, test_many_attributes);
  tcase_add_test(all, test_handlers_may_stop);
  tcase_add_test(all, test_files);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
