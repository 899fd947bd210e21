#include "profile_report.h"

#include <errno.h>
#include <string.h>
#include <time.h>

#include "base/fault.h"
#include "base/system.h"

double profile_now_s(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double now_for_world(void *user) {
  (void)user;
  return profile_now_s();
}

static sbf_status fault(const profile_report *p, int why, sbf_diagnostic *error) {
  return fault_set_file(error, SBF_CODE_IO_CANNOT_WRITE, p->output.given,
      "cannot write: %s; check the folder, its permissions and the free space", strerror(why));
}

/* The trace event format of chrome://tracing and Perfetto: complete events, microseconds since the run began.
 */
static bool put_span(
    const profile_report *p, const char *name, double begin_s, double duration_s, uint64_t tick) {
  return fprintf(p->file,
             ",\n{\"name\":\"%s\",\"ph\":\"X\",\"pid\":1,\"tid\":1,\"ts\":%.3f,\"dur\":%.3f,\"args\":{"
             "\"tick\":%llu}}",
             name, 1e6 * (begin_s - p->begin_s), 1e6 * duration_s, (unsigned long long)tick) > 0;
}

static bool put_begin(const profile_report *p) {
  return fputs(
             "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n"
             "{\"name\":\"process_name\",\"ph\":\"M\",\"pid\":1,\"tid\":1,\"args\":{\"name\":\"sbfmt run\"}}",
             p->file) >= 0;
}

bool profile_report_begin(profile_report *p, session *s, cli_call *call) {
  const char *trace = cli_value(call, "--trace");
  sbf_diagnostic error;
  *p = (profile_report){.shown = cli_switch(call, "--profile")};
  p->timed = p->shown || trace;
  p->begin_s = profile_now_s();
  if (p->timed) sbr_world_set_clock(s->world, (sbr_clock){now_for_world, NULL});
  if (!trace) return true;
  bool begun = output_file_begin(&p->output, trace, &error) == SBF_OK;
  if (begun) p->file = fopen(p->output.written_path, "wb");
  if (p->file && put_begin(p)) return true;
  if (begun) fault(p, errno, &error);
  cli_print_diagnostic(call, &error);
  profile_report_end(p, false, NULL);
  return false;
}

bool profile_report_measure(profile_report *p, const session *s, double skin_begin_s, sbf_diagnostic *error) {
  if (!p->timed) return true;
  const sbr_profile tick = sbr_world_get_profile(s->world);
  double skin_s = profile_now_s() - skin_begin_s;
  bool good = true, is_new = tick.tick != p->last_tick;
  p->skin_s += skin_s;
  if (is_new) {
    p->last_tick = tick.tick;
    p->tick_count++;
    p->tick_s += tick.whole.duration_s;
    for (int i = 0; i < SBR_STAGE_COUNT; i++) p->stage_s[i] += tick.stages[i].duration_s;
  }
  if (!p->file) return true;
  if (is_new) {
    good = put_span(p, "tick", tick.whole.begin_s, tick.whole.duration_s, tick.tick);
    for (int i = 0; i < SBR_STAGE_COUNT && good; i++)
      good = put_span(
          p, sbr_stage_get_name((sbr_stage)i), tick.stages[i].begin_s, tick.stages[i].duration_s, tick.tick);
  }
  good = good && put_span(p, "skin", skin_begin_s, skin_s, tick.tick);
  if (!good) fault(p, errno, error);
  return good;
}

static void add_counters(const session *s, json_t *to) {
  const sbr_counters c = sbr_world_get_counters(s->world);
  const struct {
    const char *name;
    uint64_t value;
  } rows[] = {{"soft_bodies", c.soft_body_count}, {"soft_bodies_awake", c.soft_body_awake_count},
      {"rigid_bodies", c.rigid_body_count}, {"islands", c.island_count}, {"points", c.point_count},
      {"springs", c.spring_count}, {"tetrahedra", c.tetrahedron_count}, {"contacts", c.contact_count},
      {"body_contacts", c.body_contact_count}, {"element_visits", c.element_visit_count},
      {"state_bytes", c.state_bytes}, {"memory_bytes", c.memory_bytes}};
  json_t *counters = json_object();
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    json_object_set_new(counters, rows[i].name, json_integer((json_int_t)rows[i].value));
  json_object_set_new(to, "counters", counters);
}

void profile_report_add(const profile_report *p, const session *s, json_t *to) {
  if (!p->shown) return;
  double us = p->tick_count ? 1e6 / (double)p->tick_count : 0;
  json_t *profile = json_object();
  json_object_set_new(profile, "tick", json_real(us * p->tick_s));
  for (int i = 0; i < SBR_STAGE_COUNT; i++)
    json_object_set_new(profile, sbr_stage_get_name((sbr_stage)i), json_real(us * p->stage_s[i]));
  json_object_set_new(profile, "skin", json_real(us * p->skin_s));
  json_object_set_new(to, "profile", profile);
  add_counters(s, to);
}

sbf_status profile_report_end(profile_report *p, bool keep, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  if (p->file) {
    bool good = !keep || fputs("\n]}\n", p->file) >= 0;
    good = fflush(p->file) == 0 && (p->output.direct || system_sync_file(p->file)) && good;
    int why = errno;
    if (fclose(p->file) != 0 && good) good = false, why = errno;
    if (keep && !good) status = fault(p, why, error);
    if (keep && good) status = output_file_commit(&p->output, error);
  }
  output_file_abandon(&p->output);
  p->file = NULL;
  return status;
}
