/* Saves XML to memory, or to a file that is replaced atomically. */
#include "base/diagnostic.h"
#include "base/file.h"
#include "model/asset_box.h"
#include "model/check.h"
#include "sbfmt/io.h"
#include "xml/xml_writer.h"

sbf_status sbf_xml_save_memory(const sbf_asset *asset, const sbf_save_options *options,
    const sbf_allocator *allocator, sbf_buffer *buffer, sbf_diagnostic *error) {
  (void)options; /* the options of this version concern the packed form */
  sbfi_text text;
  *buffer = (sbf_buffer){.at = NULL};
  sbf_status status = sbfi_check_saved(asset, error);
  if (status != SBF_OK) return status;
  sbfi_text_init(&text, allocator);
  status = sbfi_xml_write(asset, NULL, &text, NULL, error);
  if (status != SBF_OK) {
    sbfi_text_free(&text);
    return status;
  }
  *buffer = (sbf_buffer){(uint8_t *)text.at, text.length, text.allocator, text.capacity};
  return SBF_OK;
}

static sbf_status write_to_file(void *user, const void *bytes, size_t size, sbf_diagnostic *error) {
  return sbfi_file_writer_write(user, bytes, size, error);
}

sbf_status sbf_xml_save_file(
    const sbf_asset *asset, const char *path, const sbf_save_options *options, sbf_diagnostic *error) {
  (void)options;
  sbfi_file_writer file;
  sbfi_text text;
  sbf_status status = sbfi_check_saved(asset, error);
  if (status != SBF_OK) return status;
  const sbf_allocator *allocator = &sbfi_asset_box_of(asset)->arena.allocator;
  status = sbfi_file_writer_open(&file, path, allocator, error);
  if (status != SBF_OK) return status;
  sbfi_text_init(&text, allocator);
  status = sbfi_xml_write(asset, NULL, &text, &(sbfi_xml_sink){write_to_file, &file}, error);
  if (status == SBF_OK)
    status = sbfi_file_writer_commit(&file, error);
  else
    sbfi_file_writer_abandon(&file);
  sbfi_text_free(&text);
  return status;
}
