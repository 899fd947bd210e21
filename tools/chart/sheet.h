/* What was measured of one case: a row for every body, scheme and setting. */
#ifndef CHART_SHEET_H
#define CHART_SHEET_H

#include "chart/errors.h"
#include "chart/spread.h"
#include "chart/watched_motion.h"

typedef struct chart_row {
  char model[32];
  char scheme[32]; /* its name; of a case of space, which kind of mesh */
  chart_setting setting;
  uint32_t elements;
  double visits;   /* of elements in a frame, as counted; NAN: refused, or nothing is stepped */
  bool refused;    /* the runtime does not step it so */
  bool sound;      /* neither refused nor broken */
  char why[128];   /* it is not */
  chart_spread us; /* of a frame; zeros where refused */
  double *runs_us; /* (rounds of the sheet) NULL where refused */
  double errors[CHART_AXIS_COUNT];
} chart_row;

/* The reference of one body, and how far it is off itself: by its distance from one of half as many steps. */
typedef struct chart_reference {
  char model[32], what[96];
  double errors[CHART_AXIS_COUNT];
} chart_reference;

typedef struct chart_sheet {
  const char *name, *title;
  unsigned axes;
  uint32_t rounds;
  chart_row *rows;
  uint32_t row_count, row_space;
  chart_reference *references;
  uint32_t reference_count;
} chart_sheet;

/* An empty row at the end; NULL where memory runs out. Rows that were there may move. */
chart_row *chart_sheet_add_row(chart_sheet *sheet);
chart_reference *chart_sheet_add_reference(chart_sheet *sheet);
void chart_sheet_free(chart_sheet *sheet);

/* Whether the row has a place in the drawing over this axis rather than a mark at its top: it is sound and
 * less than wholly off. */
bool chart_row_counts(const chart_row *row, chart_axis axis);

#endif
