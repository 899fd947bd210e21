#include <stdio.h>
#include <stdlib.h>

#include "cli.h"
#include "sbfmt/io.h"
#include "sbfmt/validate.h"

enum { LOAD_FINDINGS = 100 }; /* where a file does not load, it is not asked for more */

/* What was found in one file, until it is known which lines it is about. */
typedef struct findings {
  sbf_diagnostic *at;
  size_t count, capacity;
  bool lost; /* memory ran out: counted, but not listed */
} findings;

static void add(void *user, const sbf_diagnostic *diagnostic) {
  findings *f = user;
  if (f->count == f->capacity) {
    size_t capacity = f->capacity ? f->capacity * 2 : LOAD_FINDINGS;
    sbf_diagnostic *grown = realloc(f->at, capacity * sizeof *grown);
    if (!grown) {
      f->lost = true;
      return;
    }
    f->at = grown;
    f->capacity = capacity;
  }
  f->at[f->count++] = *diagnostic;
}

static sbf_status load(findings *f, const char *path, sbf_asset **asset, sbf_validate_result *result) {
  static sbf_diagnostic found[LOAD_FINDINGS];
  sbf_load_options loading = {.check_crc = true};
  uint32_t count;
  sbf_status status = sbf_load_file_findings(path, &loading, asset, found, LOAD_FINDINGS, &count);
  for (uint32_t i = 0; i < count; i++) add(f, &found[i]);
  result->errors += count;
  return status;
}

/* Loads and checks one file; SBF_FAILED where that could not be done at all. */
static sbf_status check_file(findings *f, const char *path, sbf_validate_result *result) {
  sbf_asset *asset;
  sbf_diagnostic error;
  *result = (sbf_validate_result){0};
  f->count = 0;
  sbf_status status = load(f, path, &asset, result);
  if (status != SBF_OK) return status;
  status = sbf_validate(asset, &(sbf_validate_options){.report = add, .user = f}, result, &error);
  sbf_asset_free(asset);
  if (status != SBF_OK) {
    result->errors++;
    add(f, &error);
  }
  if (f->count) sbf_locate_findings(path, NULL, f->at, (uint32_t)f->count);
  return status;
}

/* Prints them, or adds them to `messages` where that is not NULL. */
static void tell(const cli_call *call, findings *f, const char *path, json_t *messages) {
  for (size_t i = 0; i < f->count; i++) {
    if (!f->at[i].file[0]) snprintf(f->at[i].file, sizeof f->at[i].file, "%s", path);
    if (messages)
      json_array_append_new(messages, cli_diagnostic_json(&f->at[i]));
    else
      cli_print_diagnostic(call, &f->at[i]);
  }
  if (f->lost) fprintf(stderr, "%s: memory ran out, some findings are not listed\n", path);
}

static json_t *summary(const sbf_validate_result *result, bool valid, json_t *messages) {
  return json_pack("{s:b, s:i, s:i, s:i, s:o}", "valid", valid, "errors", (int)result->errors, "warnings",
      (int)result->warnings, "infos", (int)result->infos, "messages", messages);
}

static int run(cli_call *call) {
  bool strict = cli_switch(call, "--strict");
  findings f = {0};
  json_t *messages = call->json ? json_array() : NULL;
  sbf_validate_result total = {0};
  int status = SBF_OK, bad_files = 0;
  json_t *files = json_array();
  for (int i = 0; i < call->input_count; i++) {
    sbf_validate_result result;
    sbf_status loaded = check_file(&f, call->inputs[i], &result);
    tell(call, &f, call->inputs[i], messages);
    bool valid = result.errors == 0 && !(strict && result.warnings);
    bad_files += !valid;
    if (loaded == SBF_FAILED)
      status = SBF_FAILED;
    else if (!valid && status == SBF_OK)
      status = SBF_BAD_INPUT;
    total.errors += result.errors;
    total.warnings += result.warnings;
    total.infos += result.infos;
    json_array_append_new(files, json_pack("{s:s, s:b, s:i, s:i}", "file", call->inputs[i], "valid", valid,
                                     "errors", (int)result.errors, "warnings", (int)result.warnings));
    if (!call->json)
      printf("%s: %s, %u errors, %u warnings, %u notes\n", call->inputs[i], valid ? "valid" : "not valid",
          result.errors, result.warnings, result.infos);
  }
  free(f.at);
  if (!call->json) {
    if (call->input_count > 1) printf("%d files, %d not valid\n", call->input_count, bad_files);
    json_decref(files);
    return status;
  }
  json_t *object = summary(&total, bad_files == 0, messages);
  json_object_set_new(object, "files", files);
  return cli_print_json(object, status);
}

static const cli_option options[] = {
    {"--strict", NULL, "let warnings fail as errors do"},
    {"--format", "text|json", "how to print (text)"},
    {NULL, NULL, NULL},
};
const cli_verb verb_validate = {"validate", "FILE... [--strict] [--format json]",
    "check files against all rules",
    "Every finding has a stable code, listed in spec/codes.md. Exit status 0: valid; 1: a file is not; 2: a "
    "file\n"
    "could not be read.",
    options, 1, -1, run};
