#include "chart_maps.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chart/stability_map.h"

/* Requested maps and their resolution. */
typedef struct wanted {
  uint32_t *numbers, count;
  long columns;
} wanted;

/* Tables first: they stay if gnuplot is missing. */
static int write_maps(cli_call *call, const chart_map *maps, uint32_t count, const chart_machine *machine,
    const char *path, bool drawn) {
  chart_folder folder;
  sbf_diagnostic error, undrawn;
  sbf_status status = chart_folder_begin(&folder, path, &error), drawing = SBF_OK;
  for (uint32_t i = 0; status == SBF_OK && i < count; i++)
    status = chart_map_table(&maps[i], machine, &folder, &error);
  for (uint32_t i = 0; status == SBF_OK && drawn && drawing == SBF_OK && i < count; i++)
    drawing = chart_map_draw(&maps[i], machine, &folder, &undrawn);
  if (status == SBF_OK) status = chart_folder_commit(&folder, &error);
  chart_folder_abandon(&folder);
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  if (drawing != SBF_OK) cli_print_diagnostic(call, &undrawn);
  return status != SBF_OK ? (int)status : (int)drawing;
}

static int report(const cli_call *call, const chart_map *maps, uint32_t count, const char *path, int status) {
  json_t *list = json_array();
  for (uint32_t i = 0; i < count; i++)
    for (uint32_t s = 0; s < CHART_MAP_SCHEMES; s++) {
      int counts[4];
      for (int k = 0; k < 4; k++) counts[k] = (int)chart_map_tally(&maps[i], s, (chart_outcome)k);
      const char *scheme = sbf_scheme_name(chart_map_schemes[s]);
      json_array_append_new(
          list, json_pack("{s:s, s:s, s:s, s:i, s:i, s:i, s:i}", "map", maps[i].axis->name, "model",
                    chart_elastic_names[maps[i].axis->elastic], "scheme", scheme, "sound", counts[0],
                    "biased", counts[1], "dead", counts[2], "refused", counts[3]));
      if (!call->json && status == SBF_OK)
        printf("%s, %s: %d sound, %d biased, %d dead, %d refused\n", maps[i].axis->name, scheme, counts[0],
            counts[1], counts[2], counts[3]);
    }
  if (call->json) return cli_print_json(json_pack("{s:s, s:o}", "folder", path, "maps", list), status);
  json_decref(list);
  if (status == SBF_OK) printf("in %s\n", path);
  return status;
}

/* The maps in --case, or all. */
static bool choose(cli_call *call, wanted *w) {
  int at = 0;
  const char *name;
  w->numbers = calloc(chart_map_count, sizeof *w->numbers);
  if (!w->numbers) return cli_wrong(call, "memory ran out"), false;
  while ((name = cli_next_value(call, "--case", &at)) != NULL) {
    uint32_t found = chart_map_named(name);
    bool known = false;
    for (uint32_t i = 0; i < w->count; i++) known = known || w->numbers[i] == found;
    if (found < chart_map_count && !known) w->numbers[w->count++] = found;
    if (found < chart_map_count) continue;
    fprintf(stderr, "sbfmt chart: error: --map --case takes one of");
    for (uint32_t i = 0; i < chart_map_count; i++)
      fprintf(stderr, "%s %s", i ? "," : "", chart_map_axes[i].name);
    fprintf(stderr, ", not '%s'\n", name);
    return false;
  }
  for (uint32_t i = 0; !cli_value(call, "--case") && i < chart_map_count; i++) w->numbers[w->count++] = i;
  w->columns = 48;
  return cli_integer(call, "--cells", 2, 400, &w->columns);
}

static int fill(cli_call *call, const wanted *w, const char *path) {
  sbf_diagnostic error;
  sbf_status status = chart_folder_check(path, &error);
  chart_map *maps = calloc(chart_map_count, sizeof *maps);
  if (!maps) return cli_wrong(call, "memory ran out");
  uint32_t columns = (uint32_t)w->columns;
  for (uint32_t i = 0; status == SBF_OK && i < w->count; i++)
    status = chart_map_fill(&maps[i], w->numbers[i], columns, (columns + 1) / 2, cli_progress, &error);
  cli_progress_end();
  int result = (int)status;
  if (status != SBF_OK) {
    cli_print_diagnostic(call, &error);
  } else {
    const chart_machine machine = chart_this_machine();
    result = write_maps(call, maps, w->count, &machine, path, !cli_switch(call, "--no-svg"));
    result = report(call, maps, w->count, path, result);
  }
  for (uint32_t i = 0; i < w->count; i++) free(maps[i].verdicts);
  free(maps);
  return result;
}

/* One line per map, so that a batch can run them in parallel. */
static int print_jobs(const cli_call *call, const wanted *w, const char *path) {
  for (uint32_t i = 0; i < w->count; i++)
    printf("sbfmt chart --map --case %s --cells %ld%s -o '%s'\n", chart_map_axes[w->numbers[i]].name,
        w->columns, cli_switch(call, "--no-svg") ? " --no-svg" : "", path ? path : "charts");
  return SBF_OK;
}

int chart_maps_run(cli_call *call) {
  const char *path = cli_value(call, "-o");
  wanted w = {.count = 0};
  if (call->input_count) return cli_wrong(call, "--map is of known bodies and takes no file");
  int result = SBF_FAILED;
  if (choose(call, &w)) {
    if (cli_switch(call, "--jobs"))
      result = print_jobs(call, &w, path);
    else
      result = path ? fill(call, &w, path) : cli_wrong(call, "state the output folder: -o DIR");
  }
  free(w.numbers);
  return result;
}
