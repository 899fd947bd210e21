/* The 2012 dialect, through a scratch file: converted, and written in it again, which must convert too. */
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "fuzz_asset.h"
#include "harness.h"
#include "import/paper/dialect2012.h"
#include "sbfmt/convert.h"
#include "sbfmt/export.h"

static uint64_t tetrahedra_of(const sbf_asset *asset) {
  uint64_t count = 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < asset->soft_bodies.at[b].levels.count; l++)
      count += asset->soft_bodies.at[b].levels.at[l].lattice.tetrahedra.count;
  return count;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  char path[256];
  sbf_asset *asset = NULL, *again = NULL;
  sbf_diagnostic error = {0};
  const char *folder = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
  snprintf(path, sizeof path, "%s/sbfmt-fuzz-%ld.xml", folder, (long)getpid());
  FUZZ_MUST(harness_write(path, data, size));
  /* Another root is assimp's to read, in a process of its own. */
  if (sbfi_paper_supports(path)) {
    sbf_status status = sbf_convert(path, NULL, &asset, &error);
    if (status == SBF_OK && sbf_export(asset, path, NULL, &error) == SBF_OK) {
      FUZZ_MUST(sbf_convert(path, NULL, &again, &error) == SBF_OK);
      FUZZ_MUST(tetrahedra_of(asset) == tetrahedra_of(again));
      sbf_asset_free(again);
    }
    fuzz_check_load(status, asset, &error, sbf_packed_save_memory, sbf_packed_load_memory);
  }
  unlink(path);
  return 0;
}
