#include "xml/source_hash.h"

#include "model/asset_box.h"
#include "xml/xml_writer.h"

static sbf_status add_to_hash(void *user, const void *bytes, size_t size, sbf_diagnostic *error) {
  (void)error;
  sbfi_sha256_update(user, bytes, size);
  return SBF_OK;
}

sbf_status sbfi_source_hash(const sbf_asset *asset, bool (*keep)(void *user, const sbfi_element_path *child),
    void *user, char text[SBFI_SHA256_TEXT_SIZE], sbf_diagnostic *error) {
  const sbfi_xml_selection selection = {.source_only = true, .keep = keep, .user = user};
  sbfi_sha256 hash;
  sbfi_text buffer;
  sbfi_sha256_init(&hash);
  sbfi_text_init(&buffer, &sbfi_asset_box_of(asset)->arena.allocator);
  sbf_status status = sbfi_xml_write(asset, &selection, &buffer, &(sbfi_xml_sink){add_to_hash, &hash}, error);
  sbfi_text_free(&buffer);
  if (status != SBF_OK) return status;
  uint8_t digest[SBFI_SHA256_BYTES];
  sbfi_sha256_finish(&hash, digest);
  sbfi_sha256_format(digest, text);
  return SBF_OK;
}
