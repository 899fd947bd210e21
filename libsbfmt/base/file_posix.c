/* Files with POSIX calls: reading, mapping, and writing to a temporary file that replaces the old one. */
#define _XOPEN_SOURCE 700
#define _FILE_OFFSET_BITS 64
#include "base/file_system.h"
#include "base/unnamed_file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum {
  LARGEST_TRANSFER = 1 << 30, /* some systems refuse more per call */
  FIRST_READ_BYTES = 1 << 16,
  TEMPORARY_TRIES = 100
};

sbf_status sbfi_file_fault(
    sbf_diagnostic *error, sbf_code code, const char *path, const char *doing, int number) {
  char why[128];
  if (strerror_r(number, why, sizeof why) != 0) snprintf(why, sizeof why, "error %d", number);
  if (number == ENOMEM) code = SBF_CODE_OUT_OF_MEMORY;
  sbf_status status = sbfi_diagnose(error, code, "cannot %s the file: %s", doing, why);
  if (error) sbfi_copy_text(error->file, sizeof error->file, path);
  return status;
}

static int open_again(const char *path, int flags, mode_t mode) {
  int handle;
  do handle = open(path, flags | O_CLOEXEC, mode);
  while (handle < 0 && errno == EINTR);
  return handle;
}

static ssize_t read_again(int handle, void *to, size_t size) {
  ssize_t got;
  do got = read(handle, to, size < LARGEST_TRANSFER ? size : LARGEST_TRANSFER);
  while (got < 0 && errno == EINTR);
  return got;
}

/* Opens for reading and gets the status; -1 and an error if either fails. */
static int open_to_read(const char *path, struct stat *facts, sbf_status *status, sbf_diagnostic *error) {
  int handle = open_again(path, O_RDONLY, 0);
  if (handle >= 0) {
    if (fstat(handle, facts) == 0 && !S_ISDIR(facts->st_mode)) return handle;
    if (S_ISDIR(facts->st_mode)) errno = EISDIR;
  }
  *status = sbfi_file_fault(error, SBF_CODE_IO_CANNOT_READ, path, "open", errno);
  if (handle >= 0) close(handle);
  return -1;
}

/* Reads to the end. The stated size of a regular file is only the initial capacity: it may change, and files
 * in /proc state none. One additional byte detects the end without growing. */
static sbf_status read_to_end(int handle, const char *path, uint64_t expected_bytes, uint64_t limit_bytes,
    sbfi_file_content *content, sbf_diagnostic *error) {
  if (limit_bytes && expected_bytes > limit_bytes) return sbfi_file_too_large(error, path, limit_bytes);
  size_t capacity = expected_bytes ? (size_t)expected_bytes + 1 : FIRST_READ_BYTES;
  if (expected_bytes >= SIZE_MAX || !sbfi_file_grow(content, capacity))
    return sbfi_file_fault(error, SBF_CODE_OUT_OF_MEMORY, path, "read", ENOMEM);
  for (;;) {
    ssize_t got =
        read_again(handle, (uint8_t *)content->at + content->size, content->allocated_bytes - content->size);
    if (got < 0) return sbfi_file_fault(error, SBF_CODE_IO_CANNOT_READ, path, "read", errno);
    if (got == 0) return SBF_OK;
    content->size += (size_t)got;
    if (limit_bytes && content->size > limit_bytes) return sbfi_file_too_large(error, path, limit_bytes);
    if (content->size < content->allocated_bytes) continue;
    if (!sbfi_multiply_size(content->allocated_bytes, 2, &capacity) || !sbfi_file_grow(content, capacity))
      return sbfi_file_fault(error, SBF_CODE_OUT_OF_MEMORY, path, "read", ENOMEM);
  }
}

