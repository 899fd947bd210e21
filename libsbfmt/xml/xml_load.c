/* Loading XML: read, resolve, check; and where something is wrong, find its line. */
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

/* Adds what is wrong, step by step: a later step is not asked about what an earlier one could not make. */
static void read_into(const sbfi_xml_source *source, const sbf_load_options *options, sbf_asset *asset,
    sbfi_xml_findings *findings) {
  sbfi_array refs;
  sbf_diagnostic error;
  sbfi_array_init(&refs, &sbfi_asset_box_of(asset)->arena.allocator, sizeof(const char *));
  if (sbfi_xml_read_tree(source, options, asset, &refs, &error) != SBF_OK)
    add_finding(findings, &error);
  else if (!sbfi_xml_resolve_refs(asset, &refs, findings))
    add_out_of_memory(findings);
  sbfi_array_free(&refs);
  if (!findings->count) sbf_asset_check(asset, add_finding, findings, findings->capacity);
  if (!findings->count && sbfi_check_extensions(asset, options, &error) != SBF_OK)
    add_finding(findings, &error);
}

sbf_status sbfi_xml_read(const sbfi_xml_source *source, const sbf_load_options *options,
    sbfi_xml_findings *findings, sbf_asset **asset) {
  sbf_asset *made = sbf_asset_create(options->allocator);
  *asset = NULL;
  findings->count = 0;
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
    arena->limit_bytes = 0; /* it bounds what a file may ask for, not what the caller adds */
    *asset = made;
    return SBF_OK;
  }
  sbf_asset_free(made);
  sbfi_xml_locate(source, &allocator, findings);
  return sbf_code_find(findings->at[0].code)->fault;
}

static sbf_status check_size(
    const sbfi_xml_source *source, const sbf_load_options *options, sbf_diagnostic *error) {
  if (source->size <= options->limits.file_bytes) return SBF_OK;
  return sbfi_diagnose(error, SBF_CODE_IO_TOO_LARGE,
      "the input is larger than the limit of %llu bytes: raise the limit if it is trusted",
      (unsigned long long)options->limits.file_bytes);
}

static sbf_status load(const sbfi_xml_source *source, const sbf_load_options *options, const char *name,
    sbf_asset **asset, sbf_diagnostic *error) {
  sbf_diagnostic first;
  sbfi_xml_findings findings = {&first, 1, 0};
  sbf_status status = check_size(source, options, &first);
  if (status == SBF_OK) status = sbfi_xml_read(source, options, &findings, asset);
  if (status == SBF_OK || !error) return status;
  *error = first;
  if (name) sbfi_copy_text(error->file, sizeof error->file, name);
  return status;
}

sbf_status sbf_xml_load_memory(const void *bytes, size_t size, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *error) {
  sbf_load_options filled = sbfi_load_options_of(options);
  const sbfi_xml_source source = {.bytes = bytes, .size = size};
  *asset = NULL;
  return load(&source, &filled, filled.name, asset, error);
}

static sbf_status load_content(const sbfi_file_content *content, const char *path,
    const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  const sbfi_xml_source source = {.bytes = content->at, .size = content->size};
  return load(&source, options, path, asset, error);
}

/* Read in pieces: text that an editor saves in place would end a program that has it mapped. */
static sbf_status load_pieces(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  sbfi_file file;
  sbf_status status = sbfi_file_open(path, &file, error);
  if (status != SBF_OK) return status;
  const sbfi_xml_source source = {.file = &file, .size = file.size};
  status = load(&source, options, path, asset, error);
  sbfi_file_close(&file);
  return status;
}

sbf_status sbf_xml_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  sbf_load_options filled = sbfi_load_options_of(options);
  sbfi_file_content content;
  *asset = NULL;
  /* what can be mapped can also be read in pieces, and twice; the rest, as a pipe, has been read whole */
  sbf_status status = sbfi_file_map(path, filled.limits.file_bytes, filled.allocator, &content, error);
  if (status != SBF_OK) return status;
  bool is_mapped = content.size && !content.allocated_bytes;
  if (!is_mapped) status = load_content(&content, path, &filled, asset, error);
  sbfi_file_content_free(&content);
  return is_mapped ? load_pieces(path, &filled, asset, error) : status;
}
