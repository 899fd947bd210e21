/* Maps names to consecutive numbers, for the groups and materials of a file. */
#ifndef SBFI_NAME_TABLE_H
#define SBFI_NAME_TABLE_H

#include "base/text.h"

typedef struct sbfi_name_table {
  sbfi_array names; /* sbfi_span, in order of insertion; refers to the caller's text */
  sbfi_array slots; /* uint32_t, number + 1 or 0 */
} sbfi_name_table;

void sbfi_name_table_init(sbfi_name_table *table, const sbf_allocator *allocator);
void sbfi_name_table_free(sbfi_name_table *table);

/* Number of the name; a new name gets the previous count. -1 if memory runs out. */
int64_t sbfi_name_table_add(sbfi_name_table *table, sbfi_span name);

/* Number of the name, or -1. */
int64_t sbfi_name_table_find(const sbfi_name_table *table, sbfi_span name);

#endif
