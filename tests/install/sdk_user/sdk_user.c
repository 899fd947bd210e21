/* Loads a file of either form through the SDK and prints its contents. */
#include <stdio.h>

#include "sbfmt/io.h"

int main(int argc, char **argv) {
  sbf_diagnostic error;
  sbf_asset *asset;
  if (argc != 2) return 2;
  if (sbf_load_file(argv[1], NULL, &asset, &error) != SBF_OK) {
    fprintf(stderr, "%s\n", error.message);
    return 1;
  }
  printf("%u bones\n", (unsigned)asset->bones.count);
  sbf_asset_free(asset);
  return 0;
}
