/* Draws stability maps: a coloured box for each case, and the theoretical bound. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"
#include "base/system.h"
#include "chart/drawing.h"
#include "chart/stability_map.h"

/* By outcome: colours that are distinct for all kinds of colour vision, also in greyscale. */
static const unsigned COLOURS[] = {0x56b4e9, 0xf0c430, 0x40302c, 0xffffff};

/* Merges adjacent cells of one outcome into one box. */
static void write_boxes(FILE *to, const chart_map *map, uint32_t scheme) {
  const chart_map_axis *a = map->axis;
  fprintf(to, "$cells%u << EOD\n", (unsigned)scheme);
  for (uint32_t r = 0; r < map->rows; r++) {
    const chart_verdict *row = &map->verdicts[((size_t)scheme * map->rows + r) * map->columns];
    double edges[2];
    for (int k = 0; k < 2; k++) {
      double fraction = (r + (double)k) / map->rows;
      edges[k] =
          a->logarithmic ? a->low * pow(a->high / a->low, fraction) : a->low + (a->high - a->low) * fraction;
    }
    for (uint32_t c = 0, end; c < map->columns; c = end) {
      for (end = c + 1; end < map->columns && row[end].outcome == row[c].outcome;) end++;
      double span = CHART_MAP_MAX_TURN / CHART_MAP_MIN_TURN;
      double left = CHART_MAP_MIN_TURN * pow(span, (double)c / map->columns);
      double right = CHART_MAP_MIN_TURN * pow(span, (double)end / map->columns);
      fprintf(to, "%.6g %.6g %.6g %.6g %.6g %.6g %u\n", sqrt(left * right), (edges[0] + edges[1]) / 2, left,
          right, edges[0], edges[1], COLOURS[row[c].outcome]);
    }
  }
  fprintf(to, "EOD\n");
}

/* The bound along the axis; false if there is none within the map. */
static bool write_bound(FILE *to, const chart_map *map, uint32_t scheme) {
  enum { POINTS = 96 };
  const chart_map_axis *a = map->axis;
  bool some = false;
  fprintf(to, "$bound%u << EOD\n", (unsigned)scheme);
  for (int i = 0; i <= POINTS; i++) {
    double fraction = (double)i * i / POINTS / POINTS; /* denser near zero, where bounds curve */
    double at =
        a->logarithmic ? a->low * pow(a->high / a->low, fraction) : a->low + (a->high - a->low) * fraction;
    double damping = strcmp(a->name, "damping") == 0 ? at : chart_map_cell(map, scheme, 0, 0).damping;
    double bound = chart_stable_below(chart_map_schemes[scheme], damping);
    if (!(bound >= CHART_MAP_MIN_TURN && bound <= CHART_MAP_MAX_TURN)) continue;
    fprintf(to, "%.6g %.6g\n", bound, at);
    some = true;
  }
  fprintf(to, "%sEOD\n", some ? "" : "NaN NaN\n");
  return some;
}

static void write_panel(FILE *to, const chart_map *map, uint32_t scheme) {
  write_boxes(to, map, scheme);
  bool bounded = write_bound(to, map, scheme);
  bool refused = chart_map_tally(map, scheme, CHART_REFUSED) == map->rows * map->columns;
  if (refused)
    fprintf(to, "set label 9 'refused: it cannot step these' at graph 0.5,0.5 center font ',11' front\n");
  fprintf(to,
      "set title '%s' noenhanced font ',13' offset 0,-0.5\n"
      "plot $cells%u using 1:2:3:4:5:6:7 with boxxyerror fs solid noborder lc rgb variable notitle",
      sbf_scheme_name(chart_map_schemes[scheme]), (unsigned)scheme);
  if (bounded && !refused)
    fprintf(to,
        ", \\\n$bound%u with lines lw 5 lc rgb '#ffffff' notitle, $bound%u with lines lw 2.5 lc rgb "
        "'#d00000' "
        "notitle",
        (unsigned)scheme, (unsigned)scheme);
  fputs(refused ? "\nunset label 9\n" : "\n", to);
}

