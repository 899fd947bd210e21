#include "import/sibling_path.h"

#include <string.h>

#include "base/file.h"

bool sbfi_sibling_path(char *to, size_t size, const char *path, sbfi_span name) {
  bool absolute = name.length && (*name.at == '/' || *name.at == '\\');
  size_t folder = absolute ? 0 : (size_t)(sbfi_path_name(path) - path);
  if (!name.length || memchr(name.at, 0, name.length) || folder >= size || name.length >= size - folder)
    return false;
  memcpy(to, path, folder);
  for (size_t i = 0; i < name.length; i++) to[folder + i] = (char)(name.at[i] == '\\' ? '/' : name.at[i]);
  to[folder + name.length] = 0;
  return true;
}
