/* The files behind file.h: file.c is the same everywhere, and calls the system's, file_posix.c or
 * file_windows.c; both use file_parts.c. */
#ifndef SBFI_FILE_SYSTEM_H
#define SBFI_FILE_SYSTEM_H

#include "base/file.h"

enum { SBFI_FILE_BUFFER_BYTES = 1 << 16, SBFI_TEMPORARY_NAME_BYTES = 32 };

/* ---- file_posix.c, file_windows.c ---- */

/* Fills the error for the system's error `number` while `doing` ("open") something; its status. */
sbf_status sbfi_file_fault(
    sbf_diagnostic *error, sbf_code code, const char *path, const char *doing, int number);
/* Writes all of it, or sets writer->failure. */
void sbfi_file_put(sbfi_file_writer *writer, const uint8_t *at, size_t size);

/* What sbfi_file_map does, where `map`, else sbfi_file_read. */
sbf_status sbfi_file_get(const char *path, bool map, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error);
/* Opens what is to be written to, and makes the writer's room; 0 or an error number. */
int sbfi_file_writer_target(sbfi_file_writer *writer, const char *path);
/* Of an open writer, each 0 or an error number: what was written reaches the disk; it is closed, if it was
 * not; its temporary file takes the final one's place. */
int sbfi_file_sync(sbfi_file_writer *writer);
int sbfi_file_shut(sbfi_file_writer *writer);
int sbfi_file_rename(sbfi_file_writer *writer);
void sbfi_file_remove(const char *path);

/* ---- file_parts.c ---- */

/* Makes room for more of what is read; false without memory. */
bool sbfi_file_grow(sbfi_file_content *content, size_t capacity);

sbf_status sbfi_file_too_large(sbf_diagnostic *error, const char *path, uint64_t limit_bytes);
/* That the file ends `missing` bytes before what is to be read at `offset`. */
sbf_status sbfi_file_ends_early(sbf_diagnostic *error, const char *path, uint64_t offset, size_t missing);
/* Memory for `final_path`, a temporary one beside it, and the buffer. */
bool sbfi_file_writer_reserve(sbfi_file_writer *writer, const char *final_path);

#endif
