#include "base/diagnostic.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"

void sbfi_copy_text(char *to, size_t size, const char *text) {
  size_t length = strlen(text), kept = sbfi_utf8_cut(text, length, size - 1);
  memcpy(to, text, kept);
  to[kept] = 0;
}

/* A truncated message may end within a character. */
static void drop_broken_end(char *text, size_t size) {
  size_t length = strlen(text), good;
  if (length + 1 < size) return;
  good = sbfi_utf8_check(text, length);
  if (length - good < 4) text[good] = 0;
}

sbf_status sbfi_diagnose_v(sbf_diagnostic *to, sbf_code code, const char *format, va_list arguments) {
  const sbf_code_info *info = sbf_code_find((int32_t)code);
  sbf_severity severity = info ? info->severity : SBF_SEVERITY_ERROR;
  if (to) {
    *to = (sbf_diagnostic){.code = (int32_t)code, .severity = severity, .offset = -1, .index = -1};
    vsnprintf(to->message, sizeof to->message, format, arguments);
    drop_broken_end(to->message, sizeof to->message);
  }
  if (severity != SBF_SEVERITY_ERROR) return SBF_OK;
  return info ? info->fault : SBF_FAILED;
}

sbf_status sbfi_diagnose(sbf_diagnostic *to, sbf_code code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sbf_status status = sbfi_diagnose_v(to, code, format, arguments);
  va_end(arguments);
  return status;
}

void sbfi_report(sbfi_reporter *to, const sbf_diagnostic *diagnostic) {
  if (!to) return;
  to->errors += diagnostic->severity == SBF_SEVERITY_ERROR;
  to->warnings += diagnostic->severity == SBF_SEVERITY_WARNING;
  if (to->report) to->report(to->user, diagnostic);
}
