#include "chart/table_reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"

enum { MAX_COLUMNS = 64, MAX_ROUNDS = 10000 };

/* A table read line by line; columns are found by name. */
typedef struct table {
  FILE *file;
  const char *path;
  char *head_text, *line;
  size_t header_capacity, capacity;
  unsigned line_number;
  char *heads[MAX_COLUMNS], *fields[MAX_COLUMNS];
  int column_count;
} table;

static int split(char *line, char **fields) {
  int count = 0;
  for (char *at = line; count < MAX_COLUMNS;) {
    char *to = at;
    bool quoted = *at == '"';
    fields[count++] = at;
    if (quoted) at++;
    while (*at && *at != '\n' && *at != '\r' && (quoted ? *at != '"' : *at != ',')) *to++ = *at++;
    if (quoted && *at == '"') at++;
    bool more = *at == ',';
    *to = 0;
    if (!more) break;
    at++;
  }
  return count;
}

static sbf_status fault(const table *t, sbf_diagnostic *error, const char *what) {
  return fault_set_file(error, SBF_CODE_IO_UNKNOWN_FORMAT, t->path,
      "line %u: %s: give a table as `sbfmt chart -o DIR` writes it, CASE.csv, with its CASE-runs.csv beside "
      "it",
      t->line_number, what);
}

static void table_close(table *t) {
  if (t->file) fclose(t->file);
  free(t->head_text), free(t->line);
}

/* Reads a line, with its end, into memory that grows; false at the end of the file. */
static bool read_line(FILE *file, char **line, size_t *capacity) {
  size_t length = 0;
  int c = EOF;
  while (c != '\n' && (c = getc(file)) != EOF) {
    if (length + 2 > *capacity) {
      size_t more = 2 * *capacity + 256;
      char *grown = realloc(*line, more);
      if (!grown) return false;
      *line = grown;
      *capacity = more;
    }
    (*line)[length++] = (char)c;
  }
  if (!*line || !length) return false;
  (*line)[length] = 0;
  return true;
}

static sbf_status table_open(table *t, const char *path, sbf_diagnostic *error) {
  *t = (table){.file = fopen(path, "r"), .path = path, .line_number = 1};
  if (!t->file)
    return fault_set_file(error, SBF_CODE_IO_CANNOT_READ, path, "this table cannot be opened: is it there?");
  if (!read_line(t->file, &t->head_text, &t->header_capacity)) return fault(t, error, "it is empty");
  t->column_count = split(t->head_text, t->heads);
  return SBF_OK;
}

/* Reads the next line's fields; `*some` is false at the end. */
static sbf_status table_next(table *t, bool *some, sbf_diagnostic *error) {
  t->line_number++;
  *some = read_line(t->file, &t->line, &t->capacity);
  if (*some && split(t->line, t->fields) != t->column_count)
    return fault(t, error, "it has not as many fields as the head has columns");
  return SBF_OK;
}

/* Text in that column; NULL if there is no such column. */
static const char *text_of(const table *t, const char *column) {
  for (int i = 0; i < t->column_count; i++)
    if (strcmp(t->heads[i], column) == 0) return t->fields[i];
  return NULL;
}

/* NAN if the field is empty or not a number. */
static double number_of(const table *t, const char *column) {
  const char *text = text_of(t, column);
  char *end;
  double value = text ? strtod(text, &end) : NAN;
  return text && *text && !*end ? value : NAN;
}

static uint32_t count_of(const table *t, const char *column) {
  double value = number_of(t, column);
  return value >= 0 && value <= UINT32_MAX ? (uint32_t)value : 0;
}

static void copy_text(const table *t, const char *column, char *to, size_t size) {
  const char *text = text_of(t, column);
  snprintf(to, size, "%s", text ? text : "");
}

static sbf_status check_columns(const table *t, bool of_runs, sbf_diagnostic *error) {
  static const char *const both[] = {"case", "model", "scheme", "substeps", "step_error_m", "us_per_frame",
      "commit", "compiler", "lanes", "processor", "date"};
  static const char *const own[] = {"elements", "visits_per_frame", "us_least", "us_low", "us_high",
      "us_most", "runs", "outliers", "outcome", "why"};
  char what[80];
  for (size_t i = 0; i < sizeof both / sizeof *both + (of_runs ? 0 : sizeof own / sizeof *own); i++) {
    size_t first = sizeof both / sizeof *both;
    const char *column = i < first ? both[i] : own[i - first];
    snprintf(what, sizeof what, "the column %s is missing", column);
    if (!text_of(t, column)) return fault(t, error, what);
  }
  return SBF_OK;
}

static void read_machine(const table *t, chart_machine *m) {
  copy_text(t, "commit", m->commit, sizeof m->commit);
  copy_text(t, "compiler", m->compiler, sizeof m->compiler);
  copy_text(t, "processor", m->processor, sizeof m->processor);
  copy_text(t, "date", m->date, sizeof m->date);
  m->lanes = count_of(t, "lanes");
  m->load = number_of(t, "load");
}

static void read_errors(const table *t, double *errors) {
  for (int i = 0; i < CHART_AXIS_COUNT; i++) errors[i] = number_of(t, chart_axis_names[i]);
}

