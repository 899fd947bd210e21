#include "validate/repair/repair.h"

#include <string.h>

#include "model/schema.h"

void sbfi_count_repair(
    sbfi_repair *m, sbf_code code, uint32_t count, const char *path, int64_t index, const char *format, ...) {
  sbf_diagnostic d;
  va_list arguments;
  if (count == 0) return;
  m->result->repaired += count;
  if (!m->options->report) return;
  va_start(arguments, format);
  sbfi_diagnose_v(&d, code, format, arguments);
  va_end(arguments);
  sbfi_copy_text(d.path, sizeof d.path, path);
  d.index = index;
  m->options->report(m->options->user, &d);
}

void *sbfi_repair_scratch(sbfi_repair *m, size_t count, size_t size) {
  void *memory = sbfi_arena_allocate(&m->scratch, count ? count : 1, size);
  if (!memory) m->out_of_memory = true;
  return memory;
}

void sbfi_list_drop(void *list, size_t size, const uint8_t *dropped) {
  sbfi_list all;
  uint32_t kept = 0;
  memcpy(&all.at, list, sizeof all.at);
  memcpy(&all.count, (char *)list + sizeof all.at, sizeof all.count);
  char *items = sbfi_writable(all.at);
  for (uint32_t i = 0; i < all.count; i++) {
    if (dropped[i]) continue;
    if (kept != i) memcpy(items + kept * size, items + i * size, size);
    kept++;
  }
  if (kept == 0) all.at = NULL;
  memcpy(list, &all.at, sizeof all.at);
  memcpy((char *)list + sizeof all.at, &kept, sizeof kept);
}

void sbfi_colors_drop(sbf_u32_list *counts, const uint8_t *dropped, uint32_t count) {
  uint32_t *at = sbfi_writable(counts->at);
  uint64_t sum = 0;
  for (uint32_t c = 0; c < counts->count; c++) sum += at[c];
  if (sum != count) return; /* reported unchanged */
  for (uint32_t c = 0, i = 0; c < counts->count; c++)
    for (uint32_t left = at[c]; left > 0; left--) at[c] -= dropped[i++];
}
