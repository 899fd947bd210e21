#include "chart_maps.h"

#include <stdio.h>
#include <stdlib.h>

#include "chart/stability_map.h"

/* Tables first: where gnuplot is not there they stay. */
static int write_maps(
    cli_call *call, const chart_map *maps, const chart_machine *machine, const char *path, bool drawn) {
  chart_folder folder;
  sbf_diagnostic error, undrawn;
  sbf_status status = chart_folder_begin(&folder, path, &error), drawing = SBF_OK;
  for (uint32_t i = 0; status == SBF_OK && i < chart_map_count; i++)
    status = chart_map_table(&maps[i], machine, &folder, &error);
  for (uint32_t i = 0; status == SBF_OK && drawn && drawing == SBF_OK && i < chart_map_count; i++)
    drawing = chart_map_draw(&maps[i], machine, &folder, &undrawn);
  if (status == SBF_OK) status = chart_folder_commit(&folder, &error);
  chart_folder_abandon(&folder);
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  if (drawing != SBF_OK) cli_print_diagnostic(call, &undrawn);
  return status != SBF_OK ? (int)status : (int)drawing;
}

static int report(const cli_call *call, const chart_map *maps, const char *path, int status) {
  json_t *list = json_array();
  for (uint32_t i = 0; i < chart_map_count; i++)
    for (uint32_t s = 0; s < CHART_MAP_SCHEMES; s++) {
      int counts[4];
      for (int k = 0; k < 4; k++) counts[k] = (int)chart_map_tally(&maps[i], s, (chart_outcome)k);
      const char *scheme = sbf_scheme_name(chart_map_schemes[s]);
      json_array_append_new(list, json_pack("{s:s, s:s, s:s, s:i, s:i, s:i, s:i}", "map", maps[i].axis->name,
                                      "model", "springs", "scheme", scheme, "sound", counts[0], "biased",
                                      counts[1], "dead", counts[2], "refused", counts[3]));
      if (!call->json && status == SBF_OK)
        printf("%s, %s: %d sound, %d biased, %d dead, %d refused\n", maps[i].axis->name, scheme, counts[0],
            counts[1], counts[2], counts[3]);
    }
  if (call->json) return cli_print_json(json_pack("{s:s, s:o}", "folder", path, "maps", list), status);
  json_decref(list);
  if (status == SBF_OK) printf("in %s\n", path);
  return status;
}

int chart_maps_run(cli_call *call) {
  long columns = 48;
  const char *path = cli_value(call, "-o");
  if (call->input_count) return cli_wrong(call, "--map is of known bodies and takes no file");
  if (cli_value(call, "--case") || cli_switch(call, "--jobs"))
    return cli_wrong(call, "--map takes neither --case nor --jobs: it draws all maps within a minute");
  if (!cli_integer(call, "--cells", 2, 400, &columns)) return SBF_FAILED;
  if (!path) return cli_wrong(call, "say where to: -o DIR");
  sbf_diagnostic error;
  sbf_status status = chart_folder_check(path, &error);
  chart_map *maps = calloc(chart_map_count, sizeof *maps);
  if (!maps) return cli_wrong(call, "memory ran out");
  for (uint32_t i = 0; status == SBF_OK && i < chart_map_count; i++)
    status =
        chart_map_fill(&maps[i], i, (uint32_t)columns, (uint32_t)(columns + 1) / 2, cli_progress, &error);
  cli_progress_end();
  int result = (int)status;
  if (status != SBF_OK) {
    cli_print_diagnostic(call, &error);
  } else {
    const chart_machine machine = chart_this_machine();
    result = report(call, maps, path, write_maps(call, maps, &machine, path, !cli_switch(call, "--no-svg")));
  }
  for (uint32_t i = 0; i < chart_map_count; i++) free(maps[i].verdicts);
  free(maps);
  return result;
}
