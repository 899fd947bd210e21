#include "build/build_state.h"

#include <stdio.h>

sbf_status sbfi_build_no_memory(sbfi_build *b) {
  if (b->cancelled) return SBF_FAILED;
  return sbfi_diagnose(b->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while building");
}

sbf_status sbfi_build_report_progress(sbfi_build *b, const char *pass, double done) {
  if (!b->options.progress || b->options.progress(b->options.user, pass, done)) return SBF_OK;
  b->cancelled = true;
  return sbfi_diagnose(b->error, SBF_CODE_CANCELLED, "cancelled while making %s", pass);
}

static bool report(void *user, double done) {
  sbfi_build *b = user;
  return sbfi_build_report_progress(b, b->pass, done) == SBF_OK;
}

sbfi_progress sbfi_build_stretch(sbfi_build *b, const char *pass, double from, double to) {
  b->pass = pass;
  return (sbfi_progress){report, b, from, to};
}

sbf_status sbfi_build_report_of_body(sbfi_build *b, uint32_t number, sbf_code code, const char *format, ...) {
  sbf_diagnostic diagnostic;
  va_list arguments;
  va_start(arguments, format);
  sbf_status status = sbfi_diagnose_v(&diagnostic, code, format, arguments);
  va_end(arguments);
  snprintf(diagnostic.path, sizeof diagnostic.path, "/sbf/soft_body[%u]", number + 1);
  if (status == SBF_OK)
    sbfi_report(&b->reporter, &diagnostic);
  else if (b->error)
    *b->error = diagnostic;
  return status;
}
