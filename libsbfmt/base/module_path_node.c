/* Location of a program in WebAssembly: under Node.js the folder of the script that has loaded it. */
#include <emscripten.h>
#include <sys/stat.h>

#include "base/module_path.h"

EM_JS(int, copy_script_folder, (char *to, int size), {
  const folder = Module.programFolder();
  if (lengthBytesUTF8(folder) >= size) return 0;
  stringToUTF8(folder, to, size);
  return 1;
})

bool sbfi_program_folder(char *to, size_t size) {
  return copy_script_folder(to, (int)size);
}

bool sbfi_library_folder(char *to, size_t size) {
  return sbfi_program_folder(to, size);
}

/* Any script: packages need not keep the permission to execute it. */
bool sbfi_is_program(const char *path) {
  struct stat about;
  return stat(path, &about) == 0 && S_ISREG(about.st_mode);
}
