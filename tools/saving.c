#include "saving.h"

#include "checking.h"

int saving_run(const cli_call *call, const char *from, const char *out, const sbf_asset *asset,
    const sbf_save_options *options) {
  checked found = {.path = out};
  sbf_diagnostic error;
  check_loaded(asset, out, &found);
  sbf_status status = found.status;
  if (checked_is_valid(&found, false)) {
    status = sbf_save_file(asset, out, options, &error);
    if (status != SBF_OK) cli_print_diagnostic(call, &error);
  } else {
    unsigned errors = found.result.errors;
    if (status == SBF_OK) status = SBF_BAD_INPUT;
    checked_report(call, &found, NULL);
    cli_wrong(call, "%s is not written: what %s gives has %u error%s, listed above; repair the input there",
        out, from, errors, errors == 1 ? "" : "s");
  }
  findings_free(&found.found);
  return (int)status;
}
