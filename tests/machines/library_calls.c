/* What the Python module does with the library, without its import library: opens the DLL by name, looks the
 * functions up, reads a bundle, checks it and writes it packed. library_calls LIBRARY.dll IN.sbf OUT.sbfz */
#include <stdio.h>
#include <windows.h>

#include "sbfmt/io.h"
#include "sbfmt/packed.h"
#include "sbfmt/validate.h"

typedef sbf_status load(const char *, const sbf_load_options *, sbf_asset **, sbf_diagnostic *);
typedef sbf_status validate(
    const sbf_asset *, const sbf_validate_options *, sbf_validate_result *, sbf_diagnostic *);
typedef sbf_status save(const sbf_asset *, const char *, const sbf_save_options *, sbf_diagnostic *);
typedef void release(sbf_asset *);

int main(int argc, char **argv) {
  sbf_diagnostic error;
  sbf_asset *asset;
  sbf_validate_result found;
  HMODULE library = argc == 4 ? LoadLibraryA(argv[1]) : NULL;
  if (!library)
    return fprintf(stderr, "the library cannot be opened: error %lu\n", (unsigned long)GetLastError()), 2;
  load *load_file = (load *)(void (*)(void))GetProcAddress(library, "sbf_load_file");
  validate *check = (validate *)(void (*)(void))GetProcAddress(library, "sbf_validate");
  save *save_file = (save *)(void (*)(void))GetProcAddress(library, "sbf_packed_save_file");
  release *release_asset = (release *)(void (*)(void))GetProcAddress(library, "sbf_asset_free");
  if (!load_file || !check || !save_file || !release_asset)
    return fprintf(stderr, "a function is missing\n"), 2;
  if (GetProcAddress(library, "sbfi_file_open") || GetProcAddress(library, "xmlFreeDoc"))
    return fprintf(stderr, "the library shows its insides\n"), 1;
  if (load_file(argv[2], NULL, &asset, &error) != SBF_OK) return fprintf(stderr, "%s\n", error.message), 1;
  if (check(asset, NULL, &found, &error) != SBF_OK || found.errors)
    return fprintf(stderr, "it is not valid\n"), 1;
  if (save_file(asset, argv[3], NULL, &error) != SBF_OK) return fprintf(stderr, "%s\n", error.message), 1;
  release_asset(asset);
  FreeLibrary(library);
  return 0;
}
