/* Half of libFuzzer's mutations of XML become ones of a number: mutated bytes are seldom an asset that loads.
 */
#include <string.h>

#include "fuzz.h"
#include "random.h"

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned int seed);

static const char *const numbers[] = {"0", "1", "2", "3", "-1", "7", "0.5", "0.001", "1e-6", "1e-20", "1e-38",
    "10", "1000", "1e6", "1e9", "1e12", "1e20", "3e38", "-0.1", "-1e6", "4294967295", "0.49", "0.4999",
    "0.999"};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

static int is_of_number(uint8_t c) {
  return c && strchr("0123456789+-.eE", c) != NULL;
}

/* Bounds of the first number behind a quote, a bracket or a space at `at` or after it; 0 if there is none. */
static size_t find_number(const uint8_t *data, size_t size, size_t at, size_t *length) {
  for (size_t i = at + 1; i < size; i++) {
    if (!strchr("\"> \n", data[i - 1] ? data[i - 1] : 'x') || !strchr("0123456789-", data[i] ? data[i] : 'x'))
      continue;
    for (*length = 0; i + *length < size && is_of_number(data[i + *length]);) ++*length;
    return i;
  }
  return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned int seed) {
  uint32_t random = seed;
  random_next(&random);
  if (!size || data[0] == 0x89 || random_next(&random) >> 31) return LLVMFuzzerMutate(data, size, max_size);
  size_t length = 0, at = find_number(data, size, (random_next(&random) >> 4) % size, &length);
  const char *number = numbers[(random_next(&random) >> 4) % NUMBERS];
  size_t after = strlen(number), end = at + length;
  if (!at || size - length + after > max_size) return LLVMFuzzerMutate(data, size, max_size);
  memmove(data + at + after, data + end, size - end);
  memcpy(data + at, number, after);
  return size - length + after;
}
