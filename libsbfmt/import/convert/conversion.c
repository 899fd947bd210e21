#include "import/convert/conversion.h"

#include <stdarg.h>

void sbfi_convert_warn(sbfi_conversion *c, sbf_code code, const char *format, ...) {
  sbf_diagnostic warning;
  va_list arguments;
  va_start(arguments, format);
  sbfi_diagnose_v(&warning, code, format, arguments);
  va_end(arguments);
  sbfi_copy_text(warning.file, sizeof warning.file, c->scene->file);
  sbfi_report(&c->reporter, &warning);
}

sbf_status sbfi_convert_no_memory(sbfi_conversion *c) {
  return sbfi_diagnose(
      c->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while converting %s", c->scene->file);
}

bool sbfi_is_of_section(const sbf_asset *a, const sbf_vec3_list points) {
  for (uint32_t i = 0; i < a->soft_bodies.count; i++)
    if (a->soft_bodies.at[i].surface.positions.at == points.at) return true;
  return false;
}
