/* Location of the program and the library, from Windows. */
#include "base/module_path.h"

#include <string.h>

#include "base/wide_path_windows.h"

static bool folder_of(HMODULE module, char *to, size_t size) {
  wchar_t path[SBFI_WIDE_PATH];
  DWORD length = GetModuleFileNameW(module, path, SBFI_WIDE_PATH);
  if (length == 0 || length == SBFI_WIDE_PATH) return false;
  wchar_t *slash = wcsrchr(path, L'\\');
  if (!slash) return false;
  *slash = 0;
  return sbfi_narrow_path(path, to, size);
}

bool sbfi_program_folder(char *to, size_t size) {
  return folder_of(NULL, to, size);
}

bool sbfi_library_folder(char *to, size_t size) {
  static const char here = 0; /* any address of this module */
  HMODULE module;
  return GetModuleHandleExW(
             GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
             (const wchar_t *)(const void *)&here, &module) &&
         folder_of(module, to, size);
}

bool sbfi_is_program(const char *path) {
  wchar_t wide[SBFI_WIDE_PATH];
  DWORD kind;
  return sbfi_wide_path(path, wide) && GetBinaryTypeW(wide, &kind);
}
