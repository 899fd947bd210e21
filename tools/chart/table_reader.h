/* Reads tables of a case (table.h), to draw them again without measuring. */
#ifndef CHART_TABLE_READER_H
#define CHART_TABLE_READER_H

#include "chart/machine.h"
#include "chart/sheet.h"

/* Fills `sheet` except its title and axes, which the case defines, from CASE.csv at `path` and
 * CASE-runs.csv beside it, and `machine` with the origin of the measurements; `name` (size bytes) receives
 * the case's name, which sheet->name points to. Free the sheet, also on failure. BAD_INPUT if the tables
 * are invalid, or not of one measurement. */
sbf_status chart_table_read(const char *path, chart_sheet *sheet, chart_machine *machine, char *name,
    size_t size, sbf_diagnostic *error);

#endif
