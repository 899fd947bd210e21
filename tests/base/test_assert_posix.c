/* SBF_ASSERT as debug builds have it. */
#ifndef SBFMT_ASSERTS
#define SBFMT_ASSERTS
#endif
#include "base/assert.h"

#include <signal.h>

#include "harness.h"

START_TEST(a_true_assertion_continues)
{
  int evaluated = 0;
  SBF_ASSERT(++evaluated == 1);
  ck_assert_int_eq(evaluated, 1);
}
END_TEST

START_TEST(a_false_assertion_aborts)
{ SBF_ASSERT(2 + 2 == 5); }
END_TEST

int main(void) {
  Suite *suite = suite_create("assert");
  TCase *c = tcase_create("assert");
  tcase_add_test(c, a_true_assertion_continues);
  tcase_add_test_raise_signal(c, a_false_assertion_aborts, SIGABRT);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
