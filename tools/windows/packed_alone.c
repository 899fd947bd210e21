/* The program as far as it goes without an XML parser: what reads and moves packed bundles. */
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "render/fault.h"
#include "sbfmt/io.h"

extern const cli_verb verb_run;

const cli_verb *const cli_verbs[] = {&verb_run, NULL};

/* In place of the format library's: XML is told from packed by its first byte. */
sbf_status sbf_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  FILE *file = fopen(path, "rb");
  char first = 0;
  size_t got = file ? fread(&first, 1, 1, file) : 0;
  if (file) fclose(file);
  if (got && (first == '<' || first == '\xEF' || first == ' '))
    return fault_set_file(error, SBF_CODE_IO_UNKNOWN_FORMAT, path,
        "this program reads packed bundles alone: make one of it with `sbfmt pack` on Linux");
  return sbf_packed_load_file(path, options, asset, error);
}
