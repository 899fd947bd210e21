/* What our tests use of Check (https://libcheck.github.io/check/), for a system that it is not packaged for:
 * tests run one after the other in the program's own process, and the first fault of one ends that test. */
#ifndef TEST_WINDOWS_CHECK_H
#define TEST_WINDOWS_CHECK_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Suite Suite;
typedef struct TCase TCase;
typedef struct SRunner SRunner;
typedef const void *check_pointer;
typedef void (*TFun)(int);
typedef void (*SFun)(void);

enum { CK_ENV };

#define START_TEST(name) static void name(int _i __attribute__((unused)))
#define END_TEST

Suite *suite_create(const char *name);
TCase *tcase_create(const char *name);
void suite_add_tcase(Suite *suite, TCase *tcase);
#define tcase_add_test(tcase, test) check_add((tcase), (test), #test, 0, 1)
#define tcase_add_loop_test(tcase, test, first, end) check_add((tcase), (test), #test, (first), (end))
void check_add(TCase *tcase, TFun test, const char *name, int first, int end);
void tcase_add_checked_fixture(TCase *tcase, SFun setup, SFun teardown);
void tcase_add_unchecked_fixture(TCase *tcase, SFun setup, SFun teardown);
void tcase_set_timeout(TCase *tcase, double seconds); /* whoever runs the program does that */

SRunner *srunner_create(Suite *suite);
void srunner_run_all(SRunner *runner, int how);
int srunner_ntests_run(SRunner *runner);
int srunner_ntests_failed(SRunner *runner);
void srunner_free(SRunner *runner);

void check_fail(const char *file, int line, const char *format, ...)
    __attribute__((noreturn, format(__gnu_printf__, 3, 4)));

#define ck_abort_msg(...) check_fail(__FILE__, __LINE__, __VA_ARGS__)
#define ck_assert_msg(good, ...) ((good) ? (void)0 : check_fail(__FILE__, __LINE__, __VA_ARGS__))
#define ck_assert(good) ck_assert_msg((good), "%s", #good)

#define CHECK_COMPARE(type, format, a, op, b)                                                                \
  do {                                                                                                       \
    type check_a = (a), check_b = (b);                                                                       \
    if (!(check_a op check_b))                                                                               \
      check_fail(__FILE__, __LINE__, "%s " #op " %s: " format " and " format, #a, #b, check_a, check_b);     \
  } while (0)

#define ck_assert_int_eq(a, b) CHECK_COMPARE(intmax_t, "%jd", a, ==, b)
#define ck_assert_int_ne(a, b) CHECK_COMPARE(intmax_t, "%jd", a, !=, b)
#define ck_assert_int_lt(a, b) CHECK_COMPARE(intmax_t, "%jd", a, <, b)
#define ck_assert_int_le(a, b) CHECK_COMPARE(intmax_t, "%jd", a, <=, b)
#define ck_assert_int_gt(a, b) CHECK_COMPARE(intmax_t, "%jd", a, >, b)
#define ck_assert_int_ge(a, b) CHECK_COMPARE(intmax_t, "%jd", a, >=, b)
#define ck_assert_uint_eq(a, b) CHECK_COMPARE(uintmax_t, "%ju", a, ==, b)
#define ck_assert_uint_ne(a, b) CHECK_COMPARE(uintmax_t, "%ju", a, !=, b)
#define ck_assert_uint_lt(a, b) CHECK_COMPARE(uintmax_t, "%ju", a, <, b)
#define ck_assert_uint_le(a, b) CHECK_COMPARE(uintmax_t, "%ju", a, <=, b)
#define ck_assert_uint_gt(a, b) CHECK_COMPARE(uintmax_t, "%ju", a, >, b)
#define ck_assert_uint_ge(a, b) CHECK_COMPARE(uintmax_t, "%ju", a, >=, b)
#define ck_assert_float_eq(a, b) CHECK_COMPARE(float, "%.9g", a, ==, b)
#define ck_assert_float_ne(a, b) CHECK_COMPARE(float, "%.9g", a, !=, b)
#define ck_assert_float_lt(a, b) CHECK_COMPARE(float, "%.9g", a, <, b)
#define ck_assert_float_le(a, b) CHECK_COMPARE(float, "%.9g", a, <=, b)
#define ck_assert_float_gt(a, b) CHECK_COMPARE(float, "%.9g", a, >, b)
#define ck_assert_float_ge(a, b) CHECK_COMPARE(float, "%.9g", a, >=, b)
#define ck_assert_double_eq(a, b) CHECK_COMPARE(double, "%.17g", a, ==, b)
#define ck_assert_double_lt(a, b) CHECK_COMPARE(double, "%.17g", a, <, b)
#define ck_assert_double_le(a, b) CHECK_COMPARE(double, "%.17g", a, <=, b)
#define ck_assert_double_gt(a, b) CHECK_COMPARE(double, "%.17g", a, >, b)
#define ck_assert_double_ge(a, b) CHECK_COMPARE(double, "%.17g", a, >=, b)
#define ck_assert_ptr_eq(a, b) CHECK_COMPARE(check_pointer, "%p", a, ==, b)
#define ck_assert_ptr_null(a) ck_assert_msg((a) == NULL, "%s is not NULL", #a)
#define ck_assert_ptr_nonnull(a) ck_assert_msg((a) != NULL, "%s is NULL", #a)

#define CHECK_NEAR(type, a, b, tolerance)                                                                    \
  do {                                                                                                       \
    type check_a = (a), check_b = (b), check_max = (tolerance);                                              \
    if (!(fabs((double)(check_a - check_b)) <= (double)check_max))                                           \
      check_fail(__FILE__, __LINE__, "%s and %s: %.17g and %.17g, farther apart than %g", #a, #b,            \
          (double)check_a, (double)check_b, (double)check_max);                                              \
  } while (0)
#define ck_assert_float_eq_tol(a, b, tolerance) CHECK_NEAR(float, a, b, tolerance)
#define ck_assert_double_eq_tol(a, b, tolerance) CHECK_NEAR(double, a, b, tolerance)

#define CHECK_TEXT(a, op, b)                                                                                 \
  do {                                                                                                       \
    const char *check_a = (a), *check_b = (b);                                                               \
    if (!(check_a && check_b && strcmp(check_a, check_b) op 0))                                              \
      check_fail(__FILE__, __LINE__, "%s " #op " %s: \"%s\" and \"%s\"", #a, #b, check_a ? check_a : "NULL", \
          check_b ? check_b : "NULL");                                                                       \
  } while (0)
#define ck_assert_str_eq(a, b) CHECK_TEXT(a, ==, b)
#define ck_assert_str_ne(a, b) CHECK_TEXT(a, !=, b)
#define ck_assert_mem_eq(a, b, size) ck_assert_msg(memcmp((a), (b), (size)) == 0, "%s and %s differ", #a, #b)
#define ck_assert_mem_ne(a, b, size)                                                                         \
  ck_assert_msg(memcmp((a), (b), (size)) != 0, "%s and %s are equal", #a, #b)

#endif
