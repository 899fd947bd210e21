/* Checks names of output files: the extension selects the format, and the check prevents overwriting an
 * input mesh by a typing error. */
#ifndef OUTPUT_NAME_H
#define OUTPUT_NAME_H

#include "cli.h"

/* Whether the value of an option, if present, has one of the extensions `endings` (with dots; the last is
 * NULL), ignoring case; false, with a message, otherwise. Existing devices, pipes and folders may have any
 * name. */
bool output_name_check(const cli_call *call, const char *option, const char *const *endings);

/* Whether a path has the extension, ignoring case. */
bool output_name_ends(const char *path, const char *ending);

/* For a bundle: .sbf, .sbfz or .glb. */
bool output_name_of_bundle(const cli_call *call, const char *option);

#endif
