/* What gnuplot is told, for one axis of a sheet. */
#ifndef CHART_PLOT_SCRIPT_H
#define CHART_PLOT_SCRIPT_H

#include <stdio.h>

#include "chart/machine.h"
#include "chart/sheet.h"

/* Colours that eight kinds of colour blindness tell apart (Okabe and Ito), by scheme. */
unsigned chart_scheme_colour(const char *scheme);

/* Writes the script that draws error over time and over visits, both by logarithms, into `output`, an SVG.
 * False where memory runs out. */
bool chart_plot_script(
    FILE *to, const chart_sheet *sheet, chart_axis axis, const chart_machine *machine, const char *output);

#endif
