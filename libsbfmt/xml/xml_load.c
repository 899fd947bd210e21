/* Loads XML: reads, resolves references, checks; on errors finds their lines. */
#include <string.h>

#include "base/diagnostic.h"
#include "model/asset_box.h"
#include "model/check.h"
#include "model/options.h"
#include "xml/xml_reader.h"

static void add_finding(void *user, const sbf_diagnostic *diagnostic) {
  sbfi_xml_findings *findings = user;
  if (findings->count < findings->capacity) findings->at[findings->count++] = *diagnostic;
}

static void add_out_of_memory(sbfi_xml_findings *findings) {
  sbf_diagnostic diagnostic;
  sbfi_diagnose(&diagnostic, SBF_CODE_OUT_OF_MEMORY, "memory ran out while the file was read");
  add_finding(findings, &diagnostic);
}

/* Repeated ids are reported before unresolved references to the ids that they displaced. */
typedef struct repeated_ids {
  sbfi_xml_findings *findings;
  uint32_t count;
} repeated_ids;

static void add_repeated_id(void *user, const sbf_diagnostic *diagnostic) {
  repeated_ids *repeated = user;
  sbfi_xml_findings *findings = repeated->findings;
  if (diagnostic->code != SBF_CODE_ID_REPEATED || repeated->count == findings->capacity) return;
  if (findings->count < findings->capacity) findings->count++;
  sbf_diagnostic *at = &findings->at[repeated->count];
  memmove(at + 1, at, (findings->count - ++repeated->count) * sizeof *at);
  *at = *diagnostic;
}

/* Adds findings of each step; skips a step if an earlier one failed. */
static void read_into(const sbfi_xml_source *source, const sbf_load_options *options, sbf_asset *asset,
    sbfi_xml_findings *findings) {
  sbfi_array refs;
  sbf_diagnostic error;
  sbfi_array_init(&refs, &sbfi_asset_box_of(asset)->arena.allocator, sizeof(const char *));
  if (sbfi_xml_read_tree(source, options, asset, &refs, &error) != SBF_OK)
    add_finding(findings, &error);
  else if (!sbfi_xml_resolve_refs(asset, &refs, findings))
    add_out_of_memory(findings);
  else if (findings->count)
    sbfi_check_structure(asset, options, add_repeated_id, &(repeated_ids){findings, 0}, UINT32_MAX);
  sbfi_array_free(&refs);
  if (!findings->count) sbfi_check_structure(asset, options, add_finding, findings, findings->capacity);
  if (!findings->count && sbfi_check_extensions(asset, options, &error) != SBF_OK)
    add_finding(findings, &error);
}

static sbf_status refuse_size(const sbf_load_options *options, sbfi_xml_findings *findings) {
  sbf_diagnostic diagnostic;
  sbf_status status = sbfi_diagnose(&diagnostic, SBF_CODE_IO_TOO_LARGE,
      "the input is larger than the limit of %llu bytes: raise the limit if it is trusted",
      (unsigned long long)options->limits.file_bytes);
  add_finding(findings, &diagnostic);
  return status;
}

sbf_status sbfi_xml_read(const sbfi_xml_source *source, const sbf_load_options *options,
    sbfi_xml_findings *findings, sbf_asset **asset) {
  *asset = NULL;
  findings->count = 0;
  if (source->size > options->limits.file_bytes) return refuse_size(options, findings);
  sbf_asset *made = sbf_asset_create(options->allocator);
  if (!made) {
    add_out_of_memory(findings);
    return SBF_FAILED;
  }
  sbfi_arena *arena = &sbfi_asset_box_of(made)->arena;
  sbf_allocator allocator = arena->allocator;
  arena->limit_bytes =
      options->limits.memory_bytes < SIZE_MAX ? (size_t)options->limits.memory_bytes : SIZE_MAX;
  read_into(source, options, made, findings);
  if (!findings->count) {
    arena->limit_bytes = 0; /* the limit applies to the file's content, not to what the caller adds later */
    *asset = made;
    return SBF_OK;
  }
  sbf_asset_free(made);
  sbfi_xml_locate(source, &allocator, findings);
  return sbf_code_find(findings->at[0].code)->fault;
}

/* A file opened as a source. */
typedef struct opened {
  sbfi_xml_source source;
  sbfi_file file;
  sbfi_file_content content;
} opened;

/* A file that can be mapped can be read in pieces, and twice. It is not kept mapped, because an editor
 * that truncates it would crash the program. Other files, such as pipes, are read completely. */
static sbf_status open_source(
    opened *o, const char *path, const sbf_load_options *options, sbf_diagnostic *error) {
  sbf_status status = sbfi_file_map(path, options->limits.file_bytes, options->allocator, &o->content, error);
  if (status != SBF_OK) return status;
  o->file.handle = -1;
  o->source = (sbfi_xml_source){.bytes = o->content.at, .size = o->content.size};
  if (o->content.allocated_bytes || !o->content.size) return SBF_OK;
  sbfi_file_content_free(&o->content);
  status = sbfi_file_open(path, &o->file, error);
  o->source = (sbfi_xml_source){.file = &o->file, .size = o->file.size};
  return status;
}

static void close_source(opened *o) {
  sbfi_file_content_free(&o->content);
  sbfi_file_close(&o->file);
}

static void name_findings(const sbfi_xml_findings *findings, const char *name) {
  for (uint32_t i = 0; name && i < findings->count; i++)
    sbfi_copy_text(findings->at[i].file, sizeof findings->at[i].file, name);
}

sbf_status sbf_xml_load_memory(const void *bytes, size_t size, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *error) {
  sbf_load_options filled = sbfi_load_options_of(options);
  const sbfi_xml_source source = {.bytes = bytes, .size = size};
  sbf_diagnostic first;
  sbfi_xml_findings findings = {&first, 1, 0};
  sbf_status status = sbfi_xml_read(&source, &filled, &findings, asset);
  name_findings(&findings, filled.name);
  if (status != SBF_OK && error) *error = first;
  return status;
}

sbf_status sbfi_xml_read_file(
    const char *path, const sbf_load_options *options, sbfi_xml_findings *findings, sbf_asset **asset) {
  sbf_load_options filled = sbfi_load_options_of(options);
  sbf_diagnostic error;
  opened o;
  *asset = NULL;
  findings->count = 0;
  sbf_status status = open_source(&o, path, &filled, &error);
  if (status != SBF_OK) {
    add_finding(findings, &error);
    return status;
  }
  status = sbfi_xml_read(&o.source, &filled, findings, asset);
  name_findings(findings, path);
  close_source(&o);
  return status;
}

sbf_status sbf_xml_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  sbf_diagnostic first;
  sbfi_xml_findings findings = {&first, 1, 0};
  sbf_status status = sbfi_xml_read_file(path, options, &findings, asset);
  if (status != SBF_OK && error) *error = first;
  return status;
}

void sbf_locate_findings(
    const char *path, const sbf_load_options *options, sbf_diagnostic *findings, uint32_t count) {
  sbf_load_options filled = sbfi_load_options_of(options);
  sbfi_xml_findings all = {findings, count, count};
  opened o;
  if (open_source(&o, path, &filled, NULL) != SBF_OK) return;
  sbf_allocator allocator = sbfi_allocator_or_default(filled.allocator);
  sbfi_xml_locate(&o.source, &allocator, &all);
  close_source(&o);
}
