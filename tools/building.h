/* The options of the build passes, which `convert` and `build` share. */
#ifndef BUILDING_H
#define BUILDING_H

#include "cli.h"
#include "sbfmt/io.h"

#define BUILDING_OPTIONS                                                                                     \
  { "--springs", "METHOD", "interior springs: centroid or none (centroid)" }

/* False, with a message, where the options are wrong. */
bool building_check(cli_call *call);

/* Replaces *asset by what the passes make of it, and prints what they made. On failure *asset is freed. */
sbf_status building_run(cli_call *call, sbf_asset **asset, sbf_diagnostic *error);

#endif
