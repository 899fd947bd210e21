#include "chart/plot_script.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "chart/front.h"
#include "chart/table.h"

static const double BUDGETS_US[] = {100, 1000, 4000};
enum { BUDGETS = 3, MAX_LINES = 64 };
/* Fraction of a panel's height for the strip of failures at the top. */
static const double STRIP = 0.034;
static const unsigned FRONT = 0xffd966;
/* Pixels: drawing without its key, a row of the key, and the space below panels and key. */
enum { WIDTH = 1000, REST_HEIGHT = 478, KEY_ROW = 21, KEY_COLUMNS = 5, BELOW_PANELS = 58, FOOT = 30 };

unsigned chart_scheme_colour(const char *scheme) {
  static const struct {
    const char *scheme;
    unsigned colour;
  } colours[] = {{"symplectic", 0x0072b2}, {"position_based", 0xd55e00}, {"heun", 0x009e73},
      {"explicit_euler", 0x888888}, {"block_descent", 0xcc79a7}, {"relaxation", 0xe69f00},
      {"automatic", 0x000000}, {"uncalibrated", 0xd55e00}, {"calibrated", 0x0072b2}};
  for (size_t i = 0; i < sizeof colours / sizeof *colours; i++)
    if (strcmp(colours[i].scheme, scheme) == 0) return colours[i].colour;
  return 0x56b4e9;
}

/* Rows that form one line of the drawing: one model, one scheme, one kind of setting. */
typedef struct line {
  const char *model, *scheme;
  bool by_error;
} line;

typedef struct plot {
  const chart_sheet *sheet;
  chart_axis axis;
  line lines[MAX_LINES];
  int line_count;
  bool *front;
  double bottom, top, failed;            /* of the axis; failures are above `failed` */
  int failing[MAX_LINES], failing_count; /* lines of schemes with failures, one row in the strip each */
  double cheapest[2], costliest[2];
  bool several_models;
  int key_rows, foot, height; /* pixels without the rows */
} plot;

static bool is_of(const line *l, const chart_row *row) {
  return strcmp(l->model, row->model) == 0 && strcmp(l->scheme, row->scheme) == 0 &&
         l->by_error == (row->setting.step_error_m > 0);
}

static void find_lines(plot *p) {
  for (uint32_t i = 0; i < p->sheet->row_count; i++) {
    const chart_row *row = &p->sheet->rows[i];
    bool known = false;
    for (int k = 0; k < p->line_count; k++) known = known || is_of(&p->lines[k], row);
    if (known || p->line_count == MAX_LINES) continue;
    p->lines[p->line_count++] = (line){row->model, row->scheme, row->setting.step_error_m > 0};
    p->several_models = p->several_models || strcmp(row->model, p->lines[0].model) != 0;
  }
}

static double cost_of(const chart_row *row, int panel) {
  return panel ? row->visits : row->us.median;
}

static bool has_failed(const plot *p, const chart_row *row) {
  return !row->refused && !chart_row_counts(row, p->axis);
}

/* Index of its scheme among those with failures, from below; -1: none. */
static int position_of(const plot *p, const char *scheme) {
  for (int i = 0; i < p->failing_count; i++)
    if (strcmp(p->lines[p->failing[i]].scheme, scheme) == 0) return i;
  return -1;
}

static void find_failing(plot *p) {
  for (int k = p->line_count - 1; k >= 0; k--) {
    bool some = false;
    for (uint32_t i = 0; i < p->sheet->row_count; i++) {
      const chart_row *row = &p->sheet->rows[i];
      some = some || (has_failed(p, row) && strcmp(row->scheme, p->lines[k].scheme) == 0);
    }
    if (some && position_of(p, p->lines[k].scheme) < 0) p->failing[p->failing_count++] = k;
  }
}

