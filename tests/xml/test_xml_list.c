#include "xml/xml_list.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"

static const sbfi_field floats = {.name = "f", .type = SBFI_LIST, .item = SBFI_ITEM_F32, .width = 3};
static const sbfi_field integers = {.name = "i", .type = SBFI_LIST, .item = SBFI_ITEM_U32, .width = 1};
static const sbfi_field bytes = {.name = "b", .type = SBFI_LIST, .item = SBFI_ITEM_U8, .width = 1};

/* Reads `text` in pieces of `piece` characters, each in a block of its own size. */
static sbfi_xml_fault read_in_pieces(
    sbfi_xml_list *list, const sbfi_field *field, const char *text, size_t piece) {
  sbfi_xml_list_begin(list, field);
  size_t length = strlen(text), index;
  for (size_t i = 0; i < length; i += piece) {
    size_t size = length - i < piece ? length - i : piece;
    char *copy = malloc(size);
    memcpy(copy, text + i, size);
    sbfi_xml_fault fault = sbfi_xml_list_add(list, copy, size, &index);
    free(copy);
    if (fault) return fault;
  }
  return sbfi_xml_list_end(list);
}

START_TEST(test_numbers_across_pieces)
{
  static const char text[] = "\n 0.5 -1.25e-3 1e10\t16777217 -0 \r\n.25 +7. 123456.789 1e-45\n";
  static const float expected[] = {0.5f, -1.25e-3f, 1e10f, 16777216, -0.0f, .25f, 7, 123456.789f, 1e-45f};
  sbfi_xml_list list;
  sbfi_xml_list_init(&list, NULL, 100);
  for (size_t piece = 1; piece <= sizeof text; piece++) {
    ck_assert_int_eq(read_in_pieces(&list, &floats, text, piece), SBFI_XML_FINE);
    ck_assert_uint_eq(list.scalars.count, 9);
    ck_assert_uint_eq(sbfi_xml_list_count(&list), 3);
    ck_assert_int_eq(memcmp(list.scalars.at, expected, sizeof expected), 0);
  }
  sbfi_xml_list_free(&list);
}
END_TEST

START_TEST(test_integers_and_bytes_across_pieces)
{
  static const uint32_t expected[] = {0, 4294967295, 17};
  sbfi_xml_list list;
  sbfi_xml_list_init(&list, NULL, 100);
  for (size_t piece = 1; piece < 20; piece++) {
    ck_assert_int_eq(read_in_pieces(&list, &integers, "0 4294967295\n17", piece), SBFI_XML_FINE);
    ck_assert_uint_eq(list.scalars.count, 3);
    ck_assert_int_eq(memcmp(list.scalars.at, expected, sizeof expected), 0);
    ck_assert_int_eq(read_in_pieces(&list, &bytes, " aGVsbG8g\n d29ybGQ= ", piece), SBFI_XML_FINE);
    ck_assert_uint_eq(list.scalars.count, 11);
    ck_assert_int_eq(memcmp(list.scalars.at, "hello world", 11), 0);
  }
  sbfi_xml_list_free(&list);
}
END_TEST

START_TEST(test_errors_are_the_same_for_any_division)
{
  static const struct {
    const sbfi_field *field;
    const char *text;
    sbfi_xml_fault fault;
    size_t count; /* scalars before it */
  } cases[] = {
      {&floats, "1 2 3x 4", SBFI_XML_MALFORMED, 2},
      {&floats, "1 2 0x10", SBFI_XML_MALFORMED, 2},
      {&floats, "1 2 3,5", SBFI_XML_MALFORMED, 2},
      {&floats, "1 2 1e", SBFI_XML_MALFORMED, 2},
      {&floats, "1 2 -", SBFI_XML_MALFORMED, 2},
      {&floats, "1 2 \xc3\xa9", SBFI_XML_MALFORMED, 2},
      {&floats, "1 nan 3", SBFI_XML_NOT_FINITE, 1},
      {&floats, "1 -Infinity 3", SBFI_XML_NOT_FINITE, 1},
      {&floats, "1 2 1.#INF", SBFI_XML_NOT_FINITE, 2},
      {&floats, "1 2 nano", SBFI_XML_MALFORMED, 2},
      {&floats, "1e39 2 3", SBFI_XML_OUT_OF_RANGE, 0},
      {&floats, "1 2 3 4", SBFI_XML_NOT_WHOLE, 4},
      {&integers, "1 -1", SBFI_XML_OUT_OF_RANGE, 1},
      {&integers, "1 4294967296", SBFI_XML_OUT_OF_RANGE, 1},
      {&integers, "1 2.5", SBFI_XML_MALFORMED, 1},
      {&integers, "1 two", SBFI_XML_MALFORMED, 1},
      {&bytes, "AAA", SBFI_XML_NOT_WHOLE, 0},
      {&bytes, "AAAA!AAA", SBFI_XML_MALFORMED, 3},
  };
  sbfi_xml_list list;
  sbfi_xml_list_init(&list, NULL, 100);
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    for (size_t piece = 1; piece < 12; piece++) {
      sbfi_xml_fault fault = read_in_pieces(&list, cases[i].field, cases[i].text, piece);
      ck_assert_msg(fault == cases[i].fault, "`%s` in pieces of %zu: %d", cases[i].text, piece, (int)fault);
      if (cases[i].field != &bytes) ck_assert_uint_eq(list.scalars.count, cases[i].count);
    }
  sbfi_xml_list_free(&list);
}
END_TEST

