#include "chart/stability_map.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "render/fault.h"

const chart_map_axis chart_map_axes[] = {
    {"damping", "damping ratio", "a mass on a spring, by its damping", 0, 0.95, false},
    {"jitter", "jitter of frames, share of a tick",
        "a mass on a spring, damping ratio 0.1, in frames of uneven length", 0, 1, false},
    {"hitch", "hitch, ticks", "a mass on a spring, damping ratio 0.1, one frame longer by so much", 0, 20,
        false},
    {"stretch", "let go from, share of its length",
        "a mass on a spring, damping ratio 0.1, let go from near and far", 1e-4, 10, true}};
const uint32_t chart_map_count = sizeof chart_map_axes / sizeof *chart_map_axes;

const sbf_scheme chart_map_schemes[CHART_MAP_SCHEMES] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED,
    SBF_SCHEME_HEUN, SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_BLOCK_DESCENT, SBF_SCHEME_RELAXATION};

static double between(double low, double high, double share, bool logarithmic) {
  return logarithmic ? low * pow(high / low, share) : low + (high - low) * share;
}

chart_cell chart_map_cell(const chart_map *map, uint32_t scheme, uint32_t row, uint32_t column) {
  const chart_map_axis *a = map->axis;
  double value = between(a->low, a->high, (row + 0.5) / map->rows, a->logarithmic);
  chart_cell cell = {.scheme = chart_map_schemes[scheme],
      .turn = between(CHART_MAP_LEAST_TURN, CHART_MAP_MOST_TURN, (column + 0.5) / map->columns, true),
      .damping = 0.1,
      .stretch = 0.02};
  double *const conditions[] = {&cell.damping, &cell.jitter, &cell.hitch_ticks, &cell.stretch};
  *conditions[a - chart_map_axes] = value;
  return cell;
}

static chart_verdict *verdict_at(const chart_map *map, uint32_t scheme, uint32_t row, uint32_t column) {
  return &map->verdicts[((size_t)scheme * map->rows + row) * map->columns + column];
}

uint32_t chart_map_tally(const chart_map *map, uint32_t scheme, chart_outcome outcome) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < map->rows * map->columns; i++)
    count += verdict_at(map, scheme, 0, 0)[i].outcome == outcome;
  return count;
}

sbf_status chart_map_fill(chart_map *map, uint32_t number, uint32_t columns, uint32_t rows,
    void (*progress)(const char *what, double share), sbf_diagnostic *error) {
  *map = (chart_map){.axis = &chart_map_axes[number], .columns = columns, .rows = rows};
  map->verdicts = calloc((size_t)CHART_MAP_SCHEMES * rows * columns, sizeof *map->verdicts);
  if (!map->verdicts) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a stability map");
  for (uint32_t s = 0; s < CHART_MAP_SCHEMES; s++)
    for (uint32_t r = 0; r < rows; r++) {
      if (progress) progress(map->axis->name, (s + (double)r / rows) / CHART_MAP_SCHEMES);
      for (uint32_t c = 0; c < columns; c++) {
        chart_cell cell = chart_map_cell(map, s, r, c);
        sbf_status status = chart_cell_judge(&cell, verdict_at(map, s, r, c), error);
        if (status != SBF_OK) return status;
      }
    }
  return SBF_OK;
}

/* ---- Table ---- */

static void write_cell(FILE *file, const chart_map *map, const chart_cell *cell, const chart_verdict *v,
    const chart_machine *m) {
  fprintf(file, "%s,springs,%s,%.6g,%.6g,%.6g,%.6g,%.6g,%s,", map->axis->name, sbf_scheme_name(cell->scheme),
      cell->turn, cell->damping, cell->jitter, cell->hitch_ticks, cell->stretch,
      chart_outcome_names[v->outcome]);
  if (isfinite(v->off)) fprintf(file, "%.6g", v->off);
  fputc(',', file);
  if (isfinite(v->reached)) fprintf(file, "%.6g", v->reached);
  fputc(',', file);
  double bound = chart_stable_below(cell->scheme, cell->damping);
  if (isfinite(bound)) fprintf(file, "%.6g", bound);
  fputs(",\"", file);
  for (const char *c = v->why; *c; c++) fputc(*c == '"' || *c == '\n' ? '\'' : *c, file);
  fprintf(file, "\",%s,%s,%u,%s,%s\n", m->commit, m->compiler, (unsigned)m->lanes, m->processor, m->date);
}

sbf_status chart_map_table(
    const chart_map *map, const chart_machine *machine, const chart_folder *folder, sbf_diagnostic *error) {
  char name[64], path[4400];
  snprintf(name, sizeof name, "map-%s.csv", map->axis->name);
  FILE *file = chart_folder_file(folder, name, path, sizeof path) ? fopen(path, "w") : NULL;
  if (!file) return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, name, "this table cannot be written");
  fprintf(file,
      "map,model,scheme,omega_h,damping,jitter,hitch_ticks,stretch,outcome,off,reached,stable_below,"
      "why," CHART_MACHINE_COLUMNS "\n");
  for (uint32_t s = 0; s < CHART_MAP_SCHEMES; s++)
    for (uint32_t r = 0; r < map->rows; r++)
      for (uint32_t c = 0; c < map->columns; c++) {
        chart_cell cell = chart_map_cell(map, s, r, c);
        write_cell(file, map, &cell, verdict_at(map, s, r, c), machine);
      }
  bool good = !ferror(file);
  if (fclose(file) == 0 && good) return SBF_OK;
  return fault_set_file(
      error, SBF_CODE_IO_CANNOT_WRITE, name, "this table cannot be written: is the disk full?");
}
