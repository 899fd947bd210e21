#include "measuring.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chart/machine.h"

void bench_fail(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  fputs("bench: ", stderr);
  vfprintf(stderr, format, arguments);
  fputc('\n', stderr);
  va_end(arguments);
  exit(2);
}

void bench_require(sbf_status status, const sbf_diagnostic *error) {
  if (status != SBF_OK) bench_fail("%s: %s", error->file, error->message);
}

void *bench_allocate(size_t count, size_t size) {
  void *memory = calloc(count ? count : 1, size);
  if (!memory) bench_fail("memory ran out");
  return memory;
}

void bench_rounds(bench_case *cases, uint32_t case_count, uint32_t rounds) {
  if (!chart_time_in_turns(cases, case_count, rounds, NULL, NULL)) bench_fail("memory ran out");
}

/* ---- Where and when ---- */

void bench_print_columns(const char *columns) {
  printf("%s,%s\n", columns, CHART_MACHINE_COLUMNS);
}

void bench_print_row(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vprintf(format, arguments);
  va_end(arguments);
  static chart_machine machine;
  if (!machine.lanes) machine = chart_this_machine();
  putchar(',');
  chart_machine_write(stdout, &machine);
  putchar('\n');
  fflush(stdout);
}

/* ---- How often ---- */

static bool once;

bool bench_is_quick(int argument_count, char **arguments) {
  bool quick = false;
  for (int i = 1; i < argument_count; i++) {
    quick |= strcmp(arguments[i], "--quick") == 0;
    once |= strcmp(arguments[i], "--once") == 0;
  }
  once |= quick;
  return quick;
}

bool bench_runs_once(void) {
  return once;
}

uint32_t bench_round_count(uint32_t rounds) {
  return once ? 1 : rounds;
}
