#include "validate/validation.h"

#include <stdio.h>
#include <string.h>

sbfi_path sbfi_path_of(const char *format, ...) {
  sbfi_path path;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(path.text, sizeof path.text, format, arguments);
  va_end(arguments);
  return path;
}

void *sbfi_scratch(sbfi_validation *v, size_t count, size_t size) {
  void *memory = sbfi_arena_allocate(&v->scratch, count ? count : 1, size);
  if (!memory) v->out_of_memory = true;
  return memory;
}

/* Advice after the colon of the code's text. */
static void add_advice(sbf_diagnostic *d) {
  const char *text = sbf_code_find(d->code)->text, *advice = strstr(text, ": ");
  size_t used = strlen(d->message), length = advice ? strlen(advice) : 0;
  if (length && advice[length - 1] == '.') length--;
  if (used + length < sizeof d->message) {
    memcpy(d->message + used, advice ? advice : "", length);
    d->message[used + length] = 0;
  }
}

static void report(const sbfi_validation *v, sbf_diagnostic *d, const char *path, int64_t index) {
  if (!v->options->report) return;
  sbfi_copy_text(d->path, sizeof d->path, path);
  d->index = index;
  v->options->report(v->options->user, d);
}

void sbfi_report_unlisted(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->tally_count; i++) {
    sbf_diagnostic d;
    uint32_t unlisted = v->tallies[i].count - v->repeats;
    if (v->tallies[i].count <= v->repeats) continue;
    sbfi_diagnose(&d, v->tallies[i].code, "and %u more of this kind here", unlisted);
    report(v, &d, v->path, -1);
  }
  v->tally_count = 0;
}

static uint32_t count_here(sbfi_validation *v, sbf_code code, const char *path) {
  if (strcmp(path, v->path) != 0) {
    sbfi_report_unlisted(v);
    sbfi_copy_text(v->path, sizeof v->path, path);
  }
  for (uint32_t i = 0; i < v->tally_count; i++)
    if (v->tallies[i].code == code) return ++v->tallies[i].count;
  if (v->tally_count == SBFI_MAX_TALLIES) sbfi_report_unlisted(v);
  v->tallies[v->tally_count++] = (sbfi_tally){code, 1};
  return 1;
}

void sbfi_found(sbfi_validation *v, sbf_code code, const char *path, int64_t index, const char *format, ...) {
  sbf_diagnostic d;
  va_list arguments;
  va_start(arguments, format);
  sbfi_diagnose_v(&d, code, format, arguments);
  va_end(arguments);
  uint32_t *counts[] = {&v->result->errors, &v->result->warnings, &v->result->infos};
  ++*counts[d.severity];
  if (count_here(v, code, path) > v->repeats) return;
  add_advice(&d);
  report(v, &d, path, index);
}
