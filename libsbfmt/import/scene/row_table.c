#include "import/scene/row_table.h"

#include <string.h>

void sbfi_row_table_init(sbfi_row_table *table, const sbf_allocator *allocator) {
  sbfi_array_init(&table->rows, allocator, sizeof(sbfi_row));
  sbfi_array_init(&table->slots, allocator, sizeof(uint32_t));
}

void sbfi_row_table_free(sbfi_row_table *table) {
  sbfi_array_free(&table->rows);
  sbfi_array_free(&table->slots);
}

void sbfi_row_table_clear(sbfi_row_table *table) {
  table->rows.count = 0;
  if (table->slots.count) memset(table->slots.at, 0, table->slots.count * sizeof(uint32_t));
}

uint32_t sbfi_float_word(float value) {
  uint32_t word;
  value += 0.0f; /* -0 becomes 0 */
  memcpy(&word, &value, sizeof word);
  return word;
}

/* Mixes words one by one; the constants are odd with well distributed bits. */
static size_t hash(const sbfi_row *row) {
  uint64_t h = 0x9e3779b97f4a7c15u;
  for (int i = 0; i < 4; i++) {
    h = (h ^ row->at[i]) * 0xff51afd7ed558ccdu;
    h ^= h >> 32;
  }
  return (size_t)h;
}

/* Slot of the row, or the empty slot where it belongs. The number of slots is a power of two; at least one
 * is empty. */
static uint32_t *slot_of(const sbfi_row_table *table, const sbfi_row *row) {
  uint32_t *slots = table->slots.at;
  const sbfi_row *rows = table->rows.at;
  size_t mask = table->slots.count - 1;
  for (size_t index = hash(row) & mask;; index = (index + 1) & mask)
    if (slots[index] == 0 || memcmp(&rows[slots[index] - 1], row, sizeof *row) == 0) return &slots[index];
}

static bool grow(sbfi_row_table *table) {
  const sbfi_row *rows = table->rows.at;
  if (!sbfi_array_push(&table->slots, table->slots.count ? table->slots.count : 64)) return false;
  memset(table->slots.at, 0, table->slots.count * sizeof(uint32_t));
  for (size_t i = 0; i < table->rows.count; i++) *slot_of(table, &rows[i]) = (uint32_t)i + 1;
  return true;
}

int64_t sbfi_row_table_add(sbfi_row_table *table, sbfi_row row) {
  if (table->rows.count >= INT32_MAX) return -1;
  if (table->rows.count * 2 >= table->slots.count && !grow(table)) return -1;
  uint32_t *slot = slot_of(table, &row);
  if (*slot) return (int64_t)*slot - 1;
  if (!sbfi_array_append(&table->rows, &row, 1)) return -1;
  *slot = (uint32_t)table->rows.count;
  return (int64_t)table->rows.count - 1;
}
