/* Unnamed files of Linux; other systems have none. */
#define _GNU_SOURCE
#include "base/unnamed_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#ifdef O_TMPFILE

enum { HANDLE_PATH_BYTES = 32 };

static void path_of(int handle, char path[HANDLE_PATH_BYTES]) {
  snprintf(path, HANDLE_PATH_BYTES, "/proc/self/fd/%d", handle);
}

int sbfi_unnamed_file_open(const char *folder) {
  int handle;
  do handle = open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  while (handle < 0 && errno == EINTR);
  if (handle < 0) return -1;
  /* The file can be named only through this path, and not every system has /proc. */
  char path[HANDLE_PATH_BYTES];
  path_of(handle, path);
  if (access(path, F_OK) == 0) return handle;
  close(handle);
  return -1;
}

int sbfi_unnamed_file_name(int handle, const char *path) {
  char from[HANDLE_PATH_BYTES];
  path_of(handle, from);
  return linkat(AT_FDCWD, from, AT_FDCWD, path, AT_SYMLINK_FOLLOW);
}

#else

int sbfi_unnamed_file_open(const char *folder) {
  (void)folder;
  return -1;
}

int sbfi_unnamed_file_name(int handle, const char *path) {
  (void)handle, (void)path;
  errno = ENOSYS;
  return -1;
}

#endif
