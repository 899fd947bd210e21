/* Parts of reading a file that all systems share: size errors, and memory for the content. */
#include <string.h>

#include "base/file_system.h"

sbf_status sbfi_file_too_large(sbf_diagnostic *error, const char *path, uint64_t limit_bytes) {
  sbf_status status = sbfi_diagnose(error, SBF_CODE_IO_TOO_LARGE,
      "the file is larger than the limit of %llu bytes: raise the limit if the file is trusted",
      (unsigned long long)limit_bytes);
  if (error) sbfi_copy_text(error->file, sizeof error->file, path);
  return status;
}

sbf_status sbfi_file_ends_early(sbf_diagnostic *error, const char *path, uint64_t offset, size_t missing) {
  sbf_status status = sbfi_diagnose(error, SBF_CODE_IO_CANNOT_READ,
      "the file ends %llu bytes too early: it was truncated, copy or export it again",
      (unsigned long long)missing);
  if (error) {
    sbfi_copy_text(error->file, sizeof error->file, path);
    error->offset = offset > INT64_MAX ? -1 : (int64_t)offset;
  }
  return status;
}

bool sbfi_file_grow(sbfi_file_content *content, size_t capacity) {
  void *at = content->allocator.reallocate(
      content->allocator.user, (void *)content->at, content->allocated_bytes, capacity);
  if (!at) return false;
  content->at = at;
  content->allocated_bytes = capacity;
  return true;
}

bool sbfi_file_writer_reserve(sbfi_file_writer *writer, const char *final_path) {
  size_t length = strlen(final_path) + 1;
  writer->memory_bytes = 2 * length + SBFI_TEMPORARY_NAME_BYTES + SBFI_FILE_BUFFER_BYTES;
  writer->memory = sbfi_allocate(&writer->allocator, writer->memory_bytes);
  if (!writer->memory) return false;
  writer->buffer = (uint8_t *)writer->memory;
  writer->final_path = writer->memory + SBFI_FILE_BUFFER_BYTES;
  writer->temporary_path = writer->final_path + length;
  memcpy(writer->final_path, final_path, length);
  return true;
}
