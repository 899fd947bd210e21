/* The version rule. A file of our major version loads whatever its minor one is: what a newer minor version
 * added is optional and is passed over. A newer major version is refused. */
#ifndef SBFI_VERSION_H
#define SBFI_VERSION_H

#include "sbfmt/base.h"

typedef enum sbfi_version_verdict {
  SBFI_VERSION_KNOWN,       /* ours or older */
  SBFI_VERSION_NEWER_MINOR, /* loads; what we do not know is passed over */
  SBFI_VERSION_TOO_NEW,
  SBFI_VERSION_MALFORMED /* not major.minor */
} sbfi_version_verdict;

sbfi_version_verdict sbfi_version_judge(const char *version);

#endif
