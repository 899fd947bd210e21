/* Files of other programs through the whole conversion, those forms that need no child: the first byte
 * chooses which, the rest goes through a scratch file. TetGen's two files are divided by a NUL. */
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "fuzz_asset.h"
#include "harness.h"
#include "sbfmt/convert.h"

static const char *scratch(const char *ending) {
  static char path[256];
  const char *folder = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
  snprintf(path, sizeof path, "%s/sbfmt-fuzz-%ld.%s", folder, (long)getpid(), ending);
  return path;
}

static void put(const char *ending, const char *text, size_t size) {
  FUZZ_MUST(harness_write(scratch(ending), text, size));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const char *const endings[] = {"obj", "ele", "msh", "vtk", "tet"};
  if (size == 0) return 0;
  const char *ending = endings[data[0] % 5], *text = (const char *)data + 1;
  size_t length = size - 1;
  bool pair = data[0] % 5 == 1;
  const char *divide = pair ? memchr(text, 0, length) : NULL;
  size_t first = divide ? (size_t)(divide - text) : length, taken = divide ? first + 1 : pair ? length : 0;
  if (pair) put("node", text, first);
  put(ending, text + taken, length - taken);
  sbf_asset *asset = NULL;
  sbf_diagnostic error = {0};
  sbf_status status = sbf_convert(scratch(ending), NULL, &asset, &error);
  if (pair) unlink(scratch("node"));
  unlink(scratch(ending));
  fuzz_check_load(status, asset, &error, sbf_packed_save_memory, sbf_packed_load_memory);
  return 0;
}
