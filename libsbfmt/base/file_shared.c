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
      "the file ends %llu bytes before what is to be read: it was cut short", (unsigned long long)missing);
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

sbf_status sbfi_file_map(const char *path, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error) {
  return sbfi_file_get(path, true, limit_bytes, allocator, content, error);
}

sbf_status sbfi_file_read(const char *path, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error) {
  return sbfi_file_get(path, false, limit_bytes, allocator, content, error);
}

bool sbfi_file_writer_room(sbfi_file_writer *writer, const char *final_path) {
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

/* Closes what the writer holds, and frees its room. */
static void end(sbfi_file_writer *writer) {
  sbfi_file_shut(writer);
  sbfi_free(&writer->allocator, writer->memory, writer->memory_bytes);
  *writer = (sbfi_file_writer){.handle = -1};
}

sbf_status sbfi_file_writer_open(
    sbfi_file_writer *writer, const char *path, const sbf_allocator *allocator, sbf_diagnostic *error) {
  *writer =
      (sbfi_file_writer){.allocator = sbfi_allocator_or_default(allocator), .handle = -1, .given_path = path};
  int number = sbfi_file_writer_target(writer, path);
  if (number != 0) {
    end(writer);
    return sbfi_file_fault(error, SBF_CODE_IO_CANNOT_WRITE, path, "create", number);
  }
  writer->is_open = true;
  return SBF_OK;
}

void sbfi_file_flush(sbfi_file_writer *writer) {
  sbfi_file_put(writer, writer->buffer, writer->buffered_bytes);
  writer->buffered_bytes = 0;
}

sbf_status sbfi_file_writer_write(
    sbfi_file_writer *writer, const void *bytes, size_t size, sbf_diagnostic *error) {
  if (!writer->is_open) return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "the file writer is not open");
  if (size > SBFI_FILE_BUFFER_BYTES - writer->buffered_bytes) sbfi_file_flush(writer);
  if (size > SBFI_FILE_BUFFER_BYTES) {
    sbfi_file_put(writer, bytes, size);
  } else if (size > 0) {
    memcpy(writer->buffer + writer->buffered_bytes, bytes, size);
    writer->buffered_bytes += size;
  }
  writer->written_bytes += size;
  if (writer->failure == 0) return SBF_OK;
  return sbfi_file_fault(error, SBF_CODE_IO_CANNOT_WRITE, writer->given_path, "write", writer->failure);
}

sbf_status sbfi_file_writer_commit(sbfi_file_writer *writer, sbf_diagnostic *error) {
  if (!writer->is_open) return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "the file writer is not open");
  const char *path = writer->given_path;
  sbfi_file_flush(writer);
  /* What is not a regular file often cannot be synced. */
  if (writer->failure == 0 && writer->temporary_path) writer->failure = sbfi_file_sync(writer);
  int closed = sbfi_file_shut(writer);
  if (writer->failure == 0) writer->failure = closed;
  if (writer->failure == 0 && writer->temporary_path) writer->failure = sbfi_file_rename(writer);
  int failure = writer->failure;
  if (failure != 0) {
    sbfi_file_writer_abandon(writer);
    return sbfi_file_fault(error, SBF_CODE_IO_CANNOT_WRITE, path, "write", failure);
  }
  end(writer);
  return SBF_OK;
}

void sbfi_file_writer_abandon(sbfi_file_writer *writer) {
  if (!writer->is_open) return;
  sbfi_file_shut(writer); /* an open file cannot be removed everywhere */
  if (writer->temporary_path) sbfi_file_remove(writer->temporary_path);
  end(writer);
}

sbf_status sbfi_file_write(
    const char *path, const void *bytes, size_t size, const sbf_allocator *allocator, sbf_diagnostic *error) {
  sbfi_file_writer writer;
  sbf_status status = sbfi_file_writer_open(&writer, path, allocator, error);
  if (status != SBF_OK) return status;
  status = sbfi_file_writer_write(&writer, bytes, size, error);
  if (status == SBF_OK) return sbfi_file_writer_commit(&writer, error);
  sbfi_file_writer_abandon(&writer);
  return status;
}
