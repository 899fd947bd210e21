/* Writes a sheet as CSV: its rows, and the time of every run. */
#ifndef CHART_TABLE_H
#define CHART_TABLE_H

#include "chart/machine.h"
#include "chart/out_folder.h"
#include "chart/sheet.h"

/* NAME.csv, one line per row; also for references, whose scheme is "reference" and whose errors are their
 * own. NAME-runs.csv, every run of each row. */
sbf_status chart_table_write(const chart_sheet *sheet, const chart_machine *machine,
    const chart_folder *folder, sbf_diagnostic *error);

/* Sets on[i] (row_count) for rows on the front of cost and error: cost in µs if `by_time`, else in visits. */
bool chart_table_front(const chart_sheet *sheet, chart_axis axis, bool by_time, bool *on);

#endif
