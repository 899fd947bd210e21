#include "cli.h"
#include "sbfmt/export.h"
#include "sbfmt/io.h"

static void report(void *user, const sbf_diagnostic *diagnostic) {
  cli_print_diagnostic(user, diagnostic);
}

static int run(cli_call *call) {
  const char *out = cli_value(call, "-o");
  long render_level = 0;
  if (!out) return cli_wrong(call, "say where to write: -o OUT.obj, OUT.tet or OUT.xml");
  if (!cli_integer(call, "--render-level", 0, 1000, &render_level)) return SBF_FAILED;
  sbf_asset *asset;
  sbf_diagnostic error;
  sbf_status status = sbf_load_file(call->inputs[0], NULL, &asset, &error);
  if (status == SBF_OK) {
    const sbf_export_options options = {
        .report = report, .user = call, .render_level = (uint32_t)render_level};
    status = sbf_export(asset, out, &options, &error);
    sbf_asset_free(asset);
  }
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  return (int)status;
}

static const cli_option options[] = {
    {"-o", "OUT.obj|.tet|.xml", "where to write; the ending says in which form"},
    {"--render-level", "N", "level of the meshes, 0 the full ones (0); where there are fewer, the last"},
    {NULL, NULL, NULL},
};
const cli_verb verb_export = {"export", "FILE -o OUT.obj|.tet|.xml", "write what other programs read",
    "Writes meshes at rest as OBJ with its MTL, tetrahedra as PhysX's .tet, or soft and rigid bodies with "
    "their\n"
    "joints in the 2012 dialect, .xml. Says what the form has no place for.",
    options, 1, 1, run};
