/* A PLY whose header was cut off: assimp 5.2.5 looks for its end for ever. */
#ifndef SBFI_PLY_HEADER_H
#define SBFI_PLY_HEADER_H

#include "base/file.h"

/* IMPORT_SYNTAX where the first megabyte has no line "end_header". */
sbf_status sbfi_ply_header_check(
    const sbfi_file *file, const sbf_allocator *allocator, sbf_diagnostic *error);

#endif
