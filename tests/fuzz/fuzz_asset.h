/* What a load of either form of an asset promises, whatever the bytes. */
#ifndef TEST_FUZZ_ASSET_H
#define TEST_FUZZ_ASSET_H

#include "sbfmt/io.h"

/* Small bounds, so that a file which asks for much is refused at once. */
sbf_load_options fuzz_load_options(void);

typedef sbf_status fuzz_save(const sbf_asset *asset, const sbf_save_options *options,
    const sbf_allocator *allocator, sbf_buffer *buffer, sbf_diagnostic *error);
typedef sbf_status fuzz_load(const void *bytes, size_t size, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *error);

/* After a load: a failure explains itself and made nothing; what was made is sound, and writing and reading
 * it gives the same again. Frees the asset. */
void fuzz_check_load(
    sbf_status status, sbf_asset *asset, const sbf_diagnostic *error, fuzz_save *save, fuzz_load *load);

#endif
