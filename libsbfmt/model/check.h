/* The structural check as loads and saves use it: the first fault decides. */
#ifndef SBFI_CHECK_H
#define SBFI_CHECK_H

#include "sbfmt/packed.h"

/* What a load does last, with what it has read: the structure (sbf_asset_check; of an outline what is there),
 * and that no extension is required which the caller does not know. Fills `*error` (may be NULL) with the
 * first fault. */
sbf_status sbfi_check_loaded(const sbf_asset *asset, const sbf_load_options *options, sbf_diagnostic *error);

/* The first part of that alone: reports like sbf_asset_check, less what the options let pass. */
uint32_t sbfi_check_structure(const sbf_asset *asset, const sbf_load_options *options,
    void (*report)(void *user, const sbf_diagnostic *diagnostic), void *user, uint32_t limit);

/* The last part of that alone. */
sbf_status sbfi_check_extensions(
    const sbf_asset *asset, const sbf_load_options *options, sbf_diagnostic *error);

/* What a save does first: the structure alone. A file that could not be loaded again is not written. */
sbf_status sbfi_check_saved(const sbf_asset *asset, sbf_diagnostic *error);

/* Reports through the load's `report` that `left_out` parts of a newer version were passed over; the first is
 * `first`. Nothing where there are none. `stated`: the file's version. */
void sbfi_report_left_out(
    const sbf_load_options *options, const char *stated, uint32_t left_out, const char *first);

#endif
