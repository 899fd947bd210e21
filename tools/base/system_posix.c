#include "base/system.h"

#include <dlfcn.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void system_begin(int argc, char **argv) {
  (void)argc, (void)argv;
}

bool system_make_folder(const char *path) {
  return mkdir(path, 0777) == 0 || (errno == EEXIST && system_is_folder(path, true));
}

bool system_make_unique_folder(char *path) {
  if (!mkdtemp(path)) return false;
  mode_t mask = umask(0);
  umask(mask);
  chmod(path, 0777 & ~mask); /* mkdtemp restricts it to its owner */
  return true;
}

bool system_can_write_folder(const char *path) {
  return access(path, W_OK | X_OK) == 0;
}

bool system_is_folder(const char *path, bool follow_link) {
  struct stat facts;
  return (follow_link ? stat : lstat)(path, &facts) == 0 && S_ISDIR(facts.st_mode);
}

bool system_replace_file(const char *from, const char *to) {
  return rename(from, to) == 0;
}

bool system_sync_file(FILE *file) {
  return fsync(fileno(file)) == 0;
}

FILE *system_temporary_file(void) {
  return tmpfile();
}

FILE *system_memory_stream_open(system_memory_stream *stream) {
  *stream = (system_memory_stream){NULL, NULL, 0};
  return stream->file = open_memstream(&stream->bytes, &stream->size);
}

char *system_memory_stream_close(system_memory_stream *stream, size_t *size) {
  bool good = stream->file && !ferror(stream->file);
  if (stream->file) good = fclose(stream->file) == 0 && good;
  *size = stream->size;
  if (good) return stream->bytes;
  free(stream->bytes);
  return NULL;
}

bool system_program_path(char *to, size_t size) {
  ssize_t length = readlink("/proc/self/exe", to, size);
  if (length < 0 || (size_t)length >= size) return false;
  to[length] = 0;
  return true;
}

uint32_t system_processor_count(void) {
  long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count < 1 ? 1 : (uint32_t)count;
}

double system_load(void) {
  double loads[1];
  return getloadavg(loads, 1) == 1 ? loads[0] : (double)NAN;
}

void *system_open_library(const char *name) {
  return dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
}

system_function system_library_function(void *library, const char *name) {
  /* POSIX guarantees this conversion; ISO C has no cast between data and function pointers. */
  void *symbol = dlsym(library, name);
  system_function function = NULL;
  if (symbol) memcpy(&function, &symbol, sizeof function);
  return function;
}
