/* Loads all forms of the format and saves text and packed ones: the first bytes select the reader, the file
 * name the writer. */
#include <string.h>

#include "base/diagnostic.h"
#include "base/file.h"
#include "base/text.h"
#include "model/asset_box.h"
#include "model/options.h"
#include "sbfmt/gltf.h"
#include "xml/xml_reader.h"

typedef enum form { FORM_UNKNOWN, FORM_EMPTY, FORM_XML, FORM_PACKED, FORM_GLTF } form;

static bool begins_packed(const uint8_t *bytes, size_t size) {
  static const uint8_t magic[] = {0x89, 'S', 'B', 'F'};
  size_t compared = size < sizeof magic ? size : sizeof magic;
  /* also accepts a magic number whose first byte lost its high bit: the reader reports the cause */
  return (bytes[0] | 0x80) == magic[0] && memcmp(bytes + 1, magic + 1, compared - 1) == 0;
}

static form form_of(const uint8_t *bytes, size_t size) {
  sbfi_span rest = {(const char *)bytes, size};
  if (size == 0) return FORM_EMPTY;
  if (begins_packed(bytes, size)) return FORM_PACKED;
  if (sbf_gltf_is_begun(bytes, size)) return FORM_GLTF;
  if (sbfi_span_begins(rest, "\xef\xbb\xbf")) rest = (sbfi_span){rest.at + 3, rest.length - 3};
  rest = sbfi_span_trim(rest);
  if (rest.length && rest.at[0] == '<') return FORM_XML;
  /* other encodings: the XML reader rejects them with advice */
  bool wide = sbfi_span_begins(rest, "\xfe\xff") || sbfi_span_begins(rest, "\xff\xfe") || bytes[0] == 0;
  return wide && memchr(bytes, '<', size < 4 ? size : 4) ? FORM_XML : FORM_UNKNOWN;
}

static sbf_status refuse(form found, const char *path, sbf_diagnostic *error) {
  sbf_status status = sbfi_diagnose(error, SBF_CODE_IO_UNKNOWN_FORMAT,
      found == FORM_EMPTY ? "the file is empty"
                          : "the file is no form of sbf: files of other formats are for `sbfmt convert`");
  if (error) sbfi_copy_text(error->file, sizeof error->file, path);
  return status;
}

static void release_content(void *content) {
  sbfi_file_content_free(content);
}

/* A packed asset may point into the bytes that it was read from: it keeps them. */
static sbf_status load_packed_content(
    sbfi_file_content *content, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  sbf_status status = sbf_packed_load_memory(content->at, content->size, options, asset, error);
  if (status != SBF_OK) return status;
  sbfi_asset_box *box = sbfi_asset_box_of(*asset);
  box->released = sbfi_arena_copy(&box->arena, content, 1, sizeof *content);
  if (box->released) {
    box->release = release_content;
    content->at = NULL;
    content->allocated_bytes = 0;
    return SBF_OK;
  }
  sbf_asset_free(*asset);
  *asset = NULL;
  return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for an asset");
}

/* Loads from bytes read completely, as from a pipe. */
static sbf_status load_content(const char *path, sbfi_file_content *content, form found,
    const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  sbf_load_options named = *options;
  named.name = path;
  if (found == FORM_PACKED) return load_packed_content(content, &named, asset, error);
  if (found == FORM_GLTF) return sbf_gltf_load_memory(content->at, content->size, &named, asset, error);
  return sbf_xml_load_memory(content->at, content->size, &named, asset, error);
}

sbf_status sbf_load_file_findings(const char *path, const sbf_load_options *options, sbf_asset **asset,
    sbf_diagnostic *findings, uint32_t capacity, uint32_t *count) {
  sbf_load_options filled = sbfi_load_options_of(options);
  sbfi_file_content content;
  *asset = NULL;
  *count = 1; /* all but the XML reader stop at the first finding */
  sbf_status status = sbfi_file_map(path, filled.limits.file_bytes, filled.allocator, &content, findings);
  if (status != SBF_OK) return status;
  form found = form_of(content.at, content.size);
  bool is_mapped = content.size && !content.allocated_bytes; /* then it can be reopened */
  if (found == FORM_EMPTY || found == FORM_UNKNOWN)
    status = refuse(found, path, findings);
  else if (!is_mapped)
    status = load_content(path, &content, found, &filled, asset, findings);
  sbfi_file_content_free(&content);
  if (is_mapped && status == SBF_OK && found == FORM_XML) {
    sbfi_xml_findings all = {findings, capacity, 0};
    status = sbfi_xml_read_file(path, options, &all, asset);
    *count = all.count;
  } else if (is_mapped && status == SBF_OK && found == FORM_GLTF) {
    status = sbf_gltf_load_file(path, options, asset, findings);
  } else if (is_mapped && status == SBF_OK) {
    status = sbf_packed_load_file(path, options, asset, findings);
  }
  if (status == SBF_OK) *count = 0;
  return status;
}

sbf_status sbf_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  sbf_diagnostic first;
  uint32_t count;
  sbf_status status = sbf_load_file_findings(path, options, asset, &first, 1, &count);
  if (status != SBF_OK && error) *error = first;
  return status;
}

static bool ends_packed(const char *path) {
  static const char ending[] = ".sbfz";
  size_t length = strlen(path), tail = sizeof ending - 1;
  if (length < tail) return false;
  for (size_t i = 0; i < tail; i++) {
    char c = path[length - tail + i];
    if ((c >= 'A' && c <= 'Z' ? c + 32 : c) != ending[i]) return false;
  }
  return true;
}

sbf_status sbf_save_file(
    const sbf_asset *asset, const char *path, const sbf_save_options *options, sbf_diagnostic *error) {
  return (ends_packed(path) ? sbf_packed_save_file : sbf_xml_save_file)(asset, path, options, error);
}