static sbf_status read_reference(const table *t, chart_sheet *sheet, sbf_diagnostic *error) {
  chart_reference *r = chart_sheet_add_reference(sheet);
  if (!r) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a table");
  copy_text(t, "model", r->model, sizeof r->model);
  copy_text(t, "why", r->what, sizeof r->what);
  read_errors(t, r->errors);
  return SBF_OK;
}

static sbf_status read_row(const table *t, chart_sheet *sheet, sbf_diagnostic *error) {
  chart_row *row = chart_sheet_add_row(sheet);
  const char *outcome = text_of(t, "outcome");
  if (!row) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a table");
  copy_text(t, "model", row->model, sizeof row->model);
  copy_text(t, "scheme", row->scheme, sizeof row->scheme);
  copy_text(t, "why", row->why, sizeof row->why);
  row->setting.substeps = count_of(t, "substeps");
  double step_error_m = number_of(t, "step_error_m");
  row->setting.step_error_m = step_error_m > 0 ? (float)step_error_m : 0;
  row->elements = count_of(t, "elements");
  row->visits = number_of(t, "visits_per_frame");
  row->refused = strcmp(outcome, "refused") == 0, row->sound = strcmp(outcome, "sound") == 0;
  if (!row->refused && !row->sound && strcmp(outcome, "failed") != 0)
    return fault(t, error, "the outcome is none of sound, failed and refused");
  read_errors(t, row->errors);
  if (row->refused) return SBF_OK;
  row->us = (chart_spread){.min = number_of(t, "us_least"),
      .low = number_of(t, "us_low"),
      .median = number_of(t, "us_per_frame"),
      .high = number_of(t, "us_high"),
      .max = number_of(t, "us_most"),
      .outliers = count_of(t, "outliers")};
  uint32_t rounds = count_of(t, "runs");
  if (!(row->us.median > 0) || !rounds || rounds > MAX_ROUNDS || (sheet->rounds && rounds != sheet->rounds))
    return fault(t, error, "a time is missing, or there are not as many runs as in the lines above");
  sheet->rounds = rounds;
  row->runs_us = calloc(rounds, sizeof *row->runs_us);
  return row->runs_us ? SBF_OK : fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a table");
}

static sbf_status read_rows(
    table *t, chart_sheet *sheet, chart_machine *machine, char *name, size_t size, sbf_diagnostic *error) {
  bool some = true;
  sbf_status status = table_next(t, &some, error);
  for (bool first = true; status == SBF_OK && some; first = false) {
    if (first) {
      if ((status = check_columns(t, false, error)) != SBF_OK) break;
      read_machine(t, machine);
      copy_text(t, "case", name, size);
    }
    if (strcmp(text_of(t, "case"), name) != 0 || strcmp(text_of(t, "commit"), machine->commit) != 0)
      return fault(t, error, "it is of another case or commit than the lines above");
    bool reference = strcmp(text_of(t, "scheme"), "reference") == 0;
    status = reference ? read_reference(t, sheet, error) : read_row(t, sheet, error);
    if (status == SBF_OK) status = table_next(t, &some, error);
  }
  return status == SBF_OK && !sheet->row_count ? fault(t, error, "it has no rows") : status;
}

/* Reads the times of every run, in the order of the rows. */
static sbf_status read_runs(
    table *t, chart_sheet *sheet, const chart_machine *machine, sbf_diagnostic *error) {
  bool some = true, first = true;
  for (uint32_t i = 0; i < sheet->row_count; i++) {
    const chart_row *row = &sheet->rows[i];
    for (uint32_t r = 0; !row->refused && r < sheet->rounds; r++, first = false) {
      sbf_status status = table_next(t, &some, error);
      if (status == SBF_OK && !some) return fault(t, error, "runs are missing here");
      if (status == SBF_OK && first) status = check_columns(t, true, error);
      if (status != SBF_OK) return status;
      if (strcmp(text_of(t, "case"), sheet->name) != 0 || strcmp(text_of(t, "scheme"), row->scheme) != 0 ||
          count_of(t, "substeps") != row->setting.substeps ||
          strcmp(text_of(t, "commit"), machine->commit) != 0)
        return fault(t, error, "this run is not of the row that the other table has in its place");
      row->runs_us[r] = number_of(t, "us_per_frame");
    }
  }
  return SBF_OK;
}

sbf_status chart_table_read(const char *path, chart_sheet *sheet, chart_machine *machine, char *name,
    size_t size, sbf_diagnostic *error) {
  table t;
  char runs[4400];
  *sheet = (chart_sheet){.name = name}, *machine = (chart_machine){.load = NAN};
  size_t length = strlen(path), ending = length > 4 && strcmp(path + length - 4, ".csv") == 0 ? 4 : 0;
  sbf_status status = table_open(&t, path, error);
  if (status == SBF_OK) status = read_rows(&t, sheet, machine, name, size, error);
  table_close(&t);
  if (status != SBF_OK) return status;
  if (snprintf(runs, sizeof runs, "%.*s-runs.csv", (int)(length - ending), path) >= (int)sizeof runs)
    return fault_set_file(error, SBF_CODE_IO_CANNOT_READ, path, "the path is too long");
  status = table_open(&t, runs, error);
  if (status == SBF_OK) status = read_runs(&t, sheet, machine, error);
  table_close(&t);
  return status;
}
