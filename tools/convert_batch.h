/* Converts many inputs in one call: in parallel, without unchanged inputs, with a summary table. */
#ifndef CONVERT_BATCH_H
#define CONVERT_BATCH_H

#include "cli.h"

/* Writes the output path of an input in `folder`; false if it is too long. */
typedef bool convert_path(
    const cli_call *call, const char *folder, const char *input, char *path, size_t size);

/* Converts all inputs of the call into `folder`, `jobs` at a time (0: one per processor), each in its own
 * process: this program, called with -o. Skips an input whose bundle exists if the input, the files beside it
 * with its stem, the files named by options, the options and the program have not changed since, according to
 * the bundle's hash file FOLDER/.sbfmt/NAME.tsv. Writes FOLDER/summary.tsv from all hash files and prints the
 * rows of this call. Returns the exit status. */
int convert_batch(cli_call *call, const char *folder, long jobs, convert_path *path_of);

#endif
