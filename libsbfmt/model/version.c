#include "model/version.h"

#include <string.h>

#include "base/number.h"
#include "sbfmt/model.h"

/* Digits only: a sign, which the number reader would take, has no place in a version. */
static bool read_part(const char **text, uint32_t *value) {
  size_t used;
  if (**text < '0' || **text > '9') return false;
  if (sbfi_scan_u32(*text, strlen(*text), value, &used) != SBFI_NUMBER_READ) return false;
  *text += used;
  return true;
}

static bool read_version(const char *text, uint32_t *major, uint32_t *minor) {
  return read_part(&text, major) && *text++ == '.' && read_part(&text, minor) && *text == 0;
}

sbfi_version_verdict sbfi_version_judge(const char *version) {
  uint32_t major, minor, our_major, our_minor;
  if (!read_version(version, &major, &minor)) return SBFI_VERSION_MALFORMED;
  if (!read_version(SBF_FORMAT_VERSION, &our_major, &our_minor)) return SBFI_VERSION_MALFORMED;
  if (major > our_major) return SBFI_VERSION_TOO_NEW;
  return major == our_major && minor > our_minor ? SBFI_VERSION_NEWER_MINOR : SBFI_VERSION_KNOWN;
}
