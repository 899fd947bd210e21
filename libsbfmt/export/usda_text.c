/* Writes the text of USD: prims, names, arrays. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "export/usda.h"

static bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

void sbfi_usda_name(usda_writer *w, const char *id, uint32_t index) {
  bool plain = *id && !strstr(id, "__");
  if (!*id || (*id >= '0' && *id <= '9')) {
    sbfi_text_char(&w->e->text, '_');
    plain = false;
  }
  for (const char *c = id; *c; c++) {
    plain = plain && is_plain(*c);
    sbfi_text_char(&w->e->text, is_plain(*c) ? *c : '_');
  }
  if (!plain) sbfi_export_format(w->e, "__%u", index);
}

void sbfi_usda_write_path(
    usda_writer *w, const char *scope, const char *id, uint32_t index, const char *rest) {
  sbfi_export_format(w->e, "</asset/%s/", scope);
  sbfi_usda_name(w, id, index);
  sbfi_text_string(&w->e->text, rest);
}

void sbfi_usda_begin(usda_writer *w, const char *text) {
  sbfi_text_repeat(&w->e->text, ' ', 4 * (size_t)w->depth);
  sbfi_text_string(&w->e->text, text);
}

void sbfi_usda_end(usda_writer *w) {
  sbfi_text_char(&w->e->text, '\n');
}

void sbfi_usda_write_line(usda_writer *w, const char *format, ...) {
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  sbfi_usda_begin(w, line);
  sbfi_usda_end(w);
}

static void open_braces(usda_writer *w, const char *schemas) {
  sbfi_text_char(&w->e->text, '"');
  if (*schemas) {
    sbfi_text_string(&w->e->text, " (\n");
    w->depth++;
    sbfi_usda_begin(w, "prepend apiSchemas = [");
    sbfi_text_string(&w->e->text, schemas);
    sbfi_text_string(&w->e->text, "]\n");
    w->depth--;
    sbfi_usda_begin(w, ")");
  }
  sbfi_usda_end(w);
  sbfi_usda_write_line(w, "{");
  w->depth++;
}

void sbfi_usda_open(usda_writer *w, const char *type, const char *id, uint32_t index, const char *schemas) {
  sbfi_usda_begin(w, "def ");
  sbfi_export_format(w->e, "%s \"", type);
  sbfi_usda_name(w, id, index);
  open_braces(w, schemas);
}

void sbfi_usda_open_plain(usda_writer *w, const char *type, const char *name, const char *schemas) {
  sbfi_usda_begin(w, "def ");
  sbfi_export_format(w->e, "%s \"%s", type, name);
  open_braces(w, schemas);
}

void sbfi_usda_close(usda_writer *w) {
  w->depth--;
  sbfi_usda_write_line(w, "}");
}

void sbfi_usda_write_f32(usda_writer *w, const char *declaration, float value) {
  sbfi_usda_begin(w, declaration);
  sbfi_text_string(&w->e->text, " = ");
  sbfi_text_f32(&w->e->text, value);
  sbfi_usda_end(w);
}

void sbfi_usda_write_tuple(usda_writer *w, const float *numbers, int count) {
  for (int k = 0; k < count; k++) {
    sbfi_text_string(&w->e->text, k ? ", " : "(");
    sbfi_text_f32(&w->e->text, numbers[k]);
  }
  sbfi_text_char(&w->e->text, ')');
}

static void declare(usda_writer *w, const char *declaration, const float *numbers, int count) {
  sbfi_usda_begin(w, declaration);
  sbfi_text_string(&w->e->text, " = ");
  sbfi_usda_write_tuple(w, numbers, count);
  sbfi_usda_end(w);
}

void sbfi_usda_write_vec3(usda_writer *w, const char *declaration, sbf_vec3 v) {
  declare(w, declaration, (const float[3]){v.x, v.y, v.z}, 3);
}

void sbfi_usda_write_quat(usda_writer *w, const char *declaration, sbf_quat q) {
  declare(w, declaration, (const float[4]){q.w, q.x, q.y, q.z}, 4);
}

void sbfi_usda_write_translation(usda_writer *w, sbf_vec3 at) {
  sbfi_usda_write_vec3(w, "double3 xformOp:translate", at);
  sbfi_usda_write_line(w, "uniform token[] xformOpOrder = [\"xformOp:translate\"]");
}

void sbfi_usda_write_points(
    usda_writer *w, const char *declaration, const sbf_vec3 *points, uint32_t count, sbf_vec3 origin) {
  sbfi_usda_begin(w, declaration);
  sbfi_text_string(&w->e->text, " = [");
  for (uint32_t i = 0; i < count; i++) {
    const float at[3] = {points[i].x - origin.x, points[i].y - origin.y, points[i].z - origin.z};
    if (i) sbfi_text_string(&w->e->text, ", ");
    sbfi_usda_write_tuple(w, at, 3);
  }
  sbfi_text_char(&w->e->text, ']');
  sbfi_usda_end(w);
}

void sbfi_usda_write_indices(
    usda_writer *w, const char *declaration, const uint32_t *indices, uint32_t count, int size) {
  sbfi_usda_begin(w, declaration);
  sbfi_text_string(&w->e->text, " = [");
  for (uint32_t i = 0; i < count; i++) {
    if (i) sbfi_text_string(&w->e->text, ", ");
    if (size > 1) sbfi_text_char(&w->e->text, '(');
    for (int k = 0; k < size; k++) {
      if (k) sbfi_text_string(&w->e->text, ", ");
      sbfi_text_u32(&w->e->text, indices[(size_t)size * i + (size_t)k]);
    }
    if (size > 1) sbfi_text_char(&w->e->text, ')');
  }
  sbfi_text_char(&w->e->text, ']');
  sbfi_usda_end(w);
}

void sbfi_usda_write_extent(usda_writer *w, const sbf_vec3 *points, uint32_t count, sbf_vec3 origin) {
  if (!count) return;
  sbf_vec3 ends[2] = {points[0], points[0]};
  for (uint32_t i = 1; i < count; i++) {
    const sbf_vec3 p = points[i];
    ends[0] = (sbf_vec3){fminf(ends[0].x, p.x), fminf(ends[0].y, p.y), fminf(ends[0].z, p.z)};
    ends[1] = (sbf_vec3){fmaxf(ends[1].x, p.x), fmaxf(ends[1].y, p.y), fmaxf(ends[1].z, p.z)};
  }
  sbfi_usda_write_points(w, "float3[] extent", ends, 2, origin);
}
