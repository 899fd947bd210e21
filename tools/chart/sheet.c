#include "chart/sheet.h"

#include <math.h>
#include <stdlib.h>

static const double MIN = 1e-12;

chart_row *chart_sheet_add_row(chart_sheet *sheet) {
  if (sheet->row_count == sheet->row_space) {
    uint32_t capacity = sheet->row_space ? 2 * sheet->row_space : 32;
    chart_row *more = realloc(sheet->rows, capacity * sizeof *more);
    if (!more) return NULL;
    sheet->rows = more, sheet->row_space = capacity;
  }
  chart_row *row = &sheet->rows[sheet->row_count++];
  *row = (chart_row){.visits = NAN};
  for (int i = 0; i < CHART_AXIS_COUNT; i++) row->errors[i] = NAN;
  return row;
}

chart_reference *chart_sheet_add_reference(chart_sheet *sheet) {
  chart_reference *more = realloc(sheet->references, (sheet->reference_count + 1) * sizeof *more);
  if (!more) return NULL;
  sheet->references = more;
  more[sheet->reference_count] = (chart_reference){.model = ""};
  return &more[sheet->reference_count++];
}

void chart_sheet_free(chart_sheet *sheet) {
  for (uint32_t i = 0; i < sheet->row_count; i++) free(sheet->rows[i].runs_us);
  free(sheet->rows);
  free(sheet->references);
  *sheet = (chart_sheet){.name = NULL};
}

bool chart_row_counts(const chart_row *row, chart_axis axis) {
  bool in_metres =
      axis == CHART_PATH || axis == CHART_FARTHEST || axis == CHART_PIXELS || axis == CHART_MAX_PIXELS;
  return row->sound && row->errors[axis] >= MIN && (in_metres || row->errors[axis] < 1);
}
