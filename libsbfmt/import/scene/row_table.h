/* Maps rows of four words to consecutive numbers: rows with equal bits get equal numbers. */
#ifndef SBFI_ROW_TABLE_H
#define SBFI_ROW_TABLE_H

#include "base/memory.h"

typedef struct sbfi_row {
  uint32_t at[4];
} sbfi_row;

typedef struct sbfi_row_table {
  sbfi_array rows;  /* sbfi_row, in order of insertion */
  sbfi_array slots; /* uint32_t, number + 1 or 0 */
} sbfi_row_table;

void sbfi_row_table_init(sbfi_row_table *table, const sbf_allocator *allocator);
void sbfi_row_table_free(sbfi_row_table *table);
void sbfi_row_table_clear(sbfi_row_table *table); /* keeps the memory */

/* Number of the row; a new row gets the previous count. -1 if memory runs out. */
int64_t sbfi_row_table_add(sbfi_row_table *table, sbfi_row row);

/* Bits of a number as a word of a row; -0 counts as 0. */
uint32_t sbfi_float_word(float value);

#endif
