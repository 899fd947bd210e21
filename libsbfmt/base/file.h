/* Files: read whole, read at an offset, and written so that readers see either the old or the new content,
 * never a mixture. One implementation per system (file_posix.c). Every `*error` may be NULL; its `file` is
 * the path as given. Errors of the file are IO_CANNOT_READ, IO_CANNOT_WRITE and IO_TOO_LARGE. */
#ifndef SBFI_FILE_H
#define SBFI_FILE_H

#include <stdio.h>

#include "base/diagnostic.h"
#include "base/memory.h"

/* A file's content, read only. `at` is NULL if size is 0. Free with sbfi_file_content_free. */
typedef struct sbfi_file_content {
  const uint8_t *at;
  size_t size;
  sbf_allocator allocator;
  size_t allocated_bytes; /* 0: mapped, not allocated */
} sbfi_file_content;

/* Maps the file, or reads it if it cannot be mapped (a pipe). `limit_bytes` limits its size; 0: no limit. If
 * another program truncates a mapped file, access ends the process (SIGBUS); read the file if that must not
 * happen. A mapping is aligned to a page, so to any type. */
sbf_status sbfi_file_map(const char *path, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error);
sbf_status sbfi_file_read(const char *path, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error);
void sbfi_file_content_free(sbfi_file_content *content);

/* A regular file opened for reading at any offset; several threads may read at once. */
typedef struct sbfi_file {
  intptr_t handle;
  uint64_t size;    /* bytes, when opened */
  const char *path; /* the caller's, for messages; must live while the file is open */
} sbfi_file;

sbf_status sbfi_file_open(const char *path, sbfi_file *file, sbf_diagnostic *error);
/* Reads `size` bytes from `offset`; a file that ends before is an error. */
sbf_status sbfi_file_read_at(
    const sbfi_file *file, uint64_t offset, void *to, size_t size, sbf_diagnostic *error);
void sbfi_file_close(sbfi_file *file);

/* Writes a file in pieces: open, write..., then commit or abandon. The bytes go to a temporary file in the
 * same folder, which commit syncs and renames. Before that, and after any failure, the old file is intact and
 * nothing else is left behind. An existing file keeps its permissions, a link stays a link, and a file
 * without write permission is refused. Devices and pipes (/dev/stdout) are written directly, without these
 * promises. Not thread safe. */
typedef struct sbfi_file_writer {
  sbf_allocator allocator;
  intptr_t handle;
  const char *given_path; /* the caller's, for messages; must live until commit or abandon */
  char *memory;           /* one block: paths and buffer */
  size_t memory_bytes;
  char *final_path, *temporary_path; /* temporary_path is NULL if written directly */
  uint8_t *buffer;
  size_t buffered_bytes;
  uint64_t written_bytes; /* total so far: the offset of the next write */
  int failure;            /* errno (or the Windows code) of the first failure; 0: none */
  bool is_open;
} sbfi_file_writer;

sbf_status sbfi_file_writer_open(
    sbfi_file_writer *writer, const char *path, const sbf_allocator *allocator, sbf_diagnostic *error);
/* After a failure every further call reports it again. */
sbf_status sbfi_file_writer_write(
    sbfi_file_writer *writer, const void *bytes, size_t size, sbf_diagnostic *error);
/* Ends the writer, even if it fails. */
sbf_status sbfi_file_writer_commit(sbfi_file_writer *writer, sbf_diagnostic *error);
/* Does nothing if the writer has ended or is {0}. */
void sbfi_file_writer_abandon(sbfi_file_writer *writer);

/* Opens, writes and commits. */
sbf_status sbfi_file_write(
    const char *path, const void *bytes, size_t size, const sbf_allocator *allocator, sbf_diagnostic *error);

/* The part of a path behind its folders: behind the last slash, on Windows also behind a backslash or a
 * drive's colon. */
const char *sbfi_path_name(const char *path);

/* A stream that discards what is written to it; NULL if none can be opened. Close it with fclose. */
FILE *sbfi_file_discard(void);

#endif
