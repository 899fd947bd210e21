/* Version rule: a file of our major version loads with any minor version, because newer minor versions
 * only add optional content, which is skipped. A newer major version is rejected. */
#ifndef SBFI_VERSION_H
#define SBFI_VERSION_H

#include "sbfmt/model.h"

typedef enum sbfi_version_verdict {
  SBFI_VERSION_KNOWN,       /* ours or older */
  SBFI_VERSION_NEWER_MINOR, /* loads; unknown content is skipped */
  SBFI_VERSION_TOO_NEW,
  SBFI_VERSION_MALFORMED /* not major.minor */
} sbfi_version_verdict;

sbfi_version_verdict sbfi_version_check(const char *version);

/* Minor number of a version 1.x; 0 for others. A file does not know fields of later minor versions. */
uint32_t sbfi_version_minor(const char *version);

/* Version that a writer states: the asset's own, or 1.x if a field of a later version is in use. */
enum { SBFI_VERSION_TEXT = 16 };
const char *sbfi_version_to_state(const sbf_asset *asset, char text[SBFI_VERSION_TEXT]);

#endif
