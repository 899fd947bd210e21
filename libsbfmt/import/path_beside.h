/* The path of a file that another file refers to. */
#ifndef SBFI_PATH_BESIDE_H
#define SBFI_PATH_BESIDE_H

#include "base/text.h"

/* The path that `name`, written inside the file `path`, stands for: in that file's folder unless it is
 * absolute, with '/' between its parts. False where it is empty, holds a NUL or does not fit. */
bool sbfi_path_beside(char *to, size_t size, const char *path, sbfi_span name);

#endif
