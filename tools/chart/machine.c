#include "chart/machine.h"

#include <math.h>
#include <string.h>
#include <time.h>

#include "base/system.h"
#include "sbfmt_commit.h"
#include "sbrun/sbrun.h"

/* Writes a CSV field without characters that would end it. */
static void clean(char *text) {
  for (char *at = text; *at; at++)
    if (*at == ',' || *at == '"' || *at == '\n') *at = ' ';
  for (size_t end = strlen(text); end && text[end - 1] == ' ';) text[--end] = 0;
}

static void find_processor(char *to, size_t size) {
  char line[256];
  FILE *file = fopen("/proc/cpuinfo", "r");
  snprintf(to, size, "unknown");
  while (file && fgets(line, sizeof line, file)) {
    const char *colon = strchr(line, ':');
    if (strncmp(line, "model name", 10) != 0 || !colon) continue;
    snprintf(to, size, "%s", colon + 2);
    break;
  }
  if (file) fclose(file);
}

static const char *compiler(void) {
#ifdef __clang__
  return "clang " __clang_version__;
#elif defined __GNUC__
  return "gcc " __VERSION__;
#else
  return "unknown";
#endif
}

chart_machine chart_this_machine(void) {
  chart_machine m = {.lanes = sbr_get_lane_count()};
  time_t now = time(NULL);
  snprintf(m.commit, sizeof m.commit, "%s", SBFMT_COMMIT);
  snprintf(m.compiler, sizeof m.compiler, "%s", compiler());
  find_processor(m.processor, sizeof m.processor);
  strftime(m.date, sizeof m.date, "%Y-%m-%d", gmtime(&now));
  m.load = system_load();
  clean(m.commit), clean(m.compiler), clean(m.processor);
  return m;
}

void chart_machine_write(FILE *to, const chart_machine *m) {
  fprintf(to, "%s,%s,%u,%s,%s,", m->commit, m->compiler, (unsigned)m->lanes, m->processor, m->date);
  if (isfinite(m->load)) fprintf(to, "%.2f", m->load);
}
