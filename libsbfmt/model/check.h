/* Structural check for loads and saves: the first fault decides. */
#ifndef SBFI_CHECK_H
#define SBFI_CHECK_H

#include "sbfmt/packed.h"

/* Last step of a load: checks the structure (sbf_asset_check; for an outline the present content), and
 * that every required extension is known to the caller. Fills `*error` (may be NULL) with the first fault. */
sbf_status sbfi_check_loaded(const sbf_asset *asset, const sbf_load_options *options, sbf_diagnostic *error);

/* Structure only: reports like sbf_asset_check, minus the faults that the options permit. */
uint32_t sbfi_check_structure(const sbf_asset *asset, const sbf_load_options *options,
    void (*report)(void *user, const sbf_diagnostic *diagnostic), void *user, uint32_t limit);

/* Extensions only. */
sbf_status sbfi_check_extensions(
    const sbf_asset *asset, const sbf_load_options *options, sbf_diagnostic *error);

/* First step of a save: structure only. Prevents files that could not be loaded again. */
sbf_status sbfi_check_saved(const sbf_asset *asset, sbf_diagnostic *error);

/* Reports through the load's `report` that `left_out` parts of a newer version were skipped, the first at
 * path `first`. Does nothing for 0. `stated`: the file's version. */
void sbfi_report_left_out(
    const sbf_load_options *options, const char *stated, uint32_t left_out, const char *first);

#endif
