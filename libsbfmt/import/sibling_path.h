/* Paths of files that another file refers to. */
#ifndef SBFI_SIBLING_PATH_H
#define SBFI_SIBLING_PATH_H

#include "base/text.h"

/* Resolves `name`, written inside the file `path`: relative to that file's folder unless absolute, with
 * '/' as separator. False if it is empty, contains a NUL or does not fit. */
bool sbfi_sibling_path(char *to, size_t size, const char *path, sbfi_span name);

#endif
