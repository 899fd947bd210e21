/* sbfmt validate: reports findings of files in parallel, and repairs. */
#include <pthread.h>
#include <stdlib.h>

#include "base/system.h"
#include "checking.h"
#include "file_list.h"
#include "output_name.h"
#include "thread_pool.h"

enum { BATCH = 64 }; /* files whose findings are in memory at a time */

typedef struct batch {
  char **paths;
  checked *results;
  size_t done, all; /* number of files, over all batches */
  pthread_mutex_t mutex;
} batch;

static void check_one(void *context, uint32_t number) {
  batch *b = context;
  check_file(b->paths[number], &b->results[number]);
  pthread_mutex_lock(&b->mutex);
  if (b->all > 1) cli_progress("validating", (double)++b->done / (double)b->all);
  pthread_mutex_unlock(&b->mutex);
}

typedef struct totals {
  sbf_validate_result found;
  size_t files, bad_files;
  int status;
} totals;

static void add(totals *t, const checked *one, bool strict) {
  bool valid = checked_is_valid(one, strict);
  t->files++;
  t->bad_files += !valid;
  if (one->status == SBF_FAILED)
    t->status = SBF_FAILED;
  else if (!valid && t->status == SBF_OK)
    t->status = SBF_BAD_INPUT;
  t->found.errors += one->result.errors;
  t->found.warnings += one->result.warnings;
  t->found.infos += one->result.infos;
}

static json_t *file_json(const checked *one, bool strict) {
  return json_pack("{s:s, s:b, s:i, s:i, s:i}", "file", one->path, "valid", checked_is_valid(one, strict),
      "errors", (int)one->result.errors, "warnings", (int)one->result.warnings, "infos",
      (int)one->result.infos);
}

static void print_counts(const sbf_validate_result *r) {
  printf("%u error%s, %u warning%s, %u note%s\n", r->errors, r->errors == 1 ? "" : "s", r->warnings,
      r->warnings == 1 ? "" : "s", r->infos, r->infos == 1 ? "" : "s");
}

static void report_progress(
    const cli_call *call, checked *one, bool strict, json_t *messages, json_t *files) {
  checked_report(call, one, messages);
  if (call->json) {
    json_array_append_new(files, file_json(one, strict));
  } else {
    printf("%s: %s, ", one->path, checked_is_valid(one, strict) ? "valid" : "not valid");
    print_counts(&one->result);
  }
}

static json_t *report_json(const totals *t, json_t *messages, json_t *files) {
  return json_pack("{s:b, s:i, s:i, s:i, s:o, s:o}", "valid", t->bad_files == 0, "errors",
      (int)t->found.errors, "warnings", (int)t->found.warnings, "infos", (int)t->found.infos, "messages",
      messages, "files", files);
}

static int finish(const cli_call *call, const totals *t, json_t *messages, json_t *files) {
  if (call->json) return cli_print_json(report_json(t, messages, files), t->status);
  if (t->files > 1) {
    printf("%zu files, %zu not valid: ", t->files, t->bad_files);
    print_counts(&t->found);
  }
  return t->status;
}

static int validate(const cli_call *call, const file_list *list, thread_pool *pool) {
  bool strict = cli_switch(call, "--strict");
  json_t *messages = call->json ? json_array() : NULL, *files = call->json ? json_array() : NULL;
  checked *results = calloc(BATCH, sizeof *results);
  sbr_tasks tasks = thread_pool_tasks(pool);
  totals t = {.status = SBF_OK};
  batch b = {.results = results, .all = list->count, .mutex = PTHREAD_MUTEX_INITIALIZER};
  if (!results) {
    json_decref(messages);
    json_decref(files);
    return cli_wrong(call, "out of memory");
  }
  for (size_t begin = 0; begin < list->count; begin += BATCH) {
    uint32_t count = (uint32_t)(list->count - begin < BATCH ? list->count - begin : BATCH);
    b.paths = list->paths + begin;
    for (uint32_t i = 0; i < count && !tasks.run; i++) check_one(&b, i);
    if (tasks.run) tasks.run(tasks.user, check_one, &b, count);
    cli_progress_end();
    for (uint32_t i = 0; i < count; i++) {
      report_progress(call, &results[i], strict, messages, files);
      add(&t, &results[i], strict);
      findings_free(&results[i].found);
    }
  }
  free(results);
  return finish(call, &t, messages, files);
}

/* Reports the repairs of a file and the remaining findings of the written one. */
typedef struct repaired {
  findings done;
  checked left;
} repaired;

/* Repairs made during the load count as repairs. */
static void take_loading(void *user, const sbf_diagnostic *diagnostic) {
  repaired *m = user;
  findings_add(diagnostic->code == SBF_CODE_GLTF_RENUMBERED ? &m->done : &m->left.found, diagnostic);
}

/* Loads a file even if its only errors can be repaired. */
static sbf_status load_for_repair(const char *path, sbf_asset **asset, repaired *m) {
  sbf_load_options loading = {.check_crc = true, .repairable = true, .report = take_loading, .user = m};
  checked *refused = &m->left;
  sbf_diagnostic error;
  sbf_status status = sbf_load_file(path, &loading, asset, &error);
  if (status == SBF_OK) return SBF_OK;
  findings_free(&refused->found);
  check_file(path, refused); /* lists all findings, as without --fix */
  return status;
}