sbf_status sbfi_file_get(const char *path, bool map, uint64_t limit_bytes, const sbf_allocator *allocator,
    sbfi_file_content *content, sbf_diagnostic *error) {
  *content = (sbfi_file_content){.allocator = sbfi_allocator_or_default(allocator)};
  struct stat facts = {.st_mode = 0};
  sbf_status status = SBF_OK;
  int handle = open_to_read(path, &facts, &status, error);
  if (handle < 0) return status;
  uint64_t size = S_ISREG(facts.st_mode) ? (uint64_t)facts.st_size : 0;
  if (map && size > 0 && size <= SIZE_MAX && !(limit_bytes && size > limit_bytes)) {
    void *at = mmap(NULL, (size_t)size, PROT_READ, MAP_PRIVATE, handle, 0);
    if (at != MAP_FAILED) {
      content->at = at;
      content->size = (size_t)size;
    }
  }
  if (!content->at) status = read_to_end(handle, path, size, limit_bytes, content, error);
  close(handle);
  if (status != SBF_OK || content->size == 0) sbfi_file_content_free(content);
  return status;
}

void sbfi_file_content_free(sbfi_file_content *content) {
  if (content->allocated_bytes)
    sbfi_free(&content->allocator, (void *)content->at, content->allocated_bytes);
  else if (content->at)
    munmap((void *)content->at, content->size);
  *content = (sbfi_file_content){.allocator = content->allocator};
}

sbf_status sbfi_file_open(const char *path, sbfi_file *file, sbf_diagnostic *error) {
  *file = (sbfi_file){.handle = -1, .path = path};
  struct stat facts = {.st_mode = 0};
  sbf_status status = SBF_OK;
  int handle = open_to_read(path, &facts, &status, error);
  if (handle < 0) return status;
  if (!S_ISREG(facts.st_mode)) {
    close(handle);
    status = sbfi_diagnose(error, SBF_CODE_IO_CANNOT_READ,
        "this is a pipe or a device: save its content to a file and name that file");
    if (error) sbfi_copy_text(error->file, sizeof error->file, path);
    return status;
  }
  file->handle = handle;
  file->size = (uint64_t)facts.st_size;
  return SBF_OK;
}

sbf_status sbfi_file_read_at(
    const sbfi_file *file, uint64_t offset, void *to, size_t size, sbf_diagnostic *error) {
  uint8_t *at = to;
  while (size > 0) {
    /* An offset that off_t cannot hold is beyond every end. */
    ssize_t got = offset > INT64_MAX ? 0
                                     : pread((int)file->handle, at,
                                           size < LARGEST_TRANSFER ? size : LARGEST_TRANSFER, (off_t)offset);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return sbfi_file_fault(error, SBF_CODE_IO_CANNOT_READ, file->path, "read", errno);
    if (got == 0) return sbfi_file_ends_early(error, file->path, offset, size);
    at += got;
    offset += (uint64_t)got;
    size -= (size_t)got;
  }
  return SBF_OK;
}

void sbfi_file_close(sbfi_file *file) {
  if (file->handle >= 0) close((int)file->handle);
  file->handle = -1;
}

const char *sbfi_path_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

FILE *sbfi_file_discard(void) {
  return fopen("/dev/null", "w");
}

/* Offset of the file name in the path of a writer's temporary file. */
static size_t folder_length(const sbfi_file_writer *writer) {
  return (size_t)(sbfi_path_name(writer->final_path) - writer->final_path);
}

/* Tries new names in the target's folder until `make` succeeds, with the result of open. The name is short,
 * since a long name plus a suffix might be too long for the file system. After failure there is no name. */
static int with_new_name(sbfi_file_writer *writer, int (*make)(const sbfi_file_writer *writer)) {
  char *name = writer->temporary_path + folder_length(writer);
  struct timespec now = {0, 0};
  clock_gettime(CLOCK_REALTIME, &now);
  uint32_t mark = (uint32_t)now.tv_nsec ^ (uint32_t)getpid() << 12;
  int made = -1;
  errno = EEXIST;
  for (int i = 0; i < TEMPORARY_TRIES && made < 0 && errno == EEXIST;
       i++, mark = mark * 1664525 + 1013904223) {
    snprintf(name, SBFI_TEMPORARY_NAME_BYTES, ".sbf-%08x.tmp", (unsigned)mark);
    made = make(writer);
  }
  if (made < 0) *name = 0;
  return made;
}

