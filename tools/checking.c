#include "checking.h"

#include <stdlib.h>
#include <string.h>

enum { LOAD_FINDINGS = 100 }; /* limit for a file that does not load */

void findings_add(findings *to, const sbf_diagnostic *diagnostic) {
  if (to->count == to->capacity) {
    size_t capacity = to->capacity ? to->capacity * 2 : 16;
    sbf_diagnostic *grown = realloc(to->at, capacity * sizeof *grown);
    if (!grown) {
      to->lost = true;
      return;
    }
    to->at = grown;
    to->capacity = capacity;
  }
  to->at[to->count++] = *diagnostic;
}

void findings_take(void *user, const sbf_diagnostic *diagnostic) {
  findings_add(user, diagnostic);
}

void findings_free(findings *f) {
  free(f->at);
  *f = (findings){NULL, 0, 0, false};
}

static sbf_status load(checked *result, sbf_asset **asset) {
  sbf_diagnostic *found = calloc(LOAD_FINDINGS, sizeof *found);
  sbf_load_options loading = {.check_crc = true, .report = findings_take, .user = &result->found};
  uint32_t count = 0;
  *asset = NULL;
  if (!found) {
    result->found.lost = true;
    return SBF_FAILED;
  }
  sbf_status status = sbf_load_file_findings(result->path, &loading, asset, found, LOAD_FINDINGS, &count);
  for (uint32_t i = 0; i < count; i++) findings_add(&result->found, &found[i]);
  result->result.errors += count;
  free(found);
  return status;
}

/* Folder for image files of the asset. */
static void folder_of(const char *path, char *folder, size_t size) {
  const char *slash = strrchr(path, '/');
  size_t length = slash ? (size_t)(slash - path) : 0;
  if (slash == path) length = 1;
  snprintf(folder, size, "%.*s", (int)length, path);
}

void check_loaded(const sbf_asset *asset, const char *path, checked *result) {
  char folder[4096];
  sbf_diagnostic error;
  result->path = path;
  folder_of(path, folder, sizeof folder);
  sbf_validate_options options = {.report = findings_take, .user = &result->found, .folder = folder};
  result->status = sbf_validate(asset, &options, &result->result, &error);
  if (result->status == SBF_OK) return;
  result->result.errors++;
  findings_add(&result->found, &error);
}

void check_file(const char *path, checked *result) {
  sbf_asset *asset;
  *result = (checked){.path = path};
  result->status = load(result, &asset);
  uint32_t left_out = (uint32_t)result->found.count; /* of a newer version: a warning if it loads */
  if (result->status != SBF_OK) return;
  check_loaded(asset, path, result);
  result->result.warnings += left_out;
  sbf_asset_free(asset);
  if (result->found.count) sbf_locate_findings(path, NULL, result->found.at, (uint32_t)result->found.count);
}

bool checked_is_valid(const checked *one, bool strict) {
  return one->status == SBF_OK && one->result.errors == 0 && !(strict && one->result.warnings);
}

void checked_report(const cli_call *call, checked *one, json_t *messages) {
  for (size_t i = 0; i < one->found.count; i++) {
    sbf_diagnostic *d = &one->found.at[i];
    if (!d->file[0]) snprintf(d->file, sizeof d->file, "%s", one->path);
    if (messages)
      json_array_append_new(messages, cli_diagnostic_json(d));
    else
      cli_print_diagnostic(call, d);
  }
  cli_print_counted(call);
  if (one->found.lost) fprintf(stderr, "%s: memory ran out, some findings are not listed\n", one->path);
}
