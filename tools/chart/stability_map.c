#include "chart/stability_map.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"

const chart_map_axis chart_map_axes[] = {{.name = "damping",
                                             .label = "damping ratio",
                                             .title = "a mass on a spring, by its damping",
                                             .high = 0.95},
    {.name = "jitter",
        .label = "jitter of frames, share of a tick",
        .title = "a mass on a spring, damping ratio 0.1, in frames of uneven length",
        .high = 1},
    {.name = "hitch",
        .label = "hitch, ticks",
        .title = "a mass on a spring, damping ratio 0.1, one frame longer by so much",
        .high = 20},
    {.name = "stretch",
        .label = "let go from, share of its length",
        .title = "a mass on a spring, damping ratio 0.1, let go from near and far",
        .low = 1e-4,
        .high = 10,
        .logarithmic = true},
    {.name = "mass-springs",
        .label = "mass at the end, times a link's",
        .title = "the lowest mode of a hung chain of five masses, by how much heavier the last is",
        .low = 1,
        .high = 1000,
        .logarithmic = true,
        .kind = CHART_MAP_OF_MASSES,
        .elastic = CHART_OF_SPRINGS},
    {.name = "mass-tetrahedra",
        .label = "mass at the end, times its own",
        .title = "the lowest mode of a bar of tetrahedra, by how much heavier its end is",
        .low = 1,
        .high = 1000,
        .logarithmic = true,
        .kind = CHART_MAP_OF_MASSES,
        .elastic = CHART_OF_TETRAHEDRA},
    {.name = "mass-regions",
        .label = "mass at the end, times its own",
        .title = "the lowest mode of a bar of regions, by how much heavier its end is",
        .low = 1,
        .high = 1000,
        .logarithmic = true,
        .kind = CHART_MAP_OF_MASSES,
        .elastic = CHART_OF_REGIONS},
    {.name = "poisson",
        .label = "Poisson's ratio",
        .title = "the lowest mode of a bar of tetrahedra, by its Poisson's ratio",
        .high = 0.5,
        .kind = CHART_MAP_OF_POISSON,
        .elastic = CHART_OF_TETRAHEDRA}};
const uint32_t chart_map_count = sizeof chart_map_axes / sizeof *chart_map_axes;

const sbf_scheme chart_map_schemes[CHART_MAP_SCHEMES] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED,
    SBF_SCHEME_HEUN, SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_BLOCK_DESCENT, SBF_SCHEME_RELAXATION};

static double between(double low, double high, double fraction, bool logarithmic) {
  return logarithmic ? low * pow(high / low, fraction) : low + (high - low) * fraction;
}

