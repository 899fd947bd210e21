/* Draws a sheet as SVG with gnuplot in a separate process. */
#ifndef CHART_DRAWING_H
#define CHART_DRAWING_H

#include "chart/machine.h"
#include "chart/out_folder.h"
#include "chart/sheet.h"

/* NAME-AXIS.svg for each of the sheet's axes: error over µs per frame on the left, over element visits on
 * the right, with logarithmic scales. IO_CANNOT_RUN if gnuplot is missing: nothing is drawn. */
sbf_status chart_draw(const chart_sheet *sheet, const chart_machine *machine, const chart_folder *folder,
    sbf_diagnostic *error);

/* Runs gnuplot with a script that draws the file `name`, which messages refer to; IO_CANNOT_RUN as above. */
sbf_status chart_gnuplot(const char *script, size_t size, const char *name, sbf_diagnostic *error);

#endif
