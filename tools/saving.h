/* The one way in which the program writes a bundle. */
#ifndef SAVING_H
#define SAVING_H

#include "cli.h"
#include "sbfmt/io.h"

/* Checks the asset as `sbfmt validate` checks a file, and saves it by the ending of `out` where it is valid.
 * Else prints what is wrong with what `from` gives and leaves `out` as it was. `options` may be NULL. Returns
 * the exit status. */
int saving_run(const cli_call *call, const char *from, const char *out, const sbf_asset *asset,
    const sbf_save_options *options);

#endif
