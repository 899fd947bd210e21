/* sbfmt pack and unpack: converts between the text form and the others. */
#include <string.h>

#include "output_name.h"
#include "saving.h"

/* Loads the call's input and saves it under a name whose extension selects the form. */
static int transcode(cli_call *call, const char *const *endings, const sbf_save_options *options) {
  const char *out = cli_value(call, "-o");
  if (!out) return cli_wrong(call, "state the output: -o FILE%s", endings[0]);
  if (!output_name_check(call, "-o", endings)) return SBF_FAILED;
  sbf_asset *asset;
  sbf_diagnostic error;
  sbf_status status = sbf_load_file(call->inputs[0],
      &(sbf_load_options){.check_crc = true, .report = cli_report, .user = call}, &asset, &error);
  if (status != SBF_OK) {
    cli_print_diagnostic(call, &error);
    return (int)status;
  }
  int saved = saving_run(call, call->inputs[0], out, asset, options);
  sbf_asset_free(asset);
  return saved;
}

static int run_pack(cli_call *call) {
  long level = 6;
  if (!cli_integer(call, "--level", 1, 9, &level)) return SBF_FAILED;
  sbf_save_options options = {.store = cli_switch(call, "--store"), .level = (int)level};
  return transcode(call, (const char *const[]){".sbfz", ".glb", NULL}, &options);
}

static int run_unpack(cli_call *call) {
  return transcode(call, (const char *const[]){".sbf", NULL}, NULL);
}

static const cli_option pack_options[] = {
    {"-o", "OUT.sbfz|.glb", "where to write"},
    {"--store", NULL, "leave lists uncompressed: larger; in .sbfz they are used in place when loaded"},
    {"--level", "1..9", "how hard to compress (6)"},
    {NULL, NULL, NULL},
};
const cli_verb verb_pack = {"pack", "IN -o OUT.sbfz|.glb [--store] [--level 1..9]",
    "write the packed form of a file, or a .glb",
    "Reads any form and writes the packed one, or binary glTF: meshes, materials and clips that\n"
    "every viewer shows, and all the rest as the extension SBF_soft_body (docs/gltf.md). Equal\n"
    "content gives equal bytes. A file that `sbfmt validate` would refuse is not written.",
    pack_options, 1, 1, run_pack};

static const cli_option unpack_options[] = {
    {"-o", "OUT.sbf", "where to write"},
    {NULL, NULL, NULL},
};
const cli_verb verb_unpack = {"unpack", "IN -o OUT.sbf", "write the XML form of a file",
    "Reads any form and writes canonical XML. Equal content gives equal bytes. A file that\n"
    "`sbfmt validate` would refuse is not written; `sbfmt validate --fix -o OUT.sbf` writes\n"
    "it after the possible repairs.",
    unpack_options, 1, 1, run_unpack};
