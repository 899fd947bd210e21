/* Paths of files that another file refers to. */
#ifndef SBFI_PATH_BESIDE_H
#define SBFI_PATH_BESIDE_H

#include "base/text.h"

/* Resolves `name`, written inside the file `path`: relative to that file's folder unless absolute, with
 * '/' as separator. False if it is empty, contains a NUL or does not fit. */
bool sbfi_path_beside(char *to, size_t size, const char *path, sbfi_span name);

#endif
