/* A sheet as SVG, drawn by gnuplot: a process of its own. */
#ifndef CHART_DRAWING_H
#define CHART_DRAWING_H

#include "chart/machine.h"
#include "chart/out_folder.h"
#include "chart/sheet.h"

/* NAME-AXIS.svg for each of the sheet's axes: error over µs a frame on the left, over visits of elements on
 * the right, both by logarithms. IO_CANNOT_RUN where there is no such program: nothing is drawn. */
sbf_status chart_draw(const chart_sheet *sheet, const chart_machine *machine, const chart_folder *folder,
    sbf_diagnostic *error);

/* Feeds gnuplot a script that draws the file `name`, which messages speak of; IO_CANNOT_RUN likewise. */
sbf_status chart_gnuplot(const char *script, size_t size, const char *name, sbf_diagnostic *error);

#endif
