#define _POSIX_C_SOURCE 200809L
#include "process_memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "measuring.h"

enum { MAX_ARGUMENTS = 8 };
static const char mark[] = "--measure-memory";

/* A line of /proc/self/status, in bytes. */
static size_t status_of(const char *name) {
  char line[256];
  size_t kib = 0;
  FILE *file = fopen("/proc/self/status", "r");
  if (!file) bench_fail("/proc/self/status cannot be read: memory is measured on Linux alone");
  while (fgets(line, sizeof line, file))
    if (strncmp(line, name, strlen(name)) == 0 && line[strlen(name)] == ':')
      kib = strtoul(line + strlen(name) + 1, NULL, 10);
  fclose(file);
  return kib * 1024;
}

/* Resets the peak. Without permission to do so, the present peak is taken as the initial one. */
static void reset_peak(void) {
  FILE *file = fopen("/proc/self/clear_refs", "w");
  if (!file) return;
  fputs("5", file);
  fclose(file);
}

static size_t above(size_t now, size_t before) {
  return now > before ? now - before : 0;
}

void process_memory_work(int argument_count, char **arguments, void (*work)(char **arguments)) {
  if (argument_count < 2 || strcmp(arguments[1], mark) != 0) return;
  reset_peak();
  size_t before = status_of("VmRSS"), before_private = status_of("RssAnon");
  work(arguments + 2);
  printf("%zu %zu\n", above(status_of("VmHWM"), before), above(status_of("RssAnon"), before_private));
  fflush(stdout);
  _exit(0);
}

static void run_self(const char *const *arguments, int out) {
  const char *all[MAX_ARGUMENTS + 3] = {"bench", mark};
  for (int i = 0; i < MAX_ARGUMENTS && arguments[i]; i++) all[i + 2] = arguments[i];
  if (dup2(out, STDOUT_FILENO) >= 0) execv("/proc/self/exe", (char *const *)(uintptr_t)all);
  _exit(127);
}

process_memory process_memory_of(const char *const *arguments) {
  int ends[2], status = 0;
  fflush(stdout);
  if (pipe(ends)) bench_fail("no pipe to a child");
  pid_t child = fork();
  if (child < 0) bench_fail("no child to measure in");
  if (child == 0) run_self(arguments, ends[1]);
  close(ends[1]);
  process_memory measured;
  FILE *in = fdopen(ends[0], "r");
  bool good = in && fscanf(in, "%zu %zu", &measured.peak_bytes, &measured.private_bytes) == 2;
  if (in) fclose(in);
  if (waitpid(child, &status, 0) != child || status != 0 || !good)
    bench_fail("the child that measures the memory of '%s' failed", arguments[0]);
  return measured;
}
