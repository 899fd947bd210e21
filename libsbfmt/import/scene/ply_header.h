/* Detects a truncated PLY header: assimp 5.2.5 would search its end forever. */
#ifndef SBFI_PLY_HEADER_H
#define SBFI_PLY_HEADER_H

#include "base/file.h"

/* IMPORT_SYNTAX if the first megabyte has no line "end_header". */
sbf_status sbfi_ply_header_check(
    const sbfi_file *file, const sbf_allocator *allocator, sbf_diagnostic *error);

#endif
