/* What a file that is written may be called: its ending says its form, and keeps a slip of the pen from
 * writing over the mesh that was read. */
#ifndef OUTPUT_NAME_H
#define OUTPUT_NAME_H

#include "cli.h"

/* Whether the value of an option, if it has one, ends as one of `endings` (with their points; the last is
 * NULL), in capitals or not; false, with a message, where it does not. What is there and no regular file, as
 * a device, a pipe or a folder, may be called anything. */
bool output_name_check(const cli_call *call, const char *option, const char *const *endings);

/* Of a bundle: .sbf or .sbfz. */
bool output_name_of_bundle(const cli_call *call, const char *option);

#endif
