/* sbfmt build: rebuilds the derived parts. */
#include "building.h"
#include "material_options.h"
#include "output_name.h"
#include "saving.h"

static int run(cli_call *call) {
  const char *out = cli_value(call, "-o");
  if (!out) return cli_wrong(call, "state the output: -o FILE");
  if (!output_name_of_bundle(call, "-o") || !building_check(call) || !materials_check(call))
    return SBF_FAILED;
  sbf_asset *asset;
  sbf_build_report made;
  sbf_diagnostic error;
  sbf_status status = sbf_load_file(call->inputs[0],
      &(sbf_load_options){.check_crc = true, .report = cli_report, .user = call}, &asset, &error);
  if (status == SBF_OK && !materials_apply(call, asset)) {
    sbf_asset_free(asset);
    return SBF_FAILED;
  }
  if (status == SBF_OK) status = building_run(call, &asset, &made, &error);
  if (status != SBF_OK) {
    cli_print_diagnostic(call, &error);
    return (int)status;
  }
  int saved = saving_run(call, call->inputs[0], out, asset, NULL);
  if (saved == SBF_OK) building_print(asset, &made);
  sbf_asset_free(asset);
  return saved;
}

static const cli_option options[] = {
    {"-o", "OUT.sbf[z]", "output file; the ending selects XML or packed"},
    BUILDING_OPTIONS,
    MATERIALS_OPTION,
    {NULL, NULL, NULL},
};
const cli_verb verb_build = {"build", "IN -o OUT [--springs METHOD] [--cell METRES] [--elements N]",
    "make the derived parts of a bundle again",
    "Deletes every part marked derived and makes it again from the source parts: springs or\n"
    "tetrahedra, pins, embeddings, hulls. Authored parts are kept. Equal input and options\n"
    "give equal bytes. A result that `sbfmt validate` would refuse is not written.",
    options, 1, 1, run};
