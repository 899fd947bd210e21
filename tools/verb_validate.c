#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#include "checking.h"
#include "file_list.h"
#include "thread_pool.h"

enum { BATCH = 64 }; /* files whose findings are in memory at one time */

typedef struct batch {
  char **paths;
  checked *results;
  size_t done, all; /* files, of all batches */
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

static void tell(const cli_call *call, checked *one, bool strict, json_t *messages, json_t *files) {
  checked_tell(call, one, messages);
  if (call->json) {
    json_array_append_new(files, file_json(one, strict));
  } else {
    printf("%s: %s, ", one->path, checked_is_valid(one, strict) ? "valid" : "not valid");
    print_counts(&one->result);
  }
}

static int finish(const cli_call *call, const totals *t, json_t *messages, json_t *files) {
  if (call->json)
    return cli_print_json(json_pack("{s:b, s:i, s:i, s:i, s:o, s:o}", "valid", t->bad_files == 0, "errors",
                              (int)t->found.errors, "warnings", (int)t->found.warnings, "infos",
                              (int)t->found.infos, "messages", messages, "files", files),
        t->status);
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
      tell(call, &results[i], strict, messages, files);
      add(&t, &results[i], strict);
      findings_free(&results[i].found);
    }
  }
  free(results);
  return finish(call, &t, messages, files);
}

static int run(cli_call *call) {
  file_list list = {NULL, 0, 0};
  long threads = sysconf(_SC_NPROCESSORS_ONLN);
  int status = SBF_FAILED;
  if (threads < 1) threads = 1;
  if (threads > 64) threads = 64;
  if (!cli_integer(call, "--threads", 1, 64, &threads)) return SBF_FAILED;
  bool listed = true;
  for (int i = 0; i < call->input_count && listed; i++) listed = file_list_add(&list, call->inputs[i]);
  if (listed && list.count == 0) {
    status = cli_wrong(call, "no .sbf or .sbfz lies in %s", call->inputs[0]);
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
    {"--strict", NULL, "let warnings fail as errors do"},
    {"--threads", "N", "files checked at one time (as many as there are processors)"},
    {"--format", "text|json", "how to print (text)"},
    {NULL, NULL, NULL},
};
const cli_verb verb_validate = {"validate", "FILE|FOLDER... [--strict] [--format json]",
    "check files against all rules",
    "Of a folder, every .sbf and .sbfz in it and below is checked. Every finding has a stable code, listed "
    "in\n"
    "spec/codes.md. Exit status 0: all are valid; 1: a file is not; 2: a file could not be read.",
    options, 1, -1, run};
