#include "base/suggest.h"

#include "harness.h"

static const char *closest(const char *word) {
  static const char *const known[] = {
      "positions", "polygon_sizes", "polygon_points", "interior", "id", "name"};
  sbfi_suggestion suggestion = sbfi_suggestion_for(sbfi_span_of(word));
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) sbfi_suggestion_consider(&suggestion, known[i]);
  return suggestion.best ? suggestion.best : "";
}

START_TEST(test_close_words)
{
  ck_assert_str_eq(closest("position"), "positions");
  ck_assert_str_eq(closest("psoitions"), "positions"); /* two neighbours swapped */
  ck_assert_str_eq(closest("Positions"), "positions");
  ck_assert_str_eq(closest("polygonpoints"), "polygon_points");
  ck_assert_str_eq(closest("nme"), "name");
  ck_assert_str_eq(closest("ID"), "");
  ck_assert_str_eq(closest("di"), "id"); /* one swap, not two replacements */
  ck_assert_str_eq(closest("Id"), "id");
}
END_TEST

START_TEST(test_no_close_word)
{
  ck_assert_str_eq(closest("skeleton"), "");
  ck_assert_str_eq(closest(""), "");
  ck_assert_str_eq(closest("x"), "");
  ck_assert_str_eq(closest("positionspositionspositionspositionspositionspositions"), "");
}
END_TEST

START_TEST(test_text)
{
  sbfi_suggestion suggestion = sbfi_suggestion_for(sbfi_span_of("nmae"));
  ck_assert_str_eq(sbfi_suggestion_text_of(&suggestion).at, "");
  sbfi_suggestion_consider(&suggestion, "name");
  ck_assert_str_eq(sbfi_suggestion_text_of(&suggestion).at, ": did you mean `name`?");
}
END_TEST

int main(void) {
  Suite *suite = suite_create("suggest");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_close_words);
  tcase_add_test(all, test_no_close_word);
  tcase_add_test(all, test_text);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
