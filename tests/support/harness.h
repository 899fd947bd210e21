/* What every test program needs: a main, the shared data folder, an allocator that fails on demand. */
#ifndef TEST_HARNESS_H
#define TEST_HARNESS_H

#include <check.h>

#include "sbfmt/base.h"

/* Runs the suite and gives the exit status: `int main(void) { return harness_run(my_suite()); }` */
int harness_run(Suite *suite);

/* Sanitizers make a program ten times as slow, and find in a few of many similar cases what they find in all:
 * `few` where they are on, else `all`. */
#ifdef HARNESS_SANITIZED
#define HARNESS_FEW(all, few) (few)
#else
#define HARNESS_FEW(all, few) (all)
#endif

/* Prints "SKIP case: reason", which tests/report.py counts, once per case; the test then returns. Takes a
 * printf format. */
#define harness_skip(...) harness_skip_case(__func__, __VA_ARGS__)
void harness_skip_case(const char *function, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Path of a file below the folder of real input that may lie beside the checkout. NULL where it is absent:
 * the case is then skipped, and the test returns. Valid until the next call. */
#define harness_shared(path_below_data) harness_shared_for(__func__, (path_below_data))
const char *harness_shared_for(const char *function, const char *path_below_data);

/* Path inside the checkout, and in a folder for files the tests write. Valid until the next call but three.
 */
const char *harness_source(const char *path);
const char *harness_scratch(const char *name);

/* Whole file, NUL after its end; free() it. NULL if it cannot be read. */
char *harness_read(const char *path, size_t *size);
bool harness_write(const char *path, const void *bytes, size_t size);

/* Allocates until `allowed` calls have been served, then fails every one; counts the memory in use. */
typedef struct harness_memory {
  sbf_allocator allocator;
  size_t allowed, calls, held_bytes;
} harness_memory;
void harness_memory_init(harness_memory *memory, size_t allowed);

#endif
