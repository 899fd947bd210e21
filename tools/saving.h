/* Writes bundles. All commands use it. */
#ifndef SAVING_H
#define SAVING_H

#include "cli.h"
#include "sbfmt/io.h"

/* Validates the asset as `sbfmt validate` does and saves it in the format of `out`'s ending: .glb as glTF
 * with soft bodies. If it is invalid, prints what is wrong in `from` and does not change `out`. `options` may
 * be NULL. Returns the exit status. */
int saving_run(const cli_call *call, const char *from, const char *out, const sbf_asset *asset,
    const sbf_save_options *options);

#endif
