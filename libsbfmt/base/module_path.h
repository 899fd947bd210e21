/* Location of the running program and of this library, to find files installed beside them. One
 * implementation per system (module_path_posix.c). */
#ifndef SBFI_MODULE_PATH_H
#define SBFI_MODULE_PATH_H

#include "sbfmt/base.h"

/* Folders, without a slash at the end: of the running program; of the shared library (or program) that
 * contains this code. False if the system does not report it or `size` is too small. */
bool sbfi_program_folder(char *to, size_t size);
bool sbfi_library_folder(char *to, size_t size);

/* Whether the path names a regular file that this user may execute. */
bool sbfi_is_program(const char *path);

#endif
