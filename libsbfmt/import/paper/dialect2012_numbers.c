/* Maps ids of the 2012 dialect to indices. Most files count from 1 and need no table. */
#include <stdlib.h>

#include "import/paper/dialect2012.h"

static int compare_entries(const void *a, const void *b) {
  uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
  return x < y ? -1 : x > y;
}

bool sbfi_paper_table_make(
    sbfi_conversion *c, sbfi_paper_table *table, const sbfi_array *ids, const char *what) {
  *table = (sbfi_paper_table){.ids = ids->at, .count = (uint32_t)ids->count};
  uint32_t ordered = 0;
  while (ordered < table->count && table->ids[ordered] == ordered + 1) ordered++;
  if (ordered == table->count) return true;
  table->sorted = sbfi_arena_allocate(&c->scratch, table->count, sizeof *table->sorted);
  if (!table->sorted) return sbfi_convert_no_memory(c) == SBF_OK;
  for (uint32_t i = 0; i < table->count; i++) table->sorted[i] = (uint64_t)table->ids[i] << 32 | i;
  qsort(table->sorted, table->count, sizeof *table->sorted, compare_entries);
  for (uint32_t i = 1; i < table->count; i++)
    if (table->sorted[i] >> 32 == table->sorted[i - 1] >> 32)
      return sbfi_diagnose(c->error, SBF_CODE_ID_REPEATED, "two %s have the id %u", what,
                 (unsigned)(table->sorted[i] >> 32)) == SBF_OK;
  return true;
}

bool sbfi_paper_find(
    sbfi_conversion *c, const sbfi_paper_table *table, uint32_t id, const char *what, uint32_t *slots) {
  if (!table->sorted && id >= 1 && id <= table->count) {
    *slots = id - 1;
    return true;
  }
  uint32_t low = 0, high = table->sorted ? table->count : 0;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2, found = (uint32_t)(table->sorted[middle] >> 32);
    if (found == id) {
      *slots = (uint32_t)table->sorted[middle];
      return true;
    }
    if (found < id)
      low = middle + 1;
    else
      high = middle;
  }
  return sbfi_diagnose(c->error, SBF_CODE_IMPORT_INDEX, "none of the %s has the id %u", what, id) == SBF_OK;
}
