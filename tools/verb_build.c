/* sbfmt build: makes what is derived anew. */
#include "building.h"
#include "material_options.h"
#include "output_name.h"

static int run(cli_call *call) {
  const char *out = cli_value(call, "-o");
  if (!out) return cli_wrong(call, "say where to write: -o FILE");
  if (!output_name_of_bundle(call, "-o") || !building_check(call) || !materials_check(call))
    return SBF_FAILED;
  sbf_asset *asset;
  sbf_diagnostic error;
  sbf_status status = sbf_load_file(call->inputs[0],
      &(sbf_load_options){.check_crc = true, .report = cli_report, .user = call}, &asset, &error);
  if (status == SBF_OK && !materials_apply(call, asset)) {
    sbf_asset_free(asset);
    return SBF_FAILED;
  }
  if (status == SBF_OK) status = building_run(call, &asset, &error);
  if (status == SBF_OK) {
    status = sbf_save_file(asset, out, NULL, &error);
    sbf_asset_free(asset);
  }
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  return (int)status;
}

static const cli_option options[] = {
    {"-o", "OUT.sbf[z]", "where to write, by its ending as XML or packed"},
    BUILDING_OPTIONS,
    MATERIALS_OPTION,
    {NULL, NULL, NULL},
};
const cli_verb verb_build = {"build", "IN -o OUT [--springs METHOD] [--cell METRES] [--elements N]",
    "make the derived parts of a bundle anew",
    "Every part marked derived is dropped and made again from the source parts: springs or tetrahedra, pins, "
    "embeddings, hulls.\n"
    "Authored parts are kept as they are. The same input and options give the same bytes.",
    options, 1, 1, run};
