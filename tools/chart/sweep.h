/* Runs a case: every body by every scheme at many settings, against its reference, then all of them timed in
 * turns. */
#ifndef CHART_SWEEP_H
#define CHART_SWEEP_H

#include "chart/case.h"
#include "chart/sheet.h"

typedef struct chart_effort {
  uint32_t rounds;       /* that times are taken of */
  double distance_m;     /* from which characters are looked at */
  uint32_t max_substeps; /* schemes get 1, 2, 4 and so on up to it */
  void (*progress)(void *user, const char *what, double fraction); /* may be NULL */
  void *user;
} chart_effort;

/* Fills `sheet`; free it with chart_sheet_free, also on failure. A scheme that refuses or breaks is a row
 * like any other; failures are memory, and bodies that cannot be made. */
sbf_status chart_sweep(
    const chart_case *charted, const chart_effort *effort, chart_sheet *sheet, sbf_diagnostic *error);

#endif
