/* Files: whole, by position, and written so that a reader sees the old one or the new one, never half of it.
 * One implementation a system (file_posix.c). Every `*error` may be NULL; `file` of what is reported is the
 * path as given. Errors of the file are IO_CANNOT_READ, IO_CANNOT_WRITE and IO_TOO_LARGE. */
#ifndef SBFI_FILE_H
#define SBFI_FILE_H

#include "base/diagnostic.h"
#include "base/memory.h"

/* A file's content, read only. `at` is NULL where size is 0. Free with sbfi_file_content_free. */
typedef struct sbfi_file_content {
  const uint8_t *at;
  size_t size;
  sbf_allocator allocator;
  size_t allocated_bytes; /* 0: mapped, not allocated */
} sbfi_file_content;

/* Maps the file, or reads it whole where it cannot be mapped (a pipe). `limit_bytes` bounds its size; 0: no
 * bound. A mapped file that another program cuts short while it is in use ends the process (SIGBUS): where
 * that must not happen, read. A mapping begins on a page, so it is aligned for any type. */
sbf_status sbfi_file_map(const char *path, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error);
sbf_status sbfi_file_read(const char *path, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error);
void sbfi_file_content_free(sbfi_file_content *content);

/* A regular file opened for reading at any place; several threads may read at once. */
typedef struct sbfi_file {
  intptr_t handle;
  uint64_t size;    /* bytes, when it was opened */
  const char *path; /* the caller's, for messages: must stay as long as the file is open */
} sbfi_file;

sbf_status sbfi_file_open(const char *path, sbfi_file *file, sbf_diagnostic *error);
/* All `size` bytes from `offset` on, or an error; a file that ends before is an error. */
sbf_status sbfi_file_read_at(
    const sbfi_file *file, uint64_t offset, void *to, size_t size, sbf_diagnostic *error);
void sbfi_file_close(sbfi_file *file);

/* Writes a file in pieces: open, write..., then commit or abandon. The bytes go to a temporary file in the
 * same folder, which commit syncs and renames. Until then, and after any failure, the old file stands and
 * nothing else is left behind. An existing file keeps its permissions, a link stays a link, and a file
 * without write permission is refused. What is not a regular file (/dev/stdout, a pipe) is written to
 * directly, with no such promise. Not thread safe. */
typedef struct sbfi_file_writer {
  sbf_allocator allocator;
  intptr_t handle;
  const char *given_path; /* the caller's, for messages: must stay until commit or abandon */
  char *memory;           /* one block: paths and buffer */
  size_t memory_bytes;
  char *final_path, *temporary_path; /* the latter NULL where written to directly */
  uint8_t *buffer;
  size_t buffered_bytes;
  uint64_t written_bytes; /* all given so far: the offset of the next */
  int failure;            /* the system's number of the first failure; 0: none */
  bool is_open;
} sbfi_file_writer;

sbf_status sbfi_file_writer_open(
    sbfi_file_writer *writer, const char *path, const sbf_allocator *allocator, sbf_diagnostic *error);
/* After a failure every further call reports it again. */
sbf_status sbfi_file_writer_write(
    sbfi_file_writer *writer, const void *bytes, size_t size, sbf_diagnostic *error);
/* Ends the writer, whatever it returns. */
sbf_status sbfi_file_writer_commit(sbfi_file_writer *writer, sbf_diagnostic *error);
/* Does nothing to a writer that has ended or is {0}. */
void sbfi_file_writer_abandon(sbfi_file_writer *writer);

/* The three in one. */
sbf_status sbfi_file_write(
    const char *path, const void *bytes, size_t size, const sbf_allocator *allocator, sbf_diagnostic *error);

#endif