/* Legend above all panels, and labels of both axes. */
static void write_legend(FILE *to, const chart_map *map) {
  static const struct {
    const char *words;
    double x, y;
  } entries[] = {{"sound", 0.085, 0.895}, {"biased: rate off by more than 5 %", 0.215, 0.895},
      {"dead: more than ten times the energy, shape lost, or numbers that are none", 0.215, 0.858}};
  for (int i = 0; i < 3; i++) {
    double x = entries[i].x, y = entries[i].y;
    fprintf(to,
        "set object %d rectangle from screen %g,screen %g to screen %g,screen %g fs solid border lc rgb "
        "'#606060' fc rgb '#%06x' front\n",
        i + 1, x, y - 0.012, x + 0.022, y + 0.012, COLOURS[i]);
    fprintf(to, "set label %d '%s' at screen %g,screen %g font ',12' front\n", i + 1, entries[i].words,
        x + 0.03, y);
  }
  fprintf(to,
      "set arrow 1 from screen 0.58,screen 0.895 to screen 0.61,screen 0.895 nohead lw 2.5 lc rgb '#d00000' "
      "front\nset label 4 'stable to the left of it: closed form' at screen 0.62,screen 0.895 font ',12' "
      "front\n"
      "set label 5 'stiffness: ωh of one substep (rad)%s' at screen 0.53,screen 0.025 center font ',13' "
      "front\n"
      "set label 6 \"%s\" at screen 0.013,screen 0.45 center rotate by 90 font ',13' front\n",
      map->axis->kind == CHART_MAP_OF_ONE_MASS ? "" : ", ω of the stiffest mode", map->axis->label);
}

/* Panels are side by side, with numbers only along the outer ones. */
static void write_position(FILE *to, uint32_t scheme) {
  uint32_t column = scheme % 3, row = scheme / 3;
  fprintf(to,
      "set lmargin at screen %g\nset rmargin at screen %g\nset tmargin at screen %g\nset bmargin at screen "
      "%g\n",
      0.085 + column * 0.3075, 0.085 + column * 0.3075 + 0.27, 0.785 - row * 0.37, 0.785 - row * 0.37 - 0.3);
  fprintf(to, "set format x '%s'\nset format y '%s'\n", row == 1 ? "%g" : "", column == 0 ? "%g" : "");
}

static void write_script(FILE *to, const chart_map *map, const chart_machine *machine, const char *output) {
  const chart_map_axis *a = map->axis;
  fprintf(to,
      "set encoding utf8\nset terminal svg size 1000,640 font 'DejaVu Sans,12' background '#ffffff'\n"
      "set output '%s'\nset logscale x\n%sset xrange [%g:%g]\nset yrange [%g:%g]\n"
      "set xtics (0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20) out nomirror\nset ytics out nomirror\n",
      output, a->logarithmic ? "set logscale y\n" : "", CHART_MAP_MIN_TURN, CHART_MAP_MAX_TURN, a->low,
      a->high);
  fprintf(to,
      "set multiplot title \"{/*1.1 {/:Bold map-%s}: %s}\\n"
      "{/*0.9 sbfmt chart --map --case %s --cells %u; %u × %u cells, %u lanes, %s, commit %s, %s}\"\n",
      a->name, a->title, a->name, map->columns * (a->kind == CHART_MAP_OF_ONE_MASS ? 1u : 2u),
      (unsigned)map->columns, (unsigned)map->rows, (unsigned)machine->lanes, machine->compiler,
      machine->commit[0] ? machine->commit : "unknown", machine->date);
  for (uint32_t s = 0; s < CHART_MAP_SCHEMES; s++) {
    if (s == 0) write_legend(to, map);
    write_position(to, s);
    write_panel(to, map, s);
    if (s == 0) fprintf(to, "unset label\nunset object\nunset arrow\n");
  }
  fprintf(to, "unset multiplot\nunset output\n");
}

sbf_status chart_map_draw(
    const chart_map *map, const chart_machine *machine, const chart_folder *folder, sbf_diagnostic *error) {
  char name[64], path[4400], *script = NULL;
  size_t size = 0;
  snprintf(name, sizeof name, "map-%s.svg", map->axis->name);
  if (!chart_folder_file(folder, name, path, sizeof path) || strpbrk(path, "'\n"))
    return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, name,
        "gnuplot takes no path with quotes or ends of line in it: name another folder");
  system_memory_stream stream;
  FILE *memory = system_memory_stream_open(&stream);
  if (memory) write_script(memory, map, machine, path);
  script = system_memory_stream_close(&stream, &size);
  sbf_status status = script ? chart_gnuplot(script, size, name, error)
                             : fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a drawing");
  free(script);
  return status;
}