static void find_range(plot *p) {
  double low = INFINITY, high = 0;
  for (int k = 0; k < 2; k++) p->cheapest[k] = INFINITY, p->costliest[k] = 0;
  for (uint32_t i = 0; i < p->sheet->row_count; i++) {
    const chart_row *row = &p->sheet->rows[i];
    for (int k = 0; !row->refused && k < 2; k++) {
      double cost = cost_of(row, k);
      if (!(cost > 0)) continue;
      p->cheapest[k] = fmin(p->cheapest[k], k ? cost : row->us.min);
      p->costliest[k] = fmax(p->costliest[k], k ? cost : row->us.max);
    }
    if (row->refused || !chart_row_counts(row, p->axis)) continue;
    low = fmin(low, row->errors[p->axis]), high = fmax(high, row->errors[p->axis]);
  }
  if (!(high > 0)) low = 1e-3, high = 1;
  p->bottom = pow(10, floor(log10(low)) - 0.2);
  p->failed = p->top = pow(10, ceil(log10(high) + 0.1) + 0.1);
  if (p->failing_count) {
    double fraction = STRIP * (p->failing_count + 1);
    p->top = p->failed * pow(p->failed / p->bottom, fraction / (1 - fraction));
  }
  for (int k = 0; k < 2; k++) {
    if (!(p->costliest[k] > 0)) p->cheapest[k] = 1, p->costliest[k] = 10;
    p->cheapest[k] = pow(10, floor(log10(p->cheapest[k]) * 2 - 0.3) / 2);
    p->costliest[k] = pow(10, ceil(log10(p->costliest[k]) * 2 + 0.2) / 2);
  }
  p->costliest[0] = fmax(p->costliest[0], 8000);
}

/* Position of its failures: in the strip at the top, one row per scheme. */
static double mark_at(const plot *p, const chart_row *row) {
  return p->failed * pow(p->top / p->failed, (position_of(p, row->scheme) + 1.0) / (p->failing_count + 1.0));
}

static void write_data(FILE *to, const plot *p) {
  for (int k = 0; k < p->line_count; k++) {
    fprintf(to, "$line%d << EOD\nNaN NaN NaN NaN NaN NaN\n", k);
    for (uint32_t i = 0; i < p->sheet->row_count; i++) {
      const chart_row *row = &p->sheet->rows[i];
      if (row->refused || !is_of(&p->lines[k], row)) continue;
      bool counts = chart_row_counts(row, p->axis);
      fprintf(to, "%.6g %.6g %.6g %.6g %s %s\n", row->us.median, row->us.min, row->us.max,
          counts ? row->errors[p->axis] : mark_at(p, row), counts ? "1" : "NaN", counts ? "NaN" : "1");
    }
    fprintf(to, "EOD\n$visits%d << EOD\nNaN NaN NaN NaN NaN NaN\n", k);
    for (uint32_t i = 0; i < p->sheet->row_count; i++) {
      const chart_row *row = &p->sheet->rows[i];
      if (row->refused || !(row->visits > 0) || !is_of(&p->lines[k], row)) continue;
      bool counts = chart_row_counts(row, p->axis);
      fprintf(to, "%.6g 0 0 %.6g %s %s\n", row->visits, counts ? row->errors[p->axis] : mark_at(p, row),
          counts ? "1" : "NaN", counts ? "NaN" : "1");
    }
    fprintf(to, "EOD\n");
  }
  fprintf(to, "$runs << EOD\nNaN NaN\n");
  for (uint32_t i = 0; i < p->sheet->row_count; i++) {
    const chart_row *row = &p->sheet->rows[i];
    if (row->refused) continue;
    double y = chart_row_counts(row, p->axis) ? row->errors[p->axis] : mark_at(p, row);
    for (uint32_t r = 0; r < p->sheet->rounds; r++) fprintf(to, "%.6g %.6g\n", row->runs_us[r], y);
  }
  fprintf(to, "EOD\n");
}

