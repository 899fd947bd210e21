/* Settings of a build as its derivation records them, `name=value` separated by spaces. */
#ifndef SBFI_BUILD_SETTINGS_H
#define SBFI_BUILD_SETTINGS_H

#include "sbfmt/build.h"

enum { SBFI_BUILD_SETTINGS_SIZE = 320, SBFI_BUILD_INTERIOR_COUNT = SBF_BUILD_INTERIOR_SHAPE_MATCHING + 1 };

/* Writes the settings that affect the result, in alphabetical order; automatic sizes are not stated. */
void sbfi_build_settings_write(const sbf_build_options *options, char text[SBFI_BUILD_SETTINGS_SIZE]);

/* Sets `*options` to the stated values; false if the text states something unknown to this library. */
bool sbfi_build_settings_read(const char *text, sbf_build_options *options);

/* The recorded cell size, which must be used for the build: whole micrometres, at least one. 0, automatic,
 * stays 0. */
double sbfi_build_settings_cell(double cell_m);

/* Checks names and values, with a message; rounds sizes to the recorded ones. */
sbf_status sbfi_build_settings_check(sbf_build_options *options, sbf_diagnostic *error);

#endif