chart_cell chart_map_cell(const chart_map *map, uint32_t scheme, uint32_t row, uint32_t column) {
  const chart_map_axis *a = map->axis;
  double value = between(a->low, a->high, (row + 0.5) / map->rows, a->logarithmic);
  chart_cell cell = {.scheme = chart_map_schemes[scheme],
      .turn = between(CHART_MAP_MIN_TURN, CHART_MAP_MAX_TURN, (column + 0.5) / map->columns, true),
      .damping = 0.1,
      .stretch = 0.02};
  double *const conditions[] = {&cell.damping, &cell.jitter, &cell.slow_ticks, &cell.stretch};
  if (a->kind == CHART_MAP_OF_ONE_MASS) {
    *conditions[a - chart_map_axes] = value;
    return cell;
  }
  cell.damping = CHART_SHARED_DAMPING_PERCENT / 100.0;
  cell.mass_ratio = a->kind == CHART_MAP_OF_MASSES ? value : 1;
  cell.poisson_ratio = a->elastic == CHART_OF_SPRINGS ? 0 : a->kind == CHART_MAP_OF_POISSON ? value : 0.3;
  cell.stretch = 0;
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

uint32_t chart_map_named(const char *name) {
  uint32_t i = 0;
  while (i < chart_map_count && strcmp(chart_map_axes[i].name, name) != 0) i++;
  return i;
}

/* A row of one scheme; for bodies, all cells of a row share one. */
static sbf_status fill_row(
    chart_map *map, uint32_t scheme, uint32_t row, const chart_hung_body *body, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  for (uint32_t c = 0; status == SBF_OK && c < map->columns; c++) {
    chart_cell cell = chart_map_cell(map, scheme, row, c);
    chart_verdict *verdict = verdict_at(map, scheme, row, c);
    status = body ? chart_hung_body_evaluate(body, cell.scheme, cell.turn, verdict, error)
                  : chart_cell_evaluate(&cell, verdict, error);
  }
  return status;
}

sbf_status chart_map_fill(chart_map *map, uint32_t number, uint32_t columns, uint32_t rows,
    void (*progress)(const char *what, double fraction), sbf_diagnostic *error) {
  const chart_map_axis *axis = &chart_map_axes[number];
  bool of_body = axis->kind != CHART_MAP_OF_ONE_MASS;
  sbf_status status = SBF_OK;
  if (of_body) columns = (columns + 1) / 2, rows = (rows + 1) / 2;
  *map = (chart_map){.axis = axis, .columns = columns, .rows = rows};
  map->verdicts = calloc((size_t)CHART_MAP_SCHEMES * rows * columns, sizeof *map->verdicts);
  if (!map->verdicts) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a stability map");
  for (uint32_t r = 0; status == SBF_OK && r < rows; r++) {
    chart_hung_body body = {.asset = NULL};
    chart_cell any = chart_map_cell(map, 0, r, 0);
    if (of_body)
      status = chart_hung_body_make(axis->elastic, any.mass_ratio, any.poisson_ratio, &body, error);
    for (uint32_t s = 0; status == SBF_OK && s < CHART_MAP_SCHEMES; s++) {
      if (progress) progress(axis->name, (r + (double)s / CHART_MAP_SCHEMES) / rows);
      status = fill_row(map, s, r, of_body ? &body : NULL, error);
    }
    chart_hung_body_free(&body);
  }
  return status;
}

/* ---- Table ---- */

static void write_cell(FILE *file, const chart_map *map, const chart_cell *cell, const chart_verdict *v,
    const chart_machine *m) {
  fprintf(file, "%s,%s,%s,%.6g,%.6g,%.6g,%.6g,%.6g,", map->axis->name,
      chart_elastic_names[map->axis->elastic], sbf_scheme_name(cell->scheme), cell->turn, cell->damping,
      cell->jitter, cell->slow_ticks, cell->stretch);
  if (cell->mass_ratio > 0) fprintf(file, "%.6g,%.6g", cell->mass_ratio, cell->poisson_ratio);
  fprintf(file, "%s%s,", cell->mass_ratio > 0 ? "," : ",,", chart_outcome_names[v->outcome]);
  if (isfinite(v->off)) fprintf(file, "%.6g", v->off);
  fputc(',', file);
  if (isfinite(v->reached)) fprintf(file, "%.6g", v->reached);
  fputc(',', file);
  double bound = chart_stable_below(cell->scheme, cell->damping);
  if (isfinite(bound)) fprintf(file, "%.6g", bound);
  fputs(",\"", file);
  for (const char *c = v->why; *c; c++) fputc(*c == '"' || *c == '\n' ? '\'' : *c, file);
  fputs("\",", file);
  chart_machine_write(file, m);
  fputc('\n', file);
}

sbf_status chart_map_table(
    const chart_map *map, const chart_machine *machine, const chart_folder *folder, sbf_diagnostic *error) {
  char name[64], path[4400];
  snprintf(name, sizeof name, "map-%s.csv", map->axis->name);
  FILE *file = chart_folder_file(folder, name, path, sizeof path) ? fopen(path, "w") : NULL;
  if (!file) return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, name, "this table cannot be written");
  fprintf(file, "map,model,scheme,omega_h,damping,jitter,hitch_ticks,stretch,mass_ratio,poisson_ratio,"
                "outcome,off,reached,stable_below,"
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
