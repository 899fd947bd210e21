#include <string.h>

#include "cli.h"
#include "sbfmt/io.h"
#include "sbfmt/validate.h"

typedef struct findings {
  const cli_call *call;
  const char *file;
  json_t *messages; /* NULL: print */
} findings;

static void add(void *user, const sbf_diagnostic *diagnostic) {
  findings *f = user;
  sbf_diagnostic named = *diagnostic;
  if (!named.file[0]) snprintf(named.file, sizeof named.file, "%s", f->file);
  if (f->messages)
    json_array_append_new(f->messages, cli_diagnostic_json(&named));
  else
    cli_print_diagnostic(f->call, &named);
}

/* Loads and checks one file; SBF_FAILED where that could not be done at all. */
static sbf_status check_file(findings *f, const char *path, sbf_validate_result *result) {
  sbf_asset *asset;
  sbf_diagnostic error;
  f->file = path;
  *result = (sbf_validate_result){0};
  sbf_status status = sbf_load_file(path, &(sbf_load_options){.check_crc = true}, &asset, &error);
  if (status == SBF_OK) {
    status = sbf_validate(asset, &(sbf_validate_options){.report = add, .user = f}, result, &error);
    sbf_asset_free(asset);
  }
  if (status != SBF_OK) {
    result->errors++;
    add(f, &error);
  }
  return status;
}

static json_t *summary(const sbf_validate_result *result, bool valid, json_t *messages) {
  return json_pack("{s:b, s:i, s:i, s:i, s:o}", "valid", valid, "errors", (int)result->errors, "warnings",
      (int)result->warnings, "infos", (int)result->infos, "messages", messages);
}

static int run(cli_call *call) {
  bool strict = cli_switch(call, "--strict");
  findings f = {.call = call};
  sbf_validate_result total = {0};
  int status = SBF_OK, bad_files = 0;
  json_t *files = json_array();
  if (call->json) f.messages = json_array();
  for (int i = 0; i < call->input_count; i++) {
    sbf_validate_result result;
    sbf_status loaded = check_file(&f, call->inputs[i], &result);
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
  if (!call->json) {
    if (call->input_count > 1) printf("%d files, %d not valid\n", call->input_count, bad_files);
    json_decref(files);
    return status;
  }
  json_t *object = summary(&total, bad_files == 0, f.messages);
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
