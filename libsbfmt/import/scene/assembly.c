#include "import/scene/assembly.h"

#include <string.h>

#include "base/diagnostic.h"

bool sbfi_is_invented(const sbfi_assembly *a) {
  return a->raw->incomplete || strcmp(a->scene->format, "bvh") == 0;
}

bool sbfi_assembly_refuse(sbfi_assembly *a, sbf_code code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  a->status = sbfi_diagnose_v(a->error, code, format, arguments);
  va_end(arguments);
  return false;
}
