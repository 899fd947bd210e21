/* Creates diagnostics; the only place that formats messages. */
#ifndef SBFI_DIAGNOSTIC_H
#define SBFI_DIAGNOSTIC_H

#include <stdarg.h>

#include "sbfmt/base.h"
#include "sbfmt/codes.h"

/* Fills `*to` (may be NULL) and returns the status for the code's severity and family: SBF_OK for a warning,
 * SBF_FAILED for codes about the call or the machine, SBF_BAD_INPUT otherwise. */
sbf_status sbfi_diagnose(sbf_diagnostic *to, sbf_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
sbf_status sbfi_diagnose_v(sbf_diagnostic *to, sbf_code code, const char *format, va_list arguments);

/* Copies `text` to a fixed array, truncated at a whole UTF-8 character. */
void sbfi_copy_text(char *to, size_t size, const char *text);

/* Receiver of diagnostics: a callback, and counts. */
typedef struct sbfi_reporter {
  void (*report)(void *user, const sbf_diagnostic *diagnostic); /* may be NULL */
  void *user;
  uint32_t errors, warnings;
} sbfi_reporter;

void sbfi_report(sbfi_reporter *to, const sbf_diagnostic *diagnostic); /* `to` may be NULL */

#endif
