#include "fuzz_asset.h"

#include "fuzz.h"
#include "promises.h"

sbf_load_options fuzz_load_options(void) {
  return (sbf_load_options){
      .limits = {
          .file_bytes = 1 << 24, .memory_bytes = 1 << 26, .inflated_bytes = 1 << 26, .list_items = 1 << 22}};
}

void fuzz_check_failure(sbf_status status, const sbf_asset *asset, const sbf_diagnostic *error) {
  FUZZ_MUST(status == SBF_BAD_INPUT || status == SBF_FAILED);
  FUZZ_MUST(!asset);
  FUZZ_MUST(error->code != 0 && error->message[0]);
}

void fuzz_check_promises(const sbf_asset *asset) {
  const char *broken = promise_broken(asset);
  if (broken) fprintf(stderr, "%s\n", broken);
  FUZZ_MUST(!broken);
}

void fuzz_check_round_trip(const sbf_asset *asset, fuzz_save *save, fuzz_load *load) {
  sbf_buffer buffer = {0};
  sbf_asset *again = NULL;
  sbf_diagnostic trouble;
  char path[256];
  FUZZ_MUST(save(asset, NULL, NULL, &buffer, &trouble) == SBF_OK);
  /* An extension that is required is for the program that asks to know. */
  const char *names[16];
  sbf_load_options options = {.extensions = names};
  for (uint32_t i = 0; i < asset->extensions.count && i < 16; i++)
    names[options.extension_count++] = asset->extensions.at[i].name;
  sbf_status status = load(buffer.at, buffer.size, &options, &again, &trouble);
  if (status != SBF_OK) fprintf(stderr, "%s: %s\n", trouble.path, trouble.message);
  FUZZ_MUST(status == SBF_OK);
  bool equal = sbf_asset_equal(asset, again, path, sizeof path);
  if (!equal) fprintf(stderr, "%s differs\n", path);
  FUZZ_MUST(equal);
  sbf_asset_free(again);
  sbf_buffer_free(&buffer);
}

void fuzz_check_load(
    sbf_status status, sbf_asset *asset, const sbf_diagnostic *error, fuzz_save *save, fuzz_load *load) {
  if (status != SBF_OK) {
    fuzz_check_failure(status, asset, error);
    return;
  }
  fuzz_check_promises(asset);
  fuzz_check_round_trip(asset, save, load);
  sbf_asset_free(asset);
}

void fuzz_check_outline(const uint8_t *data, size_t size) {
  sbf_load_options options = fuzz_load_options();
  sbf_asset *asset = NULL;
  sbf_diagnostic error = {0};
  options.outline = true;
  sbf_status status = sbf_packed_load_memory(data, size, &options, &asset, &error);
  if (status != SBF_OK) fuzz_check_failure(status, asset, &error);
  sbf_asset_free(asset);
}

sbf_asset *fuzz_load_either(const uint8_t *data, size_t size) {
  sbf_load_options options = fuzz_load_options();
  sbf_asset *asset = NULL;
  sbf_diagnostic error = {0};
  fuzz_load *load = size && data[0] == 0x89 ? sbf_packed_load_memory : sbf_xml_load_memory;
  sbf_status status = load(data, size, &options, &asset, &error);
  if (status == SBF_OK)
    fuzz_check_promises(asset);
  else
    fuzz_check_failure(status, asset, &error);
  return asset;
}
