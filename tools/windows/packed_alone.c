/* The program without an XML parser: commands that read and convert packed bundles. */
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "render/fault.h"
#include "sbfmt/io.h"

extern const cli_verb verb_run;

const cli_verb *const cli_verbs[] = {&verb_run, NULL};

/* Replaces that of the format library. The first byte distinguishes XML from packed. */
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
