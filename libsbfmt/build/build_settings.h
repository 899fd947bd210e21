/* Settings of a build as its derivation records them, `name=value` separated by spaces. */
#ifndef SBFI_BUILD_SETTINGS_H
#define SBFI_BUILD_SETTINGS_H

#include "sbfmt/build.h"

enum { SBFI_BUILD_SETTINGS_SIZE = 320, SBFI_BUILD_INTERIOR_COUNT = SBF_BUILD_INTERIOR_SHAPE_MATCHING + 1 };

/* The settings that shape what is made, in alphabetical order; sizes that are left to the build have no word.
 */
void sbfi_build_settings_write(const sbf_build_options *options, char text[SBFI_BUILD_SETTINGS_SIZE]);

/* Sets in `*options` what the text states; false where it states something that this library does not know.
 */
bool sbfi_build_settings_read(const char *text, sbf_build_options *options);

/* The cell that is recorded, and is therefore the one to build with: whole micrometres, at least one. 0, a
 * cell that is not stated, stays. */
double sbfi_build_settings_cell(double cell_m);

/* Whether they name what there is, with a message where not; sizes become those that are recorded. */
sbf_status sbfi_build_settings_check(sbf_build_options *options, sbf_diagnostic *error);

#endif
