/* Settings of a build as its derivation records them, `name=value` separated by spaces. */
#ifndef SBFI_BUILD_SETTINGS_H
#define SBFI_BUILD_SETTINGS_H

#include "sbfmt/build.h"

/* Sets in `*options` what the text states; false where it states something that this library does not know.
 */
bool sbfi_build_settings_read(const char *text, sbf_build_options *options);

#endif
