/* Gives every file named to the fuzz target it is linked with: what once broke a reader stays mended. */
#include "fuzz.h"
#include "harness.h"

int main(int argc, char **argv) {
  for (int i = 1; i < argc; i++) {
    size_t size;
    char *bytes = harness_read(argv[i], &size);
    if (!bytes) {
      fprintf(stderr, "cannot read %s\n", argv[i]);
      return EXIT_FAILURE;
    }
    /* A block of the exact size, so that reading beyond it is found. */
    uint8_t *exact = malloc(size ? size : 1);
    FUZZ_MUST(exact);
    for (size_t at = 0; at < size; at++) exact[at] = (uint8_t)bytes[at];
    free(bytes);
    LLVMFuzzerTestOneInput(exact, size);
    free(exact);
  }
  printf("%d files\n", argc - 1);
  return EXIT_SUCCESS;
}
