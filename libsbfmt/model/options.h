/* Caller's options: of this version, or of an older one and therefore shorter. */
#ifndef SBFI_OPTIONS_H
#define SBFI_OPTIONS_H

#include "sbfmt/packed.h"

/* Copies the caller's struct to `to`, which has `known` bytes and is zeroed. The first member of the
 * struct is its size; 0 means all. `given` may be NULL. False if no version had that size. */
bool sbfi_options_copy(void *to, size_t known, const void *given);

/* Copies the options and fills in all defaults except `inflated_bytes`; `given` may be NULL, or of an
 * older version and shorter. */
sbf_load_options sbfi_load_options_of(const sbf_load_options *given);
/* Limit of the total inflated size of a file's chunks. */
uint64_t sbfi_inflated_limit(const sbf_limits *limits, uint64_t file_bytes);

sbf_save_options sbfi_save_options_of(const sbf_save_options *given);

#endif
