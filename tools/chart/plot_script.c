#include "chart/plot_script.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "chart/front.h"
#include "chart/table.h"

static const double BUDGETS_US[] = {100, 1000, 4000};
enum { BUDGETS = 3, MOST_LINES = 64 };

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

/* Rows that are one line of the drawing: one model, one scheme, one kind of setting. */
typedef struct line {
  const char *model, *scheme;
  bool by_error;
} line;

typedef struct plot {
  const chart_sheet *sheet;
  chart_axis axis;
  line lines[MOST_LINES];
  int line_count;
  bool *front;
  double bottom, top; /* of the axis */
  double cheapest[2], dearest[2];
  bool several_models;
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
    if (known || p->line_count == MOST_LINES) continue;
    p->lines[p->line_count++] = (line){row->model, row->scheme, row->setting.step_error_m > 0};
    p->several_models = p->several_models || strcmp(row->model, p->lines[0].model) != 0;
  }
}

static double cost_of(const chart_row *row, int panel) {
  return panel ? row->visits : row->us.median;
}

static void find_range(plot *p) {
  double low = INFINITY, high = 0;
  for (int k = 0; k < 2; k++) p->cheapest[k] = INFINITY, p->dearest[k] = 0;
  for (uint32_t i = 0; i < p->sheet->row_count; i++) {
    const chart_row *row = &p->sheet->rows[i];
    for (int k = 0; !row->refused && k < 2; k++) {
      double cost = cost_of(row, k);
      if (!(cost > 0)) continue;
      p->cheapest[k] = fmin(p->cheapest[k], k ? cost : row->us.least);
      p->dearest[k] = fmax(p->dearest[k], k ? cost : row->us.most);
    }
    if (row->refused || !chart_row_counts(row, p->axis)) continue;
    low = fmin(low, row->errors[p->axis]), high = fmax(high, row->errors[p->axis]);
  }
  if (!(high > 0)) low = 1e-3, high = 1;
  p->bottom = pow(10, floor(log10(low)) - 0.2);
  p->top = pow(10, ceil(log10(high) + 0.3) + 0.4);
  for (int k = 0; k < 2; k++) {
    if (!(p->dearest[k] > 0)) p->cheapest[k] = 1, p->dearest[k] = 10;
    p->cheapest[k] = pow(10, floor(log10(p->cheapest[k]) * 2 - 0.3) / 2);
    p->dearest[k] = pow(10, ceil(log10(p->dearest[k]) * 2 + 0.2) / 2);
  }
  p->dearest[0] = fmax(p->dearest[0], 8000);
}

/* Where failures are marked: between the highest error and the top. */
static double mark_at(const plot *p) {
  return p->top / pow(10, 0.25);
}

