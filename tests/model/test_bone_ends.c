#include "model/bone_ends.h"

#include <string.h>

#include "harness.h"

START_TEST(names_of_ends)
{
  static const char *const ends[] = {
      "Head_end", "hand_End", "toe.end", "Bip01 R Toe0Nub", "EndSite", "EndSite_Head", "End Site"};
  static const char *const others[] = {
      "", "end", "Bend", "tail_ending", "Nubian", "_end", "Site", "blend.L", "Head_end.001x"};
  for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
    ck_assert_msg(sbfi_name_is_end(ends[i], strlen(ends[i])), "%s", ends[i]);
  for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    ck_assert_msg(!sbfi_name_is_end(others[i], strlen(others[i])), "%s", others[i]);
  ck_assert(!sbfi_name_is_end("Head_end", 4)); /* no more than the length says */
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("bone_ends");
  TCase *c = tcase_create("bone_ends");
  tcase_add_test(c, names_of_ends);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