static sbf_status repair(const char *from, const char *to, repaired *m, sbf_diagnostic *error) {
  sbf_asset *asset, *fixed;
  sbf_fix_options options = {.report = findings_take, .user = &m->done};
  sbf_status status = load_for_repair(from, &asset, m);
  if (status != SBF_OK) return status;
  uint32_t left_out = (uint32_t)m->left.found.count; /* of a newer version */
  status = sbf_fix(asset, &options, &fixed, NULL, error);
  sbf_asset_free(asset);
  if (status != SBF_OK) {
    findings_add(&m->left.found, error);
    m->left.result.errors++;
    sbf_locate_findings(from, NULL, m->left.found.at, (uint32_t)m->left.found.count);
    return status;
  }
  if (m->done.count) sbf_locate_findings(from, NULL, m->done.at, (uint32_t)m->done.count);
  check_loaded(fixed, to, &m->left);
  m->left.result.warnings += left_out;
  status = sbf_save_file(fixed, to, NULL, error);
  sbf_asset_free(fixed);
  if (status != SBF_OK) {
    findings_add(&m->left.found, error);
    m->left.result.errors++;
  } else if (m->left.found.count) {
    sbf_locate_findings(to, NULL, m->left.found.at, (uint32_t)m->left.found.count);
  }
  return status;
}

static json_t *repaired_json(const cli_call *call, const repaired *m, const char *from) {
  json_t *list = json_array();
  for (size_t i = 0; i < m->done.count; i++) {
    sbf_diagnostic *d = &m->done.at[i];
    snprintf(d->file, sizeof d->file, "%s", from);
    if (call->json)
      json_array_append_new(list, cli_diagnostic_json(d));
    else
      printf("%s%s%s: %s [%s]\n", from, d->path[0] ? " " : "", d->path, d->message,
          sbf_code_find(d->code)->name);
  }
  return list;
}

static int fix(const cli_call *call, const char *from, const char *to) {
  bool strict = cli_switch(call, "--strict");
  sbf_diagnostic error;
  repaired m = {.left = {.path = from}};
  json_t *messages = call->json ? json_array() : NULL, *files = call->json ? json_array() : NULL;
  m.left.status = repair(from, to, &m, &error);
  bool written = m.left.status == SBF_OK;
  if (!written) findings_free(&m.done); /* repairs of a file that is not there */
  json_t *done = repaired_json(call, &m, from);
  totals t = {.status = SBF_OK};
  report_progress(call, &m.left, strict, messages, files);
  add(&t, &m.left, strict);
  findings_free(&m.done);
  findings_free(&m.left.found);
  if (!call->json) {
    json_decref(done);
    return t.status;
  }
  json_t *report = report_json(&t, messages, files);
  json_object_set_new(report, "fixed", done);
  if (written) json_object_set_new(report, "output", json_string(to));
  return cli_print_json(report, t.status);
}

static int run_fix(const cli_call *call) {
  const char *to = cli_value(call, "-o");
  if (!to) return cli_wrong(call, "--fix needs -o OUT: it does not change the input");
  if (call->input_count != 1) return cli_wrong(call, "--fix repairs one file at a time");
  if (!output_name_of_bundle(call, "-o")) return SBF_FAILED;
  return fix(call, call->inputs[0], to);
}

static int run(cli_call *call) {
  file_list list = {NULL, 0, 0};
  long threads = system_processor_count();
  int status = SBF_FAILED;
  if (cli_switch(call, "--fix")) return run_fix(call);
  if (cli_value(call, "-o")) return cli_wrong(call, "-o is for --fix");
  if (threads > 64) threads = 64;
  if (!cli_integer(call, "--threads", 1, 64, &threads)) return SBF_FAILED;
  bool listed = true;
  for (int i = 0; i < call->input_count && listed; i++) listed = file_list_add(&list, call->inputs[i]);
  if (listed && list.count == 0) {
    status = cli_wrong(call, "there is no .sbf or .sbfz in %s", call->inputs[0]);
  } else if (listed) {
    uint32_t useful = list.count < (size_t)threads ? (uint32_t)list.count : (uint32_t)threads;
    thread_pool *pool = thread_pool_create(useful); /* without one, files are checked one by one */
    status = validate(call, &list, pool);
    thread_pool_destroy(pool);
  }
  file_list_free(&list);
  return status;
}

static const cli_option options[] = {
    {"--strict", NULL, "treat warnings as errors"},
    {"--fix", NULL, "make repairs that have one right answer, and write the result"},
    {"-o", "OUT.sbf[z]", "output of --fix; the ending selects XML or packed"},
    {"--threads", "N", "files checked at the same time (number of processors)"},
    {"--format", "text|json", "how to print (text)"},
    {NULL, NULL, NULL},
};
const cli_verb verb_validate = {"validate", "FILE|FOLDER... [--strict] [--fix -o OUT] [--format json]",
    "check files against all rules",
    "A folder stands for every .sbf and .sbfz in it and below. Every finding has a stable\n"
    "code, listed in spec/codes.md. With --fix, the findings that remain in the written file\n"
    "are printed. Exit status 0: all files are valid; 1: a file is not; 2: a file could not\n"
    "be read.",
    options, 1, -1, run};
