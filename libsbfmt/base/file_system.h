/* System-specific parts of file.h. file.c is common; it calls file_posix.c or file_windows.c, and both use
 * file_parts.c. */
#ifndef SBFI_FILE_SYSTEM_H
#define SBFI_FILE_SYSTEM_H

#include "base/file.h"

enum { SBFI_FILE_BUFFER_BYTES = 1 << 16, SBFI_TEMPORARY_NAME_BYTES = 32 };

/* ---- file_posix.c, file_windows.c ---- */

/* Fills the error for the system's error `number` in the action `doing` ("open"); returns its status. */
sbf_status sbfi_file_fault(
    sbf_diagnostic *error, sbf_code code, const char *path, const char *doing, int number);
/* Writes all bytes, or sets writer->failure. */
void sbfi_file_put(sbfi_file_writer *writer, const uint8_t *at, size_t size);

/* sbfi_file_map if `map`, else sbfi_file_read. */
sbf_status sbfi_file_get(const char *path, bool map, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error);
/* Opens the file to write to and allocates the writer's memory; 0 or an error number. */
int sbfi_file_writer_target(sbfi_file_writer *writer, const char *path);
/* For an open writer, each returning 0 or an error number: sync the data to disk; close the file if open;
 * rename the temporary file to the final name. */
int sbfi_file_sync(sbfi_file_writer *writer);
int sbfi_file_shut(sbfi_file_writer *writer);
int sbfi_file_rename(sbfi_file_writer *writer);
void sbfi_file_remove(const char *path);

/* ---- file_parts.c ---- */

/* Grows the buffer for reading; false if memory runs out. */
bool sbfi_file_grow(sbfi_file_content *content, size_t capacity);

sbf_status sbfi_file_too_large(sbf_diagnostic *error, const char *path, uint64_t limit_bytes);
/* Error: the file ends `missing` bytes before the end of the range to read at `offset`. */
sbf_status sbfi_file_ends_early(sbf_diagnostic *error, const char *path, uint64_t offset, size_t missing);
/* Memory for `final_path`, a temporary one beside it, and the buffer. */
bool sbfi_file_writer_reserve(sbfi_file_writer *writer, const char *final_path);

#endif
