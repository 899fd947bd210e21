#define _POSIX_C_SOURCE 200809L
#include "measuring.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "sbrun/sbrun.h"

double bench_now_s(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

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

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

bench_spread bench_spread_of(double *samples, uint32_t count) {
  qsort(samples, count, sizeof *samples, compare);
  double median = (samples[(count - 1) / 2] + samples[count / 2]) / 2;
  return (bench_spread){samples[0], median, samples[count - 1]};
}

static double time_of(const bench_case *c) {
  double begin = bench_now_s();
  c->run(c->context);
  double end = bench_now_s();
  if (c->after) c->after(c->context);
  return end - begin;
}

void bench_rounds(bench_case *cases, uint32_t case_count, uint32_t rounds) {
  double *samples = bench_allocate((size_t)case_count * rounds, sizeof *samples);
  for (uint32_t i = 0; i < case_count; i++) time_of(&cases[i]);
  for (uint32_t r = 0; r < rounds; r++)
    for (uint32_t i = 0; i < case_count; i++) {
      uint32_t turn = r % 2 ? case_count - 1 - i : i;
      samples[turn * rounds + r] = time_of(&cases[turn]);
    }
  for (uint32_t i = 0; i < case_count; i++) cases[i].s = bench_spread_of(samples + i * rounds, rounds);
  free(samples);
}

/* ---- Where and when ---- */

/* A field of CSV: without what would end it. */
static void clean(char *text) {
  for (char *at = text; *at; at++)
    if (*at == ',' || *at == '"' || *at == '\n') *at = ' ';
  for (size_t end = strlen(text); end && text[end - 1] == ' ';) text[--end] = 0;
}

/* Which commit was built, with a plus where the checkout differs from it; empty outside a checkout. */
static void find_commit(char *to, int size) {
  *to = 0;
  FILE *git =
      popen("git -C '" BENCH_SOURCE_FOLDER "' describe --always --abbrev=9 --dirty=+ 2>/dev/null", "r");
  if (!git) return;
  if (!fgets(to, size, git)) *to = 0;
  pclose(git);
}

static void find_processor(char *to, size_t size) {
  char line[256];
  FILE *file = fopen("/proc/cpuinfo", "r");
  snprintf(to, size, "unknown");
  while (file && fgets(line, sizeof line, file)) {
    const char *colon = strchr(line, ':');
    if (strncmp(line, "model name", 10) != 0 || !colon) continue;
    snprintf(to, size, "%s", colon + 2);
    break;
  }
  if (file) fclose(file);
}

static const char *compiler(void) {
#ifdef __clang__
  return "clang " __clang_version__;
#elif defined __GNUC__
  return "gcc " __VERSION__;
#else
  return "unknown";
#endif
}

/* The end of every row. */
static const char *where_and_when(void) {
  static char text[512];
  if (*text) return text;
  char commit[64], processor[128], built_by[64], date[32];
  time_t now = time(NULL);
  struct tm day;
  find_commit(commit, sizeof commit);
  find_processor(processor, sizeof processor);
  snprintf(built_by, sizeof built_by, "%s", compiler());
  clean(commit), clean(processor), clean(built_by);
  strftime(date, sizeof date, "%Y-%m-%d", gmtime_r(&now, &day));
  snprintf(text, sizeof text, "%s,%s,%u,%s,%s", commit, built_by, sbr_lanes(), processor, date);
  return text;
}

void bench_print_columns(const char *columns) {
  printf("%s,commit,compiler,lanes,processor,date\n", columns);
}

void bench_print_row(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vprintf(format, arguments);
  va_end(arguments);
  printf(",%s\n", where_and_when());
  fflush(stdout);
}

bool bench_is_quick(int argument_count, char **arguments) {
  for (int i = 1; i < argument_count; i++)
    if (strcmp(arguments[i], "--quick") == 0) return true;
  return false;
}
