#include <string.h>

#include "base/file_system.h"

sbf_status sbfi_file_map(const char *path, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error) {
  return sbfi_file_get(path, true, limit_bytes, allocator, content, error);
}

sbf_status sbfi_file_read(const char *path, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error) {
  return sbfi_file_get(path, false, limit_bytes, allocator, content, error);
}

/* Closes the writer's file and frees its memory. */
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

static void flush(sbfi_file_writer *writer) {
  sbfi_file_put(writer, writer->buffer, writer->buffered_bytes);
  writer->buffered_bytes = 0;
}

sbf_status sbfi_file_writer_write(
    sbfi_file_writer *writer, const void *bytes, size_t size, sbf_diagnostic *error) {
  if (!writer->is_open) return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "the file writer is not open");
  if (size > SBFI_FILE_BUFFER_BYTES - writer->buffered_bytes) flush(writer);
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
  flush(writer);
  /* Devices and pipes often cannot be synced. */
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
  sbfi_file_shut(writer); /* some systems cannot remove an open file */
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
