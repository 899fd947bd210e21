#include "export/exporting.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/file.h"

sbf_status sbfi_export_no_memory(sbfi_export *e) {
  return sbfi_diagnose(e->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while writing %s", e->path);
}

sbf_status sbfi_export_commit(sbfi_export *e, const char *path) {
  sbf_status status = e->text.failed
                          ? sbfi_export_no_memory(e)
                          : sbfi_file_write(path, e->text.at, e->text.length, &e->allocator, e->error);
  sbfi_text_clear(&e->text);
  return status;
}

void sbfi_export_warn(sbfi_export *e, const char *format, ...) {
  sbf_diagnostic warning;
  va_list arguments;
  va_start(arguments, format);
  sbfi_diagnose_v(&warning, SBF_CODE_EXPORT_LEFT_OUT, format, arguments);
  va_end(arguments);
  sbfi_copy_text(warning.file, sizeof warning.file, e->path);
  sbfi_report(&e->reporter, &warning);
}

void sbfi_export_left_out(sbfi_export *e, const char *form, const sbfi_left_out *things, size_t count) {
  char list[320] = "";
  size_t length = 0;
  for (size_t i = 0; i < count; i++) {
    if (!things[i].count || length >= sizeof list) continue;
    int more = snprintf(
        list + length, sizeof list - length, "%s%s: %u", length ? ", " : "", things[i].what, things[i].count);
    length += more > 0 ? (size_t)more : 0;
  }
  if (length) sbfi_export_warn(e, "%s cannot store some content, which is left out. %s", form, list);
}

static void print_v(sbfi_text *text, const char *format, va_list arguments) {
  char piece[256];
  int length = vsnprintf(piece, sizeof piece, format, arguments);
  if (length > 0)
    sbfi_text_append(text, piece, (size_t)length < sizeof piece ? (size_t)length : sizeof piece - 1);
}

void sbfi_export_print(sbfi_text *text, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  print_v(text, format, arguments);
  va_end(arguments);
}

void sbfi_export_format(sbfi_export *e, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  print_v(&e->text, format, arguments);
  va_end(arguments);
}

void sbfi_export_vec3(sbfi_export *e, sbf_vec3 v) {
  const float numbers[3] = {v.x, v.y, v.z};
  for (int k = 0; k < 3; k++) {
    sbfi_text_char(&e->text, ' ');
    sbfi_text_f32(&e->text, numbers[k]);
  }
}

void sbfi_export_bits(
    sbfi_text *text, const char *name, uint32_t bits, const char *before, const char *after) {
  bool first = true;
  sbfi_export_print(text, "\"%s\":[", name);
  for (unsigned k = 0; k < 32; k++)
    if (bits >> k & 1) {
      sbfi_export_print(text, "%s%s%u%s", first ? "" : ",", before, k, after);
      first = false;
    }
  sbfi_text_char(text, ']');
}