static bool write_front(FILE *to, const plot *p, int panel) {
  if (!chart_table_front(p->sheet, p->axis, panel == 0, p->front)) return false;
  chart_point *points = calloc(p->sheet->row_count + 1, sizeof *points);
  uint32_t count = 0;
  if (!points) return false;
  for (uint32_t i = 0; i < p->sheet->row_count; i++) {
    if (!p->front[i]) continue;
    const chart_row *row = &p->sheet->rows[i];
    uint32_t at = count++;
    for (; at > 0 && points[at - 1].cost > cost_of(row, panel); at--) points[at] = points[at - 1];
    points[at] = (chart_point){cost_of(row, panel), row->errors[p->axis]};
  }
  fprintf(to, "$front%d << EOD\n", panel);
  if (!count) fprintf(to, "NaN NaN\n");
  for (uint32_t i = 0; i < count; i++) fprintf(to, "%.6g %.6g\n", points[i].cost, points[i].error);
  fprintf(to, "EOD\n");
  free(points);
  return true;
}

/* Point type by model; lines of one scheme share their colour. */
static int mark_of(const plot *p, const char *model) {
  static const int marks[] = {7, 5, 9, 13, 11, 15};
  int models = 0;
  for (int k = 0; k < p->line_count; k++) {
    if (strcmp(p->lines[k].model, model) == 0) break;
    models += k == 0 || strcmp(p->lines[k - 1].model, p->lines[k].model) != 0;
  }
  return marks[models % 6];
}

/* Maximum error of the references themselves. */
static const chart_reference *worst_reference(const chart_sheet *s, chart_axis axis) {
  const chart_reference *worst = NULL;
  for (uint32_t i = 0; i < s->reference_count; i++)
    if (s->references[i].errors[axis] > (worst ? worst->errors[axis] : 0)) worst = &s->references[i];
  return worst;
}

static bool shows_reference(const plot *p) {
  const chart_reference *own = worst_reference(p->sheet, p->axis);
  return own && own->errors[p->axis] > p->bottom && own->errors[p->axis] < p->failed;
}

/* Background: strip of failures, time budget of games, error of the reference. */
static void write_marks(FILE *to, const plot *p, int panel) {
  fprintf(to, "unset arrow\nunset label\nunset object\n");
  if (p->failing_count) {
    fprintf(to,
        "set object 1 rectangle from graph 0, first %.6g to graph 1, graph 1 fc rgb '#f1f1f1' fs solid "
        "noborder "
        "behind\n",
        p->failed);
    if (panel == 0)
      fprintf(to, "set label 1 'failed' at graph -0.02, first %.6g right tc rgb '#b00000'\n",
          sqrt(p->failed * p->top));
  }
  const chart_reference *own = worst_reference(p->sheet, p->axis);
  if (shows_reference(p))
    fprintf(to, "set arrow from graph 0, first %.6g to graph 1, first %.6g nohead dt 4 lc rgb '#b00000'\n",
        own->errors[p->axis], own->errors[p->axis]);
  for (int i = 0; panel == 0 && i < BUDGETS; i++) {
    if (!(BUDGETS_US[i] > 1.05 * p->cheapest[0])) continue;
    fprintf(to, "set arrow from %g,graph 0 to %g,graph 1 nohead dt 3 lc rgb '#555555'\n", BUDGETS_US[i],
        BUDGETS_US[i]);
    fprintf(to, "set label '%g ms' at %g,graph 0.015 rotate by 90 offset 0.9,0 tc rgb '#555555' font ',11'\n",
        BUDGETS_US[i] / 1000, BUDGETS_US[i]);
  }
}

