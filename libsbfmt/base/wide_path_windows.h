/* Converts UTF-8 paths for Windows calls. */
#ifndef SBFI_WIDE_PATH_WINDOWS_H
#define SBFI_WIDE_PATH_WINDOWS_H

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include "sbfmt/base.h"

enum { SBFI_WIDE_PATH = 4096 };

/* False if the path is not UTF-8 or too long. */
static inline bool sbfi_wide_path(const char *path, wchar_t to[SBFI_WIDE_PATH]) {
  return MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, to, SBFI_WIDE_PATH) > 0;
}

static inline bool sbfi_narrow_path(const wchar_t *path, char *to, size_t size) {
  return WideCharToMultiByte(CP_UTF8, 0, path, -1, to, size > INT32_MAX ? INT32_MAX : (int)size, NULL, NULL) >
         0;
}

#endif
