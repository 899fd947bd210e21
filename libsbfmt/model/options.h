/* Options of loads and saves with what zero means filled in. */
#ifndef SBFI_OPTIONS_H
#define SBFI_OPTIONS_H

#include "sbfmt/io.h"

/* A copy with every default in place; `given` may be NULL, or of an older version and so shorter. */
sbf_load_options sbfi_load_options_of(const sbf_load_options *given);
sbf_save_options sbfi_save_options_of(const sbf_save_options *given);

#endif