/* Entry of the key, by number: a line or not, a mark (0: none) and text. */
static void write_entry(FILE *to, const plot *p, int number, unsigned colour, const char *line_of, int mark,
    const char *words, const char *more) {
  if (!to) return;
  double x = 0.085 + number % KEY_COLUMNS * 0.185,
         y = (p->foot + KEY_ROW * (p->key_rows - number / KEY_COLUMNS - 0.5)) / p->height;
  if (line_of)
    fprintf(to, "set arrow from screen %.4g,%.4g to screen %.4g,%.4g nohead %s lc rgb '#%06x'\n", x, y,
        x + 0.028, y, line_of, colour);
  if (mark)
    fprintf(to, "set label '' at screen %.4g,%.4g point pt %d ps 0.9 lw 1.5 lc rgb '#%06x'\n", x + 0.014, y,
        mark, colour);
  fprintf(to, "set label '%s%s' at screen %.4g,%.4g left noenhanced font ',12'\n", words, more, x + 0.036, y);
}

/* Below both panels: each scheme once, in its colour, then each model, with its mark. Returns their
 * number; `to` NULL: writes nothing. */
static int write_key(FILE *to, const plot *p) {
  int count = 0;
  for (int k = 0; k < p->line_count; k++) {
    const line *l = &p->lines[k];
    bool known = false;
    for (int i = 0; i < k; i++)
      known = known || (strcmp(p->lines[i].scheme, l->scheme) == 0 && p->lines[i].by_error == l->by_error);
    if (!known)
      write_entry(to, p, count++, chart_scheme_colour(l->scheme), l->by_error ? "lw 2 dt 2" : "lw 2",
          p->several_models ? 0 : mark_of(p, l->model), l->scheme, l->by_error ? " by tolerance" : "");
  }
  for (int k = 0; p->several_models && k < p->line_count; k++)
    if (k == 0 || strcmp(p->lines[k - 1].model, p->lines[k].model) != 0)
      write_entry(to, p, count++, 0x606060, NULL, mark_of(p, p->lines[k].model), "of ", p->lines[k].model);
  write_entry(to, p, count++, FRONT, "lw 8", 0, "Pareto front", "");
  if (shows_reference(p)) write_entry(to, p, count++, 0xb00000, "lw 1 dt 4", 0, "the reference itself", "");
  if (p->failing_count) write_entry(to, p, count++, 0x606060, NULL, 2, "failed", "");
  write_entry(to, p, count++, 0xb8b8b8, NULL, 7, "one run", "");
  return count;
}

/* Footer: combinations of models and schemes that the runtime does not support. */
static void write_refused(FILE *to, const plot *p) {
  const char *model = NULL, *scheme = "";
  for (uint32_t i = 0; i < p->sheet->row_count; i++) {
    const chart_row *row = &p->sheet->rows[i];
    bool other = model && strcmp(model, row->model) != 0;
    if (!row->refused || (!other && strcmp(scheme, row->scheme) == 0)) continue;
    fputs(!model ? "set label \"refused by the runtime: " : other ? "; " : ", ", to);
    if (p->several_models && (!model || other)) fprintf(to, "%s ", row->model);
    fprintf(to, "%s", row->scheme);
    model = row->model, scheme = row->scheme;
  }
  if (model)
    fprintf(to, "\" at screen 0.085,%.4g left noenhanced tc rgb '#555555' font ',11'\n", 12.0 / p->height);
}

