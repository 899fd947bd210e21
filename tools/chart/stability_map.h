/* Stability maps: every scheme over stiffness and one more condition, a verdict a cell. */
#ifndef CHART_STABILITY_MAP_H
#define CHART_STABILITY_MAP_H

#include "chart/hung_body.h"
#include "chart/machine.h"
#include "chart/out_folder.h"
#include "chart/stability.h"

enum { CHART_MAP_SCHEMES = 6 };
#define CHART_MAP_MIN_TURN 0.05
#define CHART_MAP_MAX_TURN 20.0

/* What cells are of. */
typedef enum chart_map_kind {
  CHART_MAP_OF_ONE_MASS, /* a mass on a spring */
  CHART_MAP_OF_MASSES,   /* a body whose free end weighs more */
  CHART_MAP_OF_POISSON   /* a body whose matter keeps its volume the more */
} chart_map_kind;

/* What runs upwards. */
typedef struct chart_map_axis {
  const char *name;  /* in file names and tables: "damping" */
  const char *label; /* beside the axis */
  const char *title; /* one line */
  double low, high;  /* of the axis; each row stands in the middle of its share */
  bool logarithmic;
  chart_map_kind kind;
  chart_elastic elastic; /* of bodies */
} chart_map_axis;

extern const chart_map_axis chart_map_axes[];
extern const uint32_t chart_map_count;
extern const sbf_scheme chart_map_schemes[CHART_MAP_SCHEMES];

typedef struct chart_map {
  const chart_map_axis *axis;
  uint32_t columns, rows;
  chart_verdict *verdicts; /* (schemes x rows x columns) */
} chart_map;

/* The number of the map of that name; chart_map_count: there is none. */
uint32_t chart_map_named(const char *name);

/* Fills `map`; free its verdicts, also on failure. Columns and rows over 0, of which maps of bodies have
 * half; `progress` may be NULL. */
sbf_status chart_map_fill(chart_map *map, uint32_t number, uint32_t columns, uint32_t rows,
    void (*progress)(const char *what, double fraction), sbf_diagnostic *error);

/* The cell that such a verdict is of. */
chart_cell chart_map_cell(const chart_map *map, uint32_t scheme, uint32_t row, uint32_t column);
uint32_t chart_map_tally(const chart_map *map, uint32_t scheme, chart_outcome outcome);

/* map-NAME.csv, a line a cell. */
sbf_status chart_map_table(
    const chart_map *map, const chart_machine *machine, const chart_folder *folder, sbf_diagnostic *error);
/* map-NAME.svg by gnuplot, a panel a scheme; IO_CANNOT_RUN where there is no such program. */
sbf_status chart_map_draw(
    const chart_map *map, const chart_machine *machine, const chart_folder *folder, sbf_diagnostic *error);

#endif
