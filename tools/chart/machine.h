/* Origin of measurements: included in every table. */
#ifndef CHART_MACHINE_H
#define CHART_MACHINE_H

#include <stdint.h>
#include <stdio.h>

typedef struct chart_machine {
  char commit[64];     /* commit of the build, with a plus if the checkout differed; empty outside of one */
  char compiler[64];   /* compiler of the build */
  char processor[128]; /* model name */
  char date[16];       /* today, as 2026-11-20 */
  uint32_t lanes;      /* SIMD width of the solvers on this machine */
  double load;         /* load average over a minute; NAN: unknown */
} chart_machine;

/* Without commas, quotes and line ends: fields of CSV. */
chart_machine chart_this_machine(void);

/* Column names, in the order commit, compiler, lanes, processor, date, load. */
#define CHART_MACHINE_COLUMNS "commit,compiler,lanes,processor,date,load"

/* The fields, without a leading comma or a line end. */
void chart_machine_write(FILE *to, const chart_machine *machine);

#endif
