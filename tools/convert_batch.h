/* Many conversions in one call: jobs in parallel, unchanged inputs left out, a table of all. */
#ifndef CONVERT_BATCH_H
#define CONVERT_BATCH_H

#include "cli.h"

/* Converts one input to `out`; returns the exit status. */
typedef int convert_one(cli_call *call, const char *input, const char *out, void *user);
/* The path in `folder` that an input becomes; false where it is too long. */
typedef bool convert_path(const char *folder, const char *input, char *path, size_t size);

/* Converts all inputs of the call into `folder`, `jobs` at once (0: one a processor), each in a process of
 * its own. An input is left out where its bundle is there and neither the input, the files beside it with its
 * stem, the files that options name, the options nor the program have changed since: the bundle's hash file
 * FOLDER/.sbfmt/NAME.tsv says so. Writes FOLDER/summary.tsv of all hash files and prints the rows of this
 * call. Returns the worst status. */
int convert_batch(
    cli_call *call, const char *folder, long jobs, convert_path *path_of, convert_one *convert, void *user);

#endif