static void write_data(FILE *to, const plot *p) {
  for (int k = 0; k < p->line_count; k++) {
    fprintf(to, "$line%d << EOD\nNaN NaN NaN NaN NaN NaN\n", k);
    for (uint32_t i = 0; i < p->sheet->row_count; i++) {
      const chart_row *row = &p->sheet->rows[i];
      if (row->refused || !is_of(&p->lines[k], row)) continue;
      bool counts = chart_row_counts(row, p->axis);
      fprintf(to, "%.6g %.6g %.6g %.6g %s %s\n", row->us.median, row->us.least, row->us.most,
          counts ? row->errors[p->axis] : mark_at(p), counts ? "1" : "NaN", counts ? "NaN" : "1");
    }
    fprintf(to, "EOD\n$visits%d << EOD\nNaN NaN NaN NaN NaN NaN\n", k);
    for (uint32_t i = 0; i < p->sheet->row_count; i++) {
      const chart_row *row = &p->sheet->rows[i];
      if (row->refused || !(row->visits > 0) || !is_of(&p->lines[k], row)) continue;
      bool counts = chart_row_counts(row, p->axis);
      fprintf(to, "%.6g 0 0 %.6g %s %s\n", row->visits, counts ? row->errors[p->axis] : mark_at(p),
          counts ? "1" : "NaN", counts ? "NaN" : "1");
    }
    fprintf(to, "EOD\n");
  }
  fprintf(to, "$runs << EOD\nNaN NaN\n");
  for (uint32_t i = 0; i < p->sheet->row_count; i++) {
    const chart_row *row = &p->sheet->rows[i];
    double y = chart_row_counts(row, p->axis) ? row->errors[p->axis] : mark_at(p);
    for (uint32_t r = 0; !row->refused && r < p->sheet->rounds; r++)
      fprintf(to, "%.6g %.6g\n", row->runs_us[r], y);
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

static void write_title(FILE *to, const plot *p, int k) {
  const line *l = &p->lines[k];
  bool refused = true;
  for (uint32_t i = 0; i < p->sheet->row_count; i++)
    if (is_of(l, &p->sheet->rows[i])) refused = refused && p->sheet->rows[i].refused;
  fprintf(to, "%s%s%s%s%s", p->several_models ? l->model : "", p->several_models ? ", " : "", l->scheme,
      l->by_error ? " by tolerance" : "", refused ? ": refused" : "");
}

/* Points by model, so that lines of one scheme keep their colour. */
static int mark_of(const plot *p, int k) {
  static const int marks[] = {7, 5, 9, 13, 11, 15};
  int model = 0;
  for (int i = 0; i < k; i++) model += strcmp(p->lines[i].model, p->lines[i + 1].model) != 0;
  return marks[model % 6];
}

/* How far the references are off themselves, at worst. */
static double reference_error(const chart_sheet *s, chart_axis axis) {
  double worst = 0;
  for (uint32_t i = 0; i < s->reference_count; i++)
    if (s->references[i].errors[axis] > worst) worst = s->references[i].errors[axis];
  return worst;
}

static void write_panel(FILE *to, const plot *p, int panel) {
  static const char *const costs[] = {
      "\302\265s a frame, median (bars: least to most; dots: runs)", "visits of elements a frame"};
  fprintf(to, "set xlabel '%s'\nset xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\n", costs[panel],
      p->cheapest[panel], p->dearest[panel], p->bottom, p->top);
  fprintf(to, "unset arrow\nunset label\n");
  fprintf(to,
      "set label 1 'failed' at graph 0.99, first %.6g right offset 0,0.9 tc rgb '#b00000' font ',10'\n",
      mark_at(p));
  double own = reference_error(p->sheet, p->axis);
  if (own > p->bottom && own < p->top)
    fprintf(to,
        "set arrow from graph 0, first %.6g to graph 1, first %.6g nohead dt 4 lc rgb '#b00000'\n"
        "set label 2 'the reference itself' at graph 0.01, first %.6g left offset 0,0.5 tc rgb '#b00000' "
        "font ',9'\n", /* nothing is that near for so little */
        own, own, own);
  for (int i = 0; panel == 0 && i < BUDGETS; i++) {
    if (!(BUDGETS_US[i] > 1.05 * p->cheapest[0])) continue;
    fprintf(to, "set arrow from %g,graph 0 to %g,graph 1 nohead dt 3 lc rgb '#555555'\n", BUDGETS_US[i],
        BUDGETS_US[i]);
    fprintf(to, "set label '%g ms' at %g,graph 0.015 rotate by 90 offset 1,0 tc rgb '#555555' font ',9'\n",
        BUDGETS_US[i] / 1000, BUDGETS_US[i]);
  }
  fprintf(to, "set %s\n",
      panel ? "key outside right top vertical noenhanced font ',9' spacing 0.85 samplen 1.5" : "nokey");
  fprintf(to, "plot ");
  if (panel == 0) fprintf(to, "$runs using 1:2 with points pt 7 ps 0.25 lc rgb '#c8c8c8' notitle, \\\n");
  fprintf(to, "$front%d using 1:2 with lines lw 7 lc rgb '#ffe08a' title 'Pareto front', \\\n", panel);
  for (int k = 0; k < p->line_count; k++) {
    unsigned colour = chart_scheme_colour(p->lines[k].scheme);
    const char *data = panel ? "visits" : "line", *dash = p->lines[k].by_error ? "dt 2 " : "";
    fprintf(to, "$%s%d using 1:($4*$5) with linespoints pt %d ps 0.7 lw 1.5 %slc rgb '#%06x' notitle, \\\n",
        data, k, mark_of(p, k), dash, colour);
    if (panel == 1) { /* by itself: data without a point of this panel would have no entry in the key */
      fprintf(to, "keyentry with linespoints pt %d ps 0.7 lw 1.5 %slc rgb '#%06x' title '", mark_of(p, k),
          dash, colour);
      write_title(to, p, k);
      fprintf(to, "', \\\n");
    }
    if (panel == 0)
      fprintf(to, "$line%d using 1:($4*$5):2:3 with xerrorbars pt 0 lw 1 lc rgb '#%06x' notitle, \\\n", k,
          colour);
    fprintf(to, "$%s%d using 1:($4*$6) with points pt 2 ps 0.9 lw 2 lc rgb '#%06x' notitle%s\n", data, k,
        colour, k + 1 < p->line_count ? ", \\" : "");
  }
}

static void write_head(FILE *to, const plot *p, const chart_machine *machine, const char *output) {
  const chart_sheet *s = p->sheet;
  fprintf(to,
      "set encoding utf8\nset terminal svg size 1360,600 font 'DejaVu Sans,12' background '#ffffff'\n"
      "set output '%s'\nset logscale xy\nset format '10^{%%T}'\nset grid lc rgb '#e4e4e4'\nset border 3\n"
      "set tics nomirror\nset ylabel '%s'\nset datafile missing 'NaN'\n",
      output, chart_axis_labels[p->axis]);
  fprintf(to, "set multiplot layout 1,2 title \"{/:Bold %s}: %s\\n", s->name, s->title);
  fprintf(to, "{/=9 %s, %s, %u lanes, commit %s, %s, median of %u runs", machine->processor,
      machine->compiler, (unsigned)machine->lanes, machine->commit[0] ? machine->commit : "unknown",
      machine->date, (unsigned)s->rounds);
  double worst = reference_error(s, p->axis);
  if (worst > 0)
    fprintf(to, "; reference off by %.1g}\"\n", worst);
  else
    fprintf(to, "; reference exact to the digits of single precision}\"\n");
}

bool chart_plot_script(
    FILE *to, const chart_sheet *sheet, chart_axis axis, const chart_machine *machine, const char *output) {
  plot p = {.sheet = sheet, .axis = axis};
  p.front = calloc(sheet->row_count + 1, sizeof *p.front);
  if (!p.front) return false;
  find_lines(&p);
  find_range(&p);
  write_data(to, &p);
  bool good = write_front(to, &p, 0) && write_front(to, &p, 1);
  write_head(to, &p, machine, output);
  write_panel(to, &p, 0);
  write_panel(to, &p, 1);
  fprintf(to, "unset multiplot\nunset output\n");
  free(p.front);
  return good;
}
