/* fuzz_seeds FOLDER: writes good files of each form below FOLDER, for a fuzzer to start from. */
#include <string.h>
#include <sys/stat.h>

#include "fill_asset.h"
#include "fuzz.h"
#include "harness.h"
#include "small_asset.h"

static void put(const char *folder, const char *form, const char *name, const sbf_buffer *bytes) {
  char path[1024];
  snprintf(path, sizeof path, "%s/%s", folder, form);
  mkdir(path, 0777);
  snprintf(path, sizeof path, "%s/%s/%s", folder, form, name);
  FUZZ_MUST(harness_write(path, bytes->at, bytes->size));
}

static void put_forms(const char *folder, const char *name, const sbf_asset *asset) {
  for (int store = 0; store < 2; store++) {
    sbf_buffer bytes = {0};
    sbf_save_options options = {.store = store};
    char full[64];
    snprintf(full, sizeof full, "%s%s.sbfz", name, store ? "_stored" : "");
    FUZZ_MUST(sbf_packed_save_memory(asset, &options, NULL, &bytes, NULL) == SBF_OK);
    put(folder, "packed", full, &bytes);
    sbf_buffer_free(&bytes);
  }
  sbf_buffer bytes = {0};
  char full[64];
  snprintf(full, sizeof full, "%s.sbf", name);
  FUZZ_MUST(sbf_xml_save_memory(asset, NULL, NULL, &bytes, NULL) == SBF_OK);
  put(folder, "xml", full, &bytes);
  sbf_buffer_free(&bytes);
}

int main(int argc, char **argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  sbf_asset *small = small_asset(), *full = fill_asset(&(fill_options){.seed = 1});
  FUZZ_MUST(small && full);
  full->extensions.count = 0; /* those it requires, a load without them refuses */
  put_forms(argv[1], "small", small);
  put_forms(argv[1], "full", full);
  sbf_asset_free(small);
  sbf_asset_free(full);
  return EXIT_SUCCESS;
}
