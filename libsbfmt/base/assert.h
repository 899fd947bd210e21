/* Assertions about the program's own state. Input is checked with diagnostics, never with assertions. */
#ifndef SBFI_ASSERT_H
#define SBFI_ASSERT_H

/* Builds with SBFMT_ASSERTS (debug, sanitized, fuzzed) print the failed condition with file and line, and
 * abort. Other builds compile the condition without evaluating it. */
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
