/* sbfmt pack and unpack: from XML to the packed form and back. */
#include <string.h>

#include "output_name.h"
#include "sbfmt/io.h"

/* Loads the call's input and saves it as `save` does, under a name of that ending. */
static int transcode(cli_call *call, const char *ending, const sbf_save_options *options,
    sbf_status (*save)(const sbf_asset *, const char *, const sbf_save_options *, sbf_diagnostic *)) {
  const char *out = cli_value(call, "-o");
  if (!out) return cli_wrong(call, "say where to write: -o FILE%s", ending);
  if (!output_name_check(call, "-o", (const char *const[]){ending, NULL})) return SBF_FAILED;
  sbf_asset *asset;
  sbf_diagnostic error;
  sbf_status status = sbf_load_file(call->inputs[0],
      &(sbf_load_options){.check_crc = true, .report = cli_report, .user = call}, &asset, &error);
  if (status == SBF_OK) {
    status = save(asset, out, options, &error);
    sbf_asset_free(asset);
  }
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  return (int)status;
}

static int run_pack(cli_call *call) {
  long level = 6;
  if (!cli_integer(call, "--level", 1, 9, &level)) return SBF_FAILED;
  sbf_save_options options = {.store = cli_switch(call, "--store"), .level = (int)level};
  return transcode(call, ".sbfz", &options, sbf_packed_save_file);
}

static int run_unpack(cli_call *call) {
  return transcode(call, ".sbf", NULL, sbf_xml_save_file);
}

static const cli_option pack_options[] = {
    {"-o", "OUT.sbfz", "where to write"},
    {"--store", NULL, "leave the chunks uncompressed: larger, and used in place when loaded"},
    {"--level", "1..9", "how hard to compress (6)"},
    {NULL, NULL, NULL},
};
const cli_verb verb_pack = {"pack", "IN -o OUT.sbfz [--store] [--level 1..9]",
    "write the packed form of a file",
    "Reads either form and writes the packed one. The same content gives the same bytes.", pack_options, 1, 1,
    run_pack};

static const cli_option unpack_options[] = {
    {"-o", "OUT.sbf", "where to write"},
    {NULL, NULL, NULL},
};
const cli_verb verb_unpack = {"unpack", "IN -o OUT.sbf", "write the XML form of a file",
    "Reads either form and writes canonical XML. The same content gives the same bytes.", unpack_options, 1,
    1, run_unpack};
