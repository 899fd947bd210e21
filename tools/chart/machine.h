/* Where and when something was measured: what every table of figures says of itself. */
#ifndef CHART_MACHINE_H
#define CHART_MACHINE_H

#include <stdint.h>
#include <stdio.h>

typedef struct chart_machine {
  char commit[64];     /* that was built, with a plus where the checkout differed; empty outside of one */
  char compiler[64];   /* that built it */
  char processor[128]; /* by its own name */
  char date[16];       /* today, as 2026-11-20 */
  uint32_t lanes;      /* numbers that the solvers compute at once here */
  double load; /* processes that wanted a core when it was asked for, on average over a minute; NAN: not
                  known */
} chart_machine;

/* Without commas, quotes and ends of line: fields of CSV. */
chart_machine chart_this_machine(void);

/* The heads of their columns, in the order commit, compiler, lanes, processor, date, load. */
#define CHART_MACHINE_COLUMNS "commit,compiler,lanes,processor,date,load"

/* The fields below them, without a comma before or an end of line behind. */
void chart_machine_write(FILE *to, const chart_machine *machine);

#endif
