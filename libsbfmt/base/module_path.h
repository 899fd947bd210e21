/* Where the running program and this library lie, to find what is installed beside them. One implementation a
 * system (module_path_posix.c). */
#ifndef SBFI_MODULE_PATH_H
#define SBFI_MODULE_PATH_H

#include "sbfmt/base.h"

/* The folder, without a slash at its end, of the running program; of the shared library (or program) that
 * this code was linked into. False where the system does not say or `size` is too small. */
bool sbfi_program_folder(char *to, size_t size);
bool sbfi_library_folder(char *to, size_t size);

/* Whether the path names a regular file that this user may run. */
bool sbfi_is_program(const char *path);

#endif
