#define _POSIX_C_SOURCE 200809L /* setenv */
#include "harness.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef _WIN32
#include <direct.h>
#define mkdir(path, mode) _mkdir(path)
#endif

#ifndef _WIN32
/* Time limit of one case: stops hanging cases, also on busy machines, shortly before ctest stops the program.
 */
__attribute__((constructor)) static void set_timeout(void) {
  setenv("CK_DEFAULT_TIMEOUT", "800", 0);
}
#endif

int harness_run(Suite *suite) {
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_ENV);
  int failed = srunner_ntests_failed(runner);
  printf("CASES %d\n", srunner_ntests_run(runner));
  srunner_free(runner);
  return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}

static const char *joined(const char *variable, const char *fallback, const char *middle, const char *path) {
  static char slots[4][1024];
  static int next;
  const char *root = getenv(variable);
  char *slot = slots[next++ % 4];
  snprintf(slot, sizeof slots[0], "%s%s/%s", root ? root : fallback, middle, path);
  return slot;
}

const char *harness_source(const char *path) {
  return joined("SBFMT_SOURCE_DIR", ".", "", path);
}

const char *harness_scratch(const char *name) {
  mkdir(joined("SBFMT_BUILD_DIR", "build", "", "scratch"), 0777);
  return joined("SBFMT_BUILD_DIR", "build", "/scratch", name);
}

void harness_skip_case(const char *function, const char *format, ...) {
  static bool is_reported; /* each case is a process of its own, and may lack several things */
  if (is_reported) return;
  is_reported = true;
  const char *ending = strrchr(function, '_'); /* Check appends _fn to what START_TEST names */
  int length = ending && strcmp(ending, "_fn") == 0 ? (int)(ending - function) : (int)strlen(function);
  char reason[600];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(reason, sizeof reason, format, arguments);
  va_end(arguments);
  printf("\nSKIP %.*s: %s\n", length, function, reason);
  fflush(stdout);
}

const char *harness_shared_for(const char *function, const char *path_below_data) {
  const char *path = joined("SBFMT_SOURCE_DIR", ".", "/../shared/data", path_below_data);
  FILE *file = fopen(path, "rb");
  if (!file) {
    harness_skip_case(function, "shared/data/%s is not there", path_below_data);
    return NULL;
  }
  fclose(file);
  return path;
}

char *harness_read(const char *path, size_t *size) {
  FILE *file = fopen(path, "rb");
  if (!file) return NULL;
  fseek(file, 0, SEEK_END);
  long end = ftell(file);
  rewind(file);
  /* A folder opens too, and then claims to be endless. */
  char *bytes = end >= 0 && end < LONG_MAX ? malloc((size_t)end + 1) : NULL;
  if (bytes && fread(bytes, 1, (size_t)end, file) == (size_t)end) {
    bytes[end] = 0;
    if (size) *size = (size_t)end;
  } else {
    free(bytes);
    bytes = NULL;
  }
  fclose(file);
  return bytes;
}

/* Renamed into place: tests that run at once write files of one name, and read them whole. */
bool harness_write(const char *path, const void *bytes, size_t size) {
  char fresh[4096];
  snprintf(fresh, sizeof fresh, "%s.%ld", path, (long)getpid());
  FILE *file = fopen(fresh, "wb");
  if (!file) return false;
  bool good = fwrite(bytes, 1, size, file) == size;
  good = fclose(file) == 0 && good;
#ifdef _WIN32
  remove(path); /* renaming does not replace there */
#endif
  return good && rename(fresh, path) == 0;
}

static void *counted(void *user, void *memory, size_t old_size, size_t new_size) {
  harness_memory *m = user;
  if (new_size == 0) {
    free(memory);
    m->held_bytes -= old_size;
    return NULL;
  }
  if (m->calls++ >= m->allowed) return NULL;
  void *moved = realloc(memory, new_size);
  if (moved) m->held_bytes += new_size - (memory ? old_size : 0);
  return moved;
}

void harness_memory_init(harness_memory *memory, size_t allowed) {
  *memory = (harness_memory){.allocator = {counted, memory}, .allowed = allowed};
}
