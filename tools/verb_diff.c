/* sbfmt diff: compares two files. */
#include "cli.h"
#include "sbfmt/io.h"

static int run(cli_call *call) {
  sbf_asset *assets[2] = {NULL, NULL};
  sbf_diagnostic error;
  sbf_status status = SBF_OK;
  for (int i = 0; i < 2 && status == SBF_OK; i++) {
    status = sbf_load_file(call->inputs[i],
        &(sbf_load_options){.check_crc = true, .report = cli_report, .user = call}, &assets[i], &error);
    if (status != SBF_OK) cli_print_diagnostic(call, &error);
  }
  int result = SBF_FAILED; /* a file that cannot be compared is neither equal nor different */
  if (status == SBF_OK) {
    char path[256];
    result = sbf_asset_equal(assets[0], assets[1], path, sizeof path) ? 0 : 1;
    if (result) printf("differ at %s\n", path);
  }
  for (int i = 0; i < 2; i++) sbf_asset_free(assets[i]);
  return result;
}

static const cli_option options[] = {{NULL, NULL, NULL}};
const cli_verb verb_diff = {"diff", "A B", "compare the content of two files",
    "Compares two files of either form bit by bit, except for times measured on a machine.\n"
    "Exit status 0: equal; 1: different, the first difference is printed; 2: a file could not\n"
    "be read.",
    options, 2, 2, run};
