/* Error reports of the program and its parts. */
#ifndef BASE_FAULT_H
#define BASE_FAULT_H

#include "sbfmt/codes.h"

/* Fills `*to` (may be NULL) and returns the status of the code. */
sbf_status fault_set(sbf_diagnostic *to, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same for a file. */
sbf_status fault_set_file(sbf_diagnostic *to, sbf_code code, const char *file, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
