#include "chart/table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"
#include "chart/front.h"

bool chart_table_front(const chart_sheet *sheet, chart_axis axis, bool by_time, bool *on) {
  chart_point *points = calloc(sheet->row_count + 1, sizeof *points);
  uint32_t *front = calloc(sheet->row_count + 1, sizeof *front);
  bool good = points && front;
  for (uint32_t i = 0; good && i < sheet->row_count; i++) {
    const chart_row *row = &sheet->rows[i];
    points[i].cost = by_time ? row->us.median : row->visits;
    points[i].error = !row->refused && chart_row_counts(row, axis) ? row->errors[axis] : NAN;
  }
  uint32_t count = good ? chart_front_of(points, sheet->row_count, front) : 0;
  for (uint32_t i = 0; good && i < sheet->row_count; i++) on[i] = false;
  for (uint32_t i = 0; i < count; i++) on[front[i]] = true;
  free(points), free(front);
  return good;
}

static void write_number(FILE *file, double value) {
  if (isfinite(value))
    fprintf(file, ",%.6g", value);
  else
    fputc(',', file);
}

static void write_errors(FILE *file, const double errors[CHART_AXIS_COUNT]) {
  for (int i = 0; i < CHART_AXIS_COUNT; i++) write_number(file, errors[i]);
}

/* Text as a field. */
static void write_text(FILE *file, const char *text) {
  fputc('"', file);
  for (; *text; text++) fputc(*text == '"' || *text == '\n' ? '\'' : *text, file);
  fputc('"', file);
}

static void write_machine(FILE *file, const chart_machine *m) {
  fputc(',', file);
  chart_machine_write(file, m);
  fputc('\n', file);
}

static void write_setting(FILE *file, const chart_sheet *sheet, const chart_row *row) {
  fprintf(file, "%s,%s,%s,", sheet->name, row->model, row->scheme);
  if (row->setting.substeps) fprintf(file, "%u", (unsigned)row->setting.substeps);
  fputc(',', file);
  if (row->setting.step_error_m > 0) fprintf(file, "%g", (double)row->setting.step_error_m);
}

static void write_rows(FILE *file, const chart_sheet *sheet, const chart_machine *machine, bool *fronts) {
  for (uint32_t i = 0; i < sheet->row_count; i++) {
    const chart_row *row = &sheet->rows[i];
    write_setting(file, sheet, row);
    fprintf(file, ",%u", (unsigned)row->elements);
    write_number(file, row->visits);
    const double us[] = {row->us.median, row->us.min, row->us.low, row->us.high, row->us.max};
    for (int k = 0; k < 5; k++) write_number(file, row->refused ? NAN : us[k]);
    fprintf(file, ",%u,%u,%s,", row->refused ? 0 : (unsigned)sheet->rounds, (unsigned)row->us.outliers,
        row->refused ? "refused"
        : row->sound ? "sound"
                     : "failed");
    write_text(file, row->why);
    write_errors(file, row->errors);
    fputc(',', file);
    for (int axis = 0, said = 0; axis < CHART_AXIS_COUNT; axis++)
      if (fronts[(size_t)axis * sheet->row_count + i])
        fprintf(file, "%s%s", said++ ? " " : "", chart_axis_names[axis]);
    write_machine(file, machine);
  }
}

static void write_references(FILE *file, const chart_sheet *sheet, const chart_machine *machine) {
  for (uint32_t i = 0; i < sheet->reference_count; i++) {
    const chart_reference *r = &sheet->references[i];
    fprintf(file, "%s,%s,reference,,,,,,,,,,,,sound,", sheet->name, r->model);
    write_text(file, r->what);
    write_errors(file, r->errors);
    fputc(',', file);
    write_machine(file, machine);
  }
}

static sbf_status open_file(const chart_sheet *sheet, const char *ending, const chart_folder *folder,
    FILE **file, sbf_diagnostic *error) {
  char name[96], path[4400];
  snprintf(name, sizeof name, "%s%s.csv", sheet->name, ending);
  *file = chart_folder_file(folder, name, path, sizeof path) ? fopen(path, "w") : NULL;
  return *file ? SBF_OK : fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, name, "this file cannot be made");
}

static sbf_status close_file(FILE *file, const chart_sheet *sheet, sbf_diagnostic *error) {
  bool bad = ferror(file) != 0;
  bad = fclose(file) != 0 || bad;
  return bad ? fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, sheet->name,
                   "a table of this case could not be "
                   "written whole: is the disk full?")
             : SBF_OK;
}

static sbf_status write_runs(const chart_sheet *sheet, const chart_machine *machine,
    const chart_folder *folder, sbf_diagnostic *error) {
  FILE *file;
  sbf_status status = open_file(sheet, "-runs", folder, &file, error);
  if (status != SBF_OK) return status;
  fprintf(file, "case,model,scheme,substeps,step_error_m,run,us_per_frame,%s\n", CHART_MACHINE_COLUMNS);
  for (uint32_t i = 0; i < sheet->row_count; i++)
    for (uint32_t r = 0; !sheet->rows[i].refused && r < sheet->rounds; r++) {
      write_setting(file, sheet, &sheet->rows[i]);
      fprintf(file, ",%u,%.6g", (unsigned)r + 1, sheet->rows[i].runs_us[r]);
      write_machine(file, machine);
    }
  return close_file(file, sheet, error);
}

sbf_status chart_table_write(const chart_sheet *sheet, const chart_machine *machine,
    const chart_folder *folder, sbf_diagnostic *error) {
  FILE *file;
  bool *fronts = calloc((size_t)CHART_AXIS_COUNT * sheet->row_count + 1, sizeof *fronts), good = fronts;
  for (int i = 0; good && i < CHART_AXIS_COUNT; i++)
    good = chart_table_front(sheet, (chart_axis)i, true, fronts + (size_t)i * sheet->row_count);
  sbf_status status = good ? open_file(sheet, "", folder, &file, error)
                           : fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a table");
  if (status == SBF_OK) {
    fputs("case,model,scheme,substeps,step_error_m,elements,visits_per_frame,us_per_frame,us_least,us_low,us_"
          "high,us_most,runs,outliers,outcome,why",
        file);
    for (int i = 0; i < CHART_AXIS_COUNT; i++) fprintf(file, ",%s", chart_axis_names[i]);
    fprintf(file, ",front_of,%s\n", CHART_MACHINE_COLUMNS);
    write_rows(file, sheet, machine, fronts);
    write_references(file, sheet, machine);
    status = close_file(file, sheet, error);
  }
  free(fronts);
  return status == SBF_OK ? write_runs(sheet, machine, folder, error) : status;
}
