#include "chart/drawing.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/child_pipe.h"
#include "base/fault.h"
#include "base/system.h"
#include "chart/plot_script.h"

sbf_status chart_gnuplot(const char *script, size_t size, const char *name, sbf_diagnostic *error) {
  const char *const arguments[] = {"gnuplot", "-", NULL};
  child_pipe child;
  char said[400];
  int failed = child_pipe_start(&child, arguments, false);
  if (failed == ENOENT)
    return fault_set(error, SBF_CODE_IO_CANNOT_RUN,
        "the program gnuplot, which draws charts, is not in PATH: install it (Debian: gnuplot-nox), or ask "
        "for "
        "tables alone with --no-svg");
  if (failed)
    return fault_set(error, SBF_CODE_IO_CANNOT_RUN, "gnuplot cannot be started: %s", strerror(failed));
  bool taken = child_pipe_write(&child, script, size);
  bool good = child_pipe_finish(&child, said, sizeof said);
  if (good && taken) return SBF_OK;
  return fault_set_file(
      error, SBF_CODE_IO_CANNOT_RUN, name, "gnuplot failed: %s", said[0] ? said : "it gave no reason");
}

/* Escapes text for gnuplot's single quotes. */
static bool quotable(const char *path) {
  return !strpbrk(path, "'\n");
}

static sbf_status draw_axis(const chart_sheet *sheet, chart_axis axis, const chart_machine *machine,
    const chart_folder *folder, sbf_diagnostic *error) {
  char name[128], path[4400], *script = NULL;
  size_t size = 0;
  snprintf(name, sizeof name, "%s-%s.svg", sheet->name, chart_axis_names[axis]);
  if (!chart_folder_file(folder, name, path, sizeof path) || !quotable(path))
    return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, name,
        "gnuplot takes no path with quotes or ends of line in it: name another folder");
  system_memory_stream stream;
  FILE *memory = system_memory_stream_open(&stream);
  bool good = memory && chart_plot_script(memory, sheet, axis, machine, path);
  script = system_memory_stream_close(&stream, &size);
  sbf_status status = good && script
                          ? chart_gnuplot(script, size, name, error)
                          : fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a drawing");
  free(script);
  return status;
}

sbf_status chart_draw(const chart_sheet *sheet, const chart_machine *machine, const chart_folder *folder,
    sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  for (int i = 0; status == SBF_OK && i < CHART_AXIS_COUNT; i++)
    if (sheet->axes & 1u << i) status = draw_axis(sheet, (chart_axis)i, machine, folder, error);
  return status;
}
