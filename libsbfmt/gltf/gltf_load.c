/* Loads the extension SBF_soft_body of a binary glTF file. */
#include <stdio.h>

#include "base/diagnostic.h"
#include "base/file.h"
#include "gltf/soft_body_reader.h"
#include "model/asset_box.h"
#include "model/check.h"
#include "model/options.h"
#include "model/version.h"
#include "sbfmt/gltf.h"

bool sbf_gltf_is_begun(const void *bytes, size_t size) {
  return sbfi_glb_is_begun(bytes, size);
}

static const sbfi_json *extension_of(const sbfi_glb_file *file) {
  return sbfi_json_get(sbfi_json_get(file->root, "extensions"), SBFI_GLTF_EXTENSION);
}

bool sbf_gltf_has_soft_bodies(const char *path) {
  sbfi_file_content content;
  sbfi_glb_file file;
  sbfi_arena arena;
  const sbf_load_options options = sbfi_load_options_of(NULL);
  if (sbfi_file_map(path, options.limits.file_bytes, NULL, &content, NULL) != SBF_OK) return false;
  sbfi_arena_init(&arena, NULL, (size_t)options.limits.memory_bytes);
  bool has =
      sbfi_glb_file_read(&file, content.at, content.size, &arena, NULL) == SBF_OK && extension_of(&file);
  sbfi_arena_free(&arena);
  sbfi_file_content_free(&content);
  return has;
}

/* The version that the extension states decides which fields it may have. */
static sbf_status read_version(sbfi_gltf_reader *r, const sbfi_json *extension) {
  const sbfi_json *version = sbfi_json_get(extension, "version");
  const char *stated = version && version->type == SBFI_JSON_STRING ? version->text.at : "";
  switch (sbfi_version_check(stated)) {
  case SBFI_VERSION_KNOWN:
    break;
  case SBFI_VERSION_NEWER_MINOR:
    r->newer = true;
    break;
  case SBFI_VERSION_TOO_NEW:
    return sbfi_diagnose(r->file.error, SBF_CODE_VERSION_TOO_NEW,
        "the character is of version %.20s, newer than this library's %s: use a newer one", stated,
        SBF_FORMAT_VERSION);
  case SBFI_VERSION_MALFORMED:
    return sbfi_diagnose(r->file.error, SBF_CODE_GLTF_EXTENSION, "%s states no version", SBFI_GLTF_EXTENSION);
  }
  r->minor = sbfi_version_minor(stated);
  return SBF_OK;
}

static sbf_status read_character(sbfi_gltf_reader *r, sbf_asset *made) {
  const sbfi_json *extension = extension_of(&r->file);
  if (!extension)
    return sbfi_diagnose(r->file.error, SBF_CODE_GLTF_NO_SOFT_BODY,
        "the glTF file has meshes, but no soft bodies (%s): `sbfmt convert` makes a character of it",
        SBFI_GLTF_EXTENSION);
  sbf_status status = read_version(r, extension);
  return status == SBF_OK ? sbfi_gltf_read_asset(r, extension, made) : status;
}

/* Content of a newer version was skipped. */
static void conclude_version(const sbfi_gltf_reader *r, sbf_asset *made) {
  char stated[16];
  snprintf(stated, sizeof stated, "1.%u", r->minor);
  sbfi_report_left_out(&r->options, stated, r->left_out, r->first_left_out);
  if (r->newer) made->version = SBF_FORMAT_VERSION;
}

static sbf_status load(const void *bytes, size_t size, const sbf_load_options *options, sbf_asset **asset,
    sbf_diagnostic *error) {
  sbf_asset *made = sbf_asset_create(options->allocator);
  if (!made) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for an asset");
  sbfi_asset_box *box = sbfi_asset_box_of(made);
  uint64_t limit = options->limits.memory_bytes;
  box->arena.limit_bytes = limit < SIZE_MAX ? (size_t)limit : SIZE_MAX;
  sbfi_gltf_reader r = {.options = *options,
      .arena = &box->arena,
      .inflated_limit = sbfi_inflated_limit(&options->limits, size)};
  sbfi_arena_init(&r.scratch, &box->arena.allocator, box->arena.limit_bytes);
  sbfi_packed_coder_init(&r.coder, &box->arena.allocator, 6);
  if (options->read_bytes) *options->read_bytes = size;
  sbf_status status = sbfi_glb_file_read(&r.file, bytes, size, &r.scratch, error);
  if (status == SBF_OK) status = read_character(&r, made);
  if (status == SBF_OK) status = sbfi_check_loaded(made, options, error);
  if (status == SBF_OK) conclude_version(&r, made);
  sbfi_packed_coder_free(&r.coder);
  sbfi_arena_free(&r.scratch);
  box->arena.limit_bytes = 0;
  if (status == SBF_OK)
    *asset = made;
  else
    sbf_asset_free(made);
  return status;
}

static sbf_status load_named(const void *bytes, size_t size, const sbf_load_options *filled, const char *name,
    sbf_asset **asset, sbf_diagnostic *error) {
  sbf_diagnostic own;
  sbf_status status = load(bytes, size, filled, asset, error ? error : &own);
  if (status != SBF_OK && error && name) sbfi_copy_text(error->file, sizeof error->file, name);
  return status;
}

sbf_status sbf_gltf_load_memory(const void *bytes, size_t size, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *error) {
  sbf_load_options filled = sbfi_load_options_of(options);
  *asset = NULL;
  return load_named(bytes, size, &filled, filled.name, asset, error);
}

sbf_status sbf_gltf_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  sbf_load_options filled = sbfi_load_options_of(options);
  sbfi_file_content content;
  *asset = NULL;
  sbf_status status = sbfi_file_read(path, filled.limits.file_bytes, filled.allocator, &content, error);
  if (status != SBF_OK) return status;
  status = load_named(content.at, content.size, &filled, path, asset, error);
  sbfi_file_content_free(&content);
  return status;
}
