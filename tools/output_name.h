/* Checks names of output files: the extension selects the format, and the check prevents overwriting an
 * input mesh by a typing error. */
#ifndef OUTPUT_NAME_H
#define OUTPUT_NAME_H

#include "cli.h"

/* Whether the value of an option, if present, has one of the extensions `endings` (with dots; the last is
 * NULL), ignoring case; false, with a message, otherwise. Existing devices, pipes and folders may have any
 * name. */
bool output_name_check(const cli_call *call, const char *option, const char *const *endings);

/* For a bundle: .sbf or .sbfz. */
bool output_name_of_bundle(const cli_call *call, const char *option);

#endif
