/* Code shared by fuzz targets. A target is one function that must accept any bytes; the same sources are
 * built for libFuzzer (./run fuzz) and, with replay.c, as a test that reads the files in corpus/ again. */
#ifndef TEST_FUZZ_H
#define TEST_FUZZ_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Ends the program, which the fuzzer takes for a find, where what a reader promises does not hold. */
#define FUZZ_MUST(condition)                                                                                 \
  do {                                                                                                       \
    if (!(condition)) {                                                                                      \
      fprintf(stderr, "%s:%d: broken promise: %s\n", __FILE__, __LINE__, #condition);                        \
      abort();                                                                                               \
    }                                                                                                        \
  } while (0)

#endif
