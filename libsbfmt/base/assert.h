/* Invariants of the program's own state. Input is checked by diagnostics, never by these. */
#ifndef SBFI_ASSERT_H
#define SBFI_ASSERT_H

/* Builds with SBFMT_ASSERTS (debug, sanitized, fuzzed) print the broken condition with its place and abort.
 * Other builds compile the condition and do not evaluate it. */
#ifdef SBFMT_ASSERTS
#include <stdio.h>
#include <stdlib.h>

static inline void sbfi_assert(int holds, const char *condition, const char *file, int line) {
  if (holds) return;
  fprintf(stderr, "%s:%d: broken invariant: %s\n", file, line, condition);
  abort();
}
#define SBF_ASSERT(condition) sbfi_assert(!!(condition), #condition, __FILE__, __LINE__)
#else
#define SBF_ASSERT(condition) ((void)(0 && (condition)))
#endif

#endif
