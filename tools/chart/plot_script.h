/* Generates gnuplot's script for one axis of a sheet. */
#ifndef CHART_PLOT_SCRIPT_H
#define CHART_PLOT_SCRIPT_H

#include <stdio.h>

#include "chart/machine.h"
#include "chart/sheet.h"

/* Colours by scheme that are distinct for all kinds of colour blindness (Okabe and Ito). */
unsigned chart_scheme_colour(const char *scheme);

/* Writes the script that draws error over time and over visits, with logarithmic scales, into `output`, an
 * SVG. False if memory runs out. */
bool chart_plot_script(
    FILE *to, const chart_sheet *sheet, chart_axis axis, const chart_machine *machine, const char *output);

#endif
