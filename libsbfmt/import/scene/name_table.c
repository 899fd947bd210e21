#include "import/scene/name_table.h"

#include <string.h>

void sbfi_name_table_init(sbfi_name_table *table, const sbf_allocator *allocator) {
  sbfi_array_init(&table->names, allocator, sizeof(sbfi_span));
  sbfi_array_init(&table->slots, allocator, sizeof(uint32_t));
}

void sbfi_name_table_free(sbfi_name_table *table) {
  sbfi_array_free(&table->names);
  sbfi_array_free(&table->slots);
}

/* FNV-1a with a final mix, so that the low bits depend on every character. */
static uint32_t hash(sbfi_span name) {
  uint64_t h = 14695981039346656037u;
  for (size_t i = 0; i < name.length; i++) h = (h ^ (uint8_t)name.at[i]) * 1099511628211u;
  return (uint32_t)(h ^ h >> 32);
}

/* Slot of the name, or the empty slot where it belongs. The number of slots is a power of two; at least
 * one is empty. */
static uint32_t *slot_of(const sbfi_name_table *table, sbfi_span name) {
  uint32_t *slots = table->slots.at;
  const sbfi_span *names = table->names.at;
  size_t mask = table->slots.count - 1;
  for (size_t index = hash(name) & mask;; index = (index + 1) & mask) {
    if (slots[index] == 0) return &slots[index];
    if (sbfi_span_equal(names[slots[index] - 1], name)) return &slots[index];
  }
}

int64_t sbfi_name_table_find(const sbfi_name_table *table, sbfi_span name) {
  return table->slots.count ? (int64_t)*slot_of(table, name) - 1 : -1;
}

static bool grow(sbfi_name_table *table) {
  size_t count = table->slots.count ? table->slots.count : 16;
  if (!sbfi_array_push(&table->slots, count)) return false;
  memset(table->slots.at, 0, table->slots.count * sizeof(uint32_t));
  const sbfi_span *names = table->names.at;
  for (size_t i = 0; i < table->names.count; i++) *slot_of(table, names[i]) = (uint32_t)i + 1;
  return true;
}

int64_t sbfi_name_table_add(sbfi_name_table *table, sbfi_span name) {
  int64_t found = sbfi_name_table_find(table, name);
  if (found >= 0) return found;
  if (table->names.count >= INT32_MAX) return -1;
  if (table->names.count * 2 >= table->slots.count && !grow(table)) return -1;
  if (!sbfi_array_append(&table->names, &name, 1)) return -1;
  *slot_of(table, name) = (uint32_t)table->names.count;
  return (int64_t)table->names.count - 1;
}
