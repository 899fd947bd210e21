/* The version rule. A file of our major version loads whatever its minor one is: what a newer minor version
 * added is optional and is passed over. A newer major version is refused. */
#ifndef SBFI_VERSION_H
#define SBFI_VERSION_H

#include "sbfmt/model.h"

typedef enum sbfi_version_verdict {
  SBFI_VERSION_KNOWN,       /* ours or older */
  SBFI_VERSION_NEWER_MINOR, /* loads; what we do not know is passed over */
  SBFI_VERSION_TOO_NEW,
  SBFI_VERSION_MALFORMED /* not major.minor */
} sbfi_version_verdict;

sbfi_version_verdict sbfi_version_check(const char *version);

/* The minor number of a version 1.x; 0 for others. Fields that a later minor version brought are unknown in a
 * file of it. */
uint32_t sbfi_version_minor(const char *version);

/* What a writer states: the asset's own version, or 1.x where a field in use is of that later version. */
enum { SBFI_VERSION_TEXT = 16 };
const char *sbfi_version_to_state(const sbf_asset *asset, char text[SBFI_VERSION_TEXT]);

#endif
