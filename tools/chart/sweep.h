/* Runs a case: every body with every scheme at many settings, against its reference, then interleaved
 * timing of all. */
#ifndef CHART_SWEEP_H
#define CHART_SWEEP_H

#include "chart/case.h"
#include "chart/sheet.h"

typedef struct chart_effort {
  uint32_t rounds;       /* number of timing rounds */
  double distance_m;     /* viewing distance of characters */
  uint32_t max_substeps; /* schemes use 1, 2, 4 and so on up to this */
  void (*progress)(void *user, const char *what, double fraction); /* may be NULL */
  void *user;
} chart_effort;

/* Fills `sheet`; free it with chart_sheet_free, also on failure. A scheme that is unsupported or breaks
 * gets a row too; fails if memory runs out or a body cannot be created. */
sbf_status chart_sweep(
    const chart_case *charted, const chart_effort *effort, chart_sheet *sheet, sbf_diagnostic *error);

#endif
