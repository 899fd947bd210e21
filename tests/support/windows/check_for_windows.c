#include "check_for_windows.h"

#include <setjmp.h>
#include <stdarg.h>

enum { MAX_TESTS = 128, MAX_CASES = 32 };

struct TCase {
  const char *name;
  struct {
    TFun run;
    const char *name;
    int first, end;
  } tests[MAX_TESTS];
  int count;
  SFun setup, teardown, setup_once, teardown_once;
};

struct Suite {
  const char *name;
  TCase *cases[MAX_CASES];
  int count;
};

struct SRunner {
  Suite *suite;
  int run, failed;
};

static jmp_buf end_of_test;

static void *made(size_t size) {
  void *memory = calloc(1, size);
  if (!memory) abort();
  return memory;
}

Suite *suite_create(const char *name) {
  Suite *suite = made(sizeof *suite);
  suite->name = name;
  return suite;
}

TCase *tcase_create(const char *name) {
  TCase *tcase = made(sizeof *tcase);
  tcase->name = name;
  return tcase;
}

void suite_add_tcase(Suite *suite, TCase *tcase) {
  if (suite->count == MAX_CASES) abort();
  suite->cases[suite->count++] = tcase;
}

void check_add(TCase *tcase, TFun test, const char *name, int first, int end) {
  if (tcase->count == MAX_TESTS) abort();
  int at = tcase->count++;
  tcase->tests[at].run = test;
  tcase->tests[at].name = name;
  tcase->tests[at].first = first;
  tcase->tests[at].end = end;
}

void tcase_add_checked_fixture(TCase *tcase, SFun setup, SFun teardown) {
  tcase->setup = setup;
  tcase->teardown = teardown;
}

void tcase_add_unchecked_fixture(TCase *tcase, SFun setup, SFun teardown) {
  tcase->setup_once = setup;
  tcase->teardown_once = teardown;
}

void tcase_set_timeout(TCase *tcase, double seconds) {
  (void)tcase;
  (void)seconds;
}

SRunner *srunner_create(Suite *suite) {
  SRunner *runner = made(sizeof *runner);
  runner->suite = suite;
  return runner;
}

void check_fail(const char *file, int line, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  printf("%s:%d: ", file, line);
  vprintf(format, arguments);
  printf("\n");
  va_end(arguments);
  longjmp(end_of_test, 1);
}

static void run_case(SRunner *runner, const TCase *tcase) {
  if (tcase->setup_once) tcase->setup_once();
  for (int t = 0; t < tcase->count; t++)
    for (volatile int i = tcase->tests[t].first; i < tcase->tests[t].end; i++) {
      runner->run++;
      if (setjmp(end_of_test) == 0) {
        if (tcase->setup) tcase->setup();
        tcase->tests[t].run(i);
        if (tcase->teardown) tcase->teardown();
      } else {
        printf("failed: %s, %s, %s:%d\n", runner->suite->name, tcase->name, tcase->tests[t].name, i);
        runner->failed++;
      }
      fflush(stdout);
    }
  if (tcase->teardown_once) tcase->teardown_once();
}

void srunner_run_all(SRunner *runner, int how) {
  (void)how;
  for (int i = 0; i < runner->suite->count; i++) run_case(runner, runner->suite->cases[i]);
  printf("%s: %d checks, %d failed\n", runner->suite->name, runner->run, runner->failed);
}

int srunner_ntests_run(SRunner *runner) {
  return runner->run;
}

int srunner_ntests_failed(SRunner *runner) {
  return runner->failed;
}

void srunner_free(SRunner *runner) {
  for (int i = 0; i < runner->suite->count; i++) free(runner->suite->cases[i]);
  free(runner->suite);
  free(runner);
}
