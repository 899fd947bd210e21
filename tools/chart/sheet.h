/* Measurements of one case: a row for every body, scheme and setting. */
#ifndef CHART_SHEET_H
#define CHART_SHEET_H

#include "chart/errors.h"
#include "chart/spread.h"
#include "chart/watched_motion.h"

typedef struct chart_row {
  char model[32];
  char scheme[32]; /* its name; for a case of space, the kind of mesh */
  chart_setting setting;
  uint32_t elements;
  double visits;   /* counted element visits per frame; NAN: unsupported, or nothing is stepped */
  bool refused;    /* the runtime does not support it */
  bool sound;      /* neither unsupported nor broken */
  char why[128];   /* reason if it is not */
  chart_spread us; /* per frame; zeros if unsupported */
  double *runs_us; /* (rounds of the sheet) NULL if unsupported */
  double errors[CHART_AXIS_COUNT];
} chart_row;

/* Reference of one body, and its own error: the distance from one with half as many steps. */
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

/* Appends an empty row; NULL if memory runs out. Existing rows may move. */
chart_row *chart_sheet_add_row(chart_sheet *sheet);
chart_reference *chart_sheet_add_reference(chart_sheet *sheet);
void chart_sheet_free(chart_sheet *sheet);

/* Whether the row is drawn as a point on this axis instead of a mark at the top: it is sound with an error
 * below 100 %. */
bool chart_row_counts(const chart_row *row, chart_axis axis);

#endif