static void write_panel(FILE *to, const plot *p, int panel) {
  static const char *const costs[] = {
      "processor time a frame of 1/60 s (\302\265s): median, least to most", "visits of elements a frame"};
  fprintf(to, "set lmargin at screen %s\nset rmargin at screen %s\n", panel ? "0.565" : "0.085",
      panel ? "0.985" : "0.535");
  fprintf(to, "set xlabel '%s' offset 0,0.5\nset xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\n", costs[panel],
      p->cheapest[panel], p->costliest[panel], p->bottom, p->top);
  fprintf(to, "set ytics %.6g,%d,%.6g\n", pow(10, ceil(log10(p->bottom))),
      log10(p->failed / p->bottom) > 9 ? 100 : 10, p->failed);
  if (panel == 1) fputs("unset ylabel\nset format y ''\n", to);
  write_marks(to, p, panel);
  if (panel == 1) write_key(to, p), write_refused(to, p);
  fprintf(to, "plot ");
  if (panel == 0) fprintf(to, "$runs using 1:2 with points pt 7 ps 0.3 lc rgb '#b8b8b8' notitle, \\\n");
  fprintf(to, "$front%d using 1:2 with lines lw 8 lc rgb '#%06x' notitle, \\\n", panel, FRONT);
  for (int k = 0; k < p->line_count; k++) {
    unsigned colour = chart_scheme_colour(p->lines[k].scheme);
    const char *data = panel ? "visits" : "line", *dash = p->lines[k].by_error ? "dt 2 " : "";
    fprintf(to, "$%s%d using 1:($4*$5) with linespoints pt %d ps 0.8 lw 1.5 %slc rgb '#%06x' notitle, \\\n",
        data, k, mark_of(p, p->lines[k].model), dash, colour);
    if (panel == 0)
      fprintf(to, "$line%d using 1:($4*$5):2:3 with xerrorbars pt 0 lw 1 lc rgb '#%06x' notitle, \\\n", k,
          colour);
    fprintf(to, "$%s%d using 1:($4*$6) with points pt 2 ps 0.7 lw 1.5 lc rgb '#%06x' notitle%s\n", data, k,
        colour, k + 1 < p->line_count ? ", \\" : "");
  }
}

static void find_height(plot *p) {
  p->foot = 8;
  for (uint32_t i = 0; i < p->sheet->row_count; i++)
    if (p->sheet->rows[i].refused) p->foot = FOOT;
  p->key_rows = (write_key(NULL, p) + KEY_COLUMNS - 1) / KEY_COLUMNS;
  p->height = REST_HEIGHT + p->key_rows * KEY_ROW + p->foot;
}

static void write_head(FILE *to, const plot *p, const chart_machine *machine, const char *output) {
  const chart_sheet *s = p->sheet;
  fprintf(to,
      "set encoding utf8\nset terminal svg size %d,%d font 'DejaVu Sans,13' background '#ffffff'\n"
      "set output '%s'\nset logscale xy\nset format '10^{%%T}'\nset grid lc rgb '#e4e4e4'\nset border 3\n"
      "set tics nomirror\nunset key\nset ylabel '%s'\nset datafile missing 'NaN'\n",
      WIDTH, p->height, output, chart_axis_labels[p->axis]);
  fprintf(to, "set multiplot title \"{/:Bold %s}: %s\\n", s->name, s->title);
  fprintf(to, "{/*0.85 %s, %s, %u lanes, commit %s, %s, median of %u runs", machine->processor,
      machine->compiler, (unsigned)machine->lanes, machine->commit[0] ? machine->commit : "unknown",
      machine->date, (unsigned)s->rounds);
  const chart_reference *worst = worst_reference(s, p->axis);
  if (worst)
    fprintf(to, "; reference%s%s off by %.1g}\"\n", p->several_models ? " of " : "",
        p->several_models ? worst->model : "", worst->errors[p->axis]);
  else
    fprintf(to, "; reference exact to the digits of single precision}\"\n");
  fprintf(to, "set tmargin at screen %.4g\nset bmargin at screen %.4g\n", 1 - 64.0 / p->height,
      (double)(p->foot + p->key_rows * KEY_ROW + BELOW_PANELS) / p->height);
}

bool chart_plot_script(
    FILE *to, const chart_sheet *sheet, chart_axis axis, const chart_machine *machine, const char *output) {
  plot p = {.sheet = sheet, .axis = axis};
  p.front = calloc(sheet->row_count + 1, sizeof *p.front);
  if (!p.front) return false;
  find_lines(&p);
  find_failing(&p);
  find_range(&p);
  find_height(&p);
  write_data(to, &p);
  bool good = write_front(to, &p, 0) && write_front(to, &p, 1);
  write_head(to, &p, machine, output);
  write_panel(to, &p, 0);
  write_panel(to, &p, 1);
  fprintf(to, "unset multiplot\nunset output\n");
  free(p.front);
  return good;
}