static int create_named(const sbfi_file_writer *writer) {
  return open_again(writer->temporary_path, O_WRONLY | O_CREAT | O_EXCL, 0666);
}

static int name_unnamed(const sbfi_file_writer *writer) {
  return sbfi_unnamed_file_name((int)writer->handle, writer->temporary_path);
}

/* Creates a file in the target's folder. If the system supports it, the file has no name until it is
 * complete, so nothing is left behind whenever the process ends. */
static int create_temporary(sbfi_file_writer *writer) {
  size_t folder = folder_length(writer);
  memcpy(writer->temporary_path, writer->final_path, folder);
  writer->temporary_path[folder] = 0;
  int handle = sbfi_unnamed_file_open(folder ? writer->temporary_path : ".");
  return handle >= 0 ? handle : with_new_name(writer, create_named);
}

/* A rename would replace a dangling link by the file. */
static bool is_link(const char *path) {
  struct stat facts;
  return lstat(path, &facts) == 0 && S_ISLNK(facts.st_mode);
}

/* Opens the file to write to; 0 or an error number. */
int sbfi_file_writer_target(sbfi_file_writer *writer, const char *path) {
  struct stat old;
  bool exists = stat(path, &old) == 0;
  int absent = exists ? 0 : errno;
  if (!exists && is_link(path)) return absent; /* a dangling link */
  if (exists && S_ISDIR(old.st_mode)) return EISDIR;
  /* A rename would bypass the write permission of the file. */
  if (exists && faccessat(AT_FDCWD, path, W_OK, AT_EACCESS) != 0) return errno;
  bool direct = exists && !S_ISREG(old.st_mode);
  /* A rename would replace the link instead of its target. */
  char *resolved = exists && !direct ? realpath(path, NULL) : NULL;
  if (exists && !direct && !resolved) return errno;
  bool allocated = sbfi_file_writer_reserve(writer, resolved ? resolved : path);
  free(resolved);
  if (!allocated) return ENOMEM;
  if (direct) writer->temporary_path = NULL;
  writer->handle = direct ? open_again(path, O_WRONLY, 0) : create_temporary(writer);
  if (writer->handle < 0) return errno;
  if (exists && !direct && fchmod((int)writer->handle, old.st_mode & 0777) != 0) {
    int number = errno;
    unlink(writer->temporary_path);
    return number;
  }
  return 0;
}

void sbfi_file_put(sbfi_file_writer *writer, const uint8_t *at, size_t size) {
  while (size > 0 && writer->failure == 0) {
    ssize_t put = write((int)writer->handle, at, size < LARGEST_TRANSFER ? size : LARGEST_TRANSFER);
    if (put < 0) {
      if (errno != EINTR) writer->failure = errno;
      continue;
    }
    at += put;
    size -= (size_t)put;
  }
}

/* Makes the rename itself durable. Ignores systems that cannot sync a folder. */
static void sync_folder(const char *path) {
  const char *slash = strrchr(path, '/');
  size_t length = slash ? (size_t)(slash - path) : 0;
  char folder[PATH_MAX];
  if (length >= sizeof folder) return;
  memcpy(folder, path, length);
  folder[length] = 0;
  int handle = open_again(length ? folder : slash ? "/" : ".", O_RDONLY, 0);
  if (handle < 0) return;
  fsync(handle);
  close(handle);
}

int sbfi_file_sync(sbfi_file_writer *writer) {
  if (fsync((int)writer->handle) != 0) return errno;
  bool named = writer->temporary_path[folder_length(writer)] != 0;
  return named || with_new_name(writer, name_unnamed) >= 0 ? 0 : errno;
}

int sbfi_file_shut(sbfi_file_writer *writer) {
  int handle = (int)writer->handle;
  writer->handle = -1;
  return handle >= 0 && close(handle) != 0 && errno != EINTR ? errno : 0;
}

int sbfi_file_rename(sbfi_file_writer *writer) {
  if (rename(writer->temporary_path, writer->final_path) != 0) return errno;
  sync_folder(writer->final_path);
  return 0;
}

void sbfi_file_remove(const char *path) {
  unlink(path);
}
