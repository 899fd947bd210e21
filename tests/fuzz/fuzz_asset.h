/* Checks the promises of a load of either form of an asset, for any bytes. */
#ifndef TEST_FUZZ_ASSET_H
#define TEST_FUZZ_ASSET_H

#include "sbfmt/io.h"

/* Small bounds, so that a file which asks for much is refused at once. */
sbf_load_options fuzz_load_options(void);

typedef sbf_status fuzz_save(const sbf_asset *asset, const sbf_save_options *options,
    const sbf_allocator *allocator, sbf_buffer *buffer, sbf_diagnostic *error);
typedef sbf_status fuzz_load(const void *bytes, size_t size, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *error);

/* A failure explains itself and made nothing. */
void fuzz_check_failure(sbf_status status, const sbf_asset *asset, const sbf_diagnostic *error);
/* What was made keeps every promise of support/promises.h. */
void fuzz_check_promises(const sbf_asset *asset);
/* Writing and reading it gives the same again. */
void fuzz_check_round_trip(const sbf_asset *asset, fuzz_save *save, fuzz_load *load);

/* All of that after a load. Frees the asset. */
void fuzz_check_load(
    sbf_status status, sbf_asset *asset, const sbf_diagnostic *error, fuzz_save *save, fuzz_load *load);

/* Reads the outline of a packed file, which is refused or made, and holds nothing that cannot be freed. */
void fuzz_check_outline(const uint8_t *data, size_t size);

/* Loads whichever form the first byte announces, within the bounds; NULL, checked too, where it is refused.
 */
sbf_asset *fuzz_load_either(const uint8_t *data, size_t size);

#endif
