/* Tables of a case as they were written (table.h), to be drawn again without measuring. */
#ifndef CHART_TABLE_READER_H
#define CHART_TABLE_READER_H

#include "chart/machine.h"
#include "chart/sheet.h"

/* Fills `sheet` but for its title and axes, which are the case's, from CASE.csv at `path` and CASE-runs.csv
 * beside it, and `machine` with where that was measured; `name` (size bytes) gets the case's name, which
 * sheet->name points to. Free the sheet, also on failure. BAD_INPUT where the tables are none, or not of one
 * measurement. */
sbf_status chart_table_read(const char *path, chart_sheet *sheet, chart_machine *machine, char *name,
    size_t size, sbf_diagnostic *error);

#endif
