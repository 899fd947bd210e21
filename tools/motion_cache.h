/* A simulated motion as a point cache of the skin. */
#ifndef MOTION_CACHE_H
#define MOTION_CACHE_H

#include "cli.h"
#include "sbfmt/export.h"
#include "sbfmt/model.h"

/* Whether the path ends as a point cache's does: .pc2 or .mdd. */
bool motion_cache_named(const char *path);

/* Writes all frames of the motion, places in world space in the order of the file's points; warns of what
 * such a file has no place for. SBF_BAD_INPUT where nothing has a skin; SBF_FAILED where it cannot be
 * written: no file then. */
sbf_status motion_cache_write(const cli_call *call, const char *path, const sbf_asset *asset,
    const sbf_export_motion *motion, sbf_diagnostic *error);

#endif