START_TEST(test_position_and_word_of_an_error)
{
  sbfi_xml_list list;
  size_t index;
  sbfi_xml_list_init(&list, NULL, 100);
  sbfi_xml_list_begin(&list, &floats);
  ck_assert_int_eq(sbfi_xml_list_add(&list, "1 2 zero 3 ", 11, &index), SBFI_XML_MALFORMED);
  ck_assert_uint_eq(index, 4);
  ck_assert_str_eq(list.wrong, "zero");
  sbfi_xml_list_begin(&list, &floats);
  ck_assert_int_eq(sbfi_xml_list_add(&list, "1 2 ze", 6, &index), SBFI_XML_FINE);
  ck_assert_int_eq(sbfi_xml_list_add(&list, "ro 3 ", 5, &index), SBFI_XML_MALFORMED);
  ck_assert_uint_eq(index, 0);
  ck_assert_str_eq(list.wrong, "zero");
  sbfi_xml_list_free(&list);
}
END_TEST

START_TEST(test_very_long_numbers)
{
  enum { LENGTH = 5000 };
  static char text[LENGTH + 8] = "1.5";
  sbfi_xml_list list;
  sbfi_xml_list_init(&list, NULL, 100);
  memset(text + 3, '0', LENGTH - 3);
  memcpy(text + LENGTH, "1e1 2 3", 8);
  for (size_t piece = 1; piece < 2 * LENGTH; piece = piece * 3 + 1) {
    ck_assert_int_eq(read_in_pieces(&list, &floats, text, piece), SBFI_XML_FINE);
    ck_assert_float_eq(*(const float *)list.scalars.at, 15);
  }
  sbfi_xml_list_free(&list);
}
END_TEST

START_TEST(test_limit_and_memory)
{
  sbfi_xml_list list;
  sbfi_xml_list_init(&list, NULL, 2);
  ck_assert_int_eq(read_in_pieces(&list, &floats, "1 2 3 4 5 6", 3), SBFI_XML_FINE);
  ck_assert_int_eq(read_in_pieces(&list, &floats, "1 2 3 4 5 6 7", 3), SBFI_XML_TOO_LONG);
  ck_assert_int_eq(read_in_pieces(&list, &bytes, "AAA=", 3), SBFI_XML_FINE);
  ck_assert_int_eq(read_in_pieces(&list, &bytes, "AAAA", 3), SBFI_XML_TOO_LONG);
  sbfi_xml_list_free(&list);

  harness_memory memory;
  harness_memory_init(&memory, 0);
  sbfi_xml_list_init(&list, &memory.allocator, 2);
  ck_assert_int_eq(read_in_pieces(&list, &floats, "1 2 3", 3), SBFI_XML_NO_MEMORY);
  ck_assert_int_eq(read_in_pieces(&list, &bytes, "AAAA", 3), SBFI_XML_NO_MEMORY);
  sbfi_xml_list_free(&list);
  ck_assert_uint_eq(memory.held_bytes, 0);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("xml_list");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_numbers_across_pieces);
  tcase_add_test(all, test_integers_and_bytes_across_pieces);
  tcase_add_test(all, test_errors_are_the_same_for_any_division);
  tcase_add_test(all, test_position_and_word_of_an_error);
  tcase_add_test(all, test_very_long_numbers);
  tcase_add_test(all, test_limit_and_memory);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
