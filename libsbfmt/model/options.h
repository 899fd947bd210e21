/* Options as a caller gives them: of this version, or of an older one and so shorter. */
#ifndef SBFI_OPTIONS_H
#define SBFI_OPTIONS_H

#include "sbfmt/packed.h"

/* Copies to `to`, of `known` bytes and zero, what the caller's struct has, whose first member is its size; 0
 * stands for all. `given` may be NULL. False where the size is none that any version had. */
bool sbfi_options_take(void *to, size_t known, const void *given);

/* A copy with every default in place but that of `inflated_bytes`; `given` may be NULL, or of an older
 * version and so shorter. */
sbf_load_options sbfi_load_options_of(const sbf_load_options *given);
/* What the chunks of a file of so many bytes may inflate to together. */
uint64_t sbfi_inflated_limit(const sbf_limits *limits, uint64_t file_bytes);

sbf_save_options sbfi_save_options_of(const sbf_save_options *given);

#endif
