/* Location of the program and the library, from the dynamic linker. */
#define _GNU_SOURCE /* dladdr */
#include "base/module_path.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The folder of a path, with links resolved. */
static bool folder_of(const char *path, char *to, size_t size) {
  char *real = realpath(path, NULL);
  char *slash = real ? strrchr(real, '/') : NULL;
  bool good = slash && (size_t)(slash - real) < size;
  if (good) {
    memcpy(to, real, (size_t)(slash - real));
    to[slash - real] = 0;
  }
  free(real);
  return good;
}

bool sbfi_program_folder(char *to, size_t size) {
  return folder_of("/proc/self/exe", to, size);
}

bool sbfi_library_folder(char *to, size_t size) {
  static const char here = 0; /* any address of this module */
  Dl_info info;
  if (!dladdr(&here, &info) || !info.dli_fname) return false;
  /* A program has the name of its call; without a slash this does not give its location. */
  return strchr(info.dli_fname, '/') && folder_of(info.dli_fname, to, size);
}

bool sbfi_is_program(const char *path) {
  struct stat about;
  return stat(path, &about) == 0 && S_ISREG(about.st_mode) && access(path, X_OK) == 0;
}
