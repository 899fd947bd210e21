/* Stability maps: every scheme over stiffness and one other condition, one verdict per cell. */
#ifndef CHART_STABILITY_MAP_H
#define CHART_STABILITY_MAP_H

#include "chart/hung_body.h"
#include "chart/machine.h"
#include "chart/out_folder.h"
#include "chart/stability.h"

enum { CHART_MAP_SCHEMES = 6 };
#define CHART_MAP_MIN_TURN 0.05
#define CHART_MAP_MAX_TURN 20.0

/* Subject of the cells. */
typedef enum chart_map_kind {
  CHART_MAP_OF_ONE_MASS, /* a mass on a spring */
  CHART_MAP_OF_MASSES,   /* a body with a heavier free end */
  CHART_MAP_OF_POISSON   /* a body with a less compressible material */
} chart_map_kind;

/* The vertical axis. */
typedef struct chart_map_axis {
  const char *name;  /* in file names and tables: "damping" */
  const char *label; /* beside the axis */
  const char *title; /* one line */
  double low, high;  /* of the axis; each row is in the middle of its interval */
  bool logarithmic;
  chart_map_kind kind;
  chart_elastic elastic; /* for bodies */
} chart_map_axis;

extern const chart_map_axis chart_map_axes[];
extern const uint32_t chart_map_count;
extern const sbf_scheme chart_map_schemes[CHART_MAP_SCHEMES];

typedef struct chart_map {
  const chart_map_axis *axis;
  uint32_t columns, rows;
  chart_verdict *verdicts; /* (schemes x rows x columns) */
} chart_map;

/* Index of the map with that name; chart_map_count if none. */
uint32_t chart_map_named(const char *name);

/* Fills `map`; free its verdicts, also on failure. Columns and rows above 0, which are halved for maps of
 * bodies; `progress` may be NULL. */
sbf_status chart_map_fill(chart_map *map, uint32_t number, uint32_t columns, uint32_t rows,
    void (*progress)(const char *what, double fraction), sbf_diagnostic *error);

/* Cell of such a verdict. */
chart_cell chart_map_cell(const chart_map *map, uint32_t scheme, uint32_t row, uint32_t column);
uint32_t chart_map_tally(const chart_map *map, uint32_t scheme, chart_outcome outcome);

/* map-NAME.csv, one line per cell. */
sbf_status chart_map_table(
    const chart_map *map, const chart_machine *machine, const chart_folder *folder, sbf_diagnostic *error);
/* map-NAME.svg by gnuplot, a panel a scheme; IO_CANNOT_RUN where there is no such program. */
sbf_status chart_map_draw(
    const chart_map *map, const chart_machine *machine, const chart_folder *folder, sbf_diagnostic *error);

#endif
