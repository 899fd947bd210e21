#include "base/fault.h"

#include <stdarg.h>
#include <stdio.h>

static sbf_status fill(
    sbf_diagnostic *to, sbf_code code, const char *file, const char *format, va_list arguments) {
  const sbf_code_info *info = sbf_code_find((int32_t)code);
  if (to) {
    *to = (sbf_diagnostic){.code = (int32_t)code, .severity = SBF_SEVERITY_ERROR, .offset = -1, .index = -1};
    vsnprintf(to->message, sizeof to->message, format, arguments);
    snprintf(to->file, sizeof to->file, "%s", file);
  }
  return info ? info->fault : SBF_FAILED;
}

sbf_status fault_set(sbf_diagnostic *to, sbf_code code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sbf_status status = fill(to, code, "", format, arguments);
  va_end(arguments);
  return status;
}

sbf_status fault_set_file(sbf_diagnostic *to, sbf_code code, const char *file, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sbf_status status = fill(to, code, file, format, arguments);
  va_end(arguments);
  return status;
}
