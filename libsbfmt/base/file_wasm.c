/* A web page has no files: loads and saves use memory. */
#include "base/file.h"

#include <string.h>

#include "base/text.h"

static sbf_status no_files(sbf_code code, const char *path, sbf_diagnostic *error) {
  sbf_status status =
      sbfi_diagnose(error, code, "there are no files in WebAssembly: pass the bytes in memory");
  if (error) sbfi_copy_text(error->file, sizeof error->file, path);
  return status;
}

sbf_status sbfi_file_map(const char *path, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error) {
  (void)limit_bytes;
  *content = (sbfi_file_content){.allocator = sbfi_allocator_or_default(allocator)};
  return no_files(SBF_CODE_IO_CANNOT_READ, path, error);
}

sbf_status sbfi_file_read(const char *path, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error) {
  return sbfi_file_map(path, limit_bytes, allocator, content, error);
}

void sbfi_file_content_free(sbfi_file_content *content) {
  (void)content;
}

sbf_status sbfi_file_open(const char *path, sbfi_file *file, sbf_diagnostic *error) {
  *file = (sbfi_file){.handle = -1, .path = path};
  return no_files(SBF_CODE_IO_CANNOT_READ, path, error);
}

sbf_status sbfi_file_read_at(
    const sbfi_file *file, uint64_t offset, void *to, size_t size, sbf_diagnostic *error) {
  (void)offset, (void)to, (void)size;
  return no_files(SBF_CODE_IO_CANNOT_READ, file->path, error);
}

void sbfi_file_close(sbfi_file *file) {
  (void)file;
}

sbf_status sbfi_file_writer_open(
    sbfi_file_writer *writer, const char *path, const sbf_allocator *allocator, sbf_diagnostic *error) {
  *writer =
      (sbfi_file_writer){.allocator = sbfi_allocator_or_default(allocator), .handle = -1, .given_path = path};
  return no_files(SBF_CODE_IO_CANNOT_WRITE, path, error);
}

sbf_status sbfi_file_writer_write(
    sbfi_file_writer *writer, const void *bytes, size_t size, sbf_diagnostic *error) {
  (void)bytes, (void)size;
  return no_files(SBF_CODE_IO_CANNOT_WRITE, writer->given_path, error);
}

sbf_status sbfi_file_writer_commit(sbfi_file_writer *writer, sbf_diagnostic *error) {
  return no_files(SBF_CODE_IO_CANNOT_WRITE, writer->given_path, error);
}

void sbfi_file_writer_abandon(sbfi_file_writer *writer) {
  (void)writer;
}

sbf_status sbfi_file_write(
    const char *path, const void *bytes, size_t size, const sbf_allocator *allocator, sbf_diagnostic *error) {
  (void)bytes, (void)size, (void)allocator;
  return no_files(SBF_CODE_IO_CANNOT_WRITE, path, error);
}

const char *sbfi_path_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}
