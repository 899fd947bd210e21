/* Writes a simulated motion as a point cache of the skin. */
#ifndef MOTION_CACHE_H
#define MOTION_CACHE_H

#include "cli.h"
#include "sbfmt/export.h"
#include "sbfmt/model.h"

/* Whether the path has the extension of a point cache: .pc2 or .mdd. */
bool motion_cache_named(const char *path);

/* Writes all frames of the motion, positions in world space in the order of the file's points; warns of
 * what the format cannot represent. SBF_BAD_INPUT if there is no skin; SBF_FAILED if it cannot be written:
 * then there is no file. */
sbf_status motion_cache_write(const cli_call *call, const char *path, const sbf_asset *asset,
    const sbf_export_motion *motion, sbf_diagnostic *error);

#endif
