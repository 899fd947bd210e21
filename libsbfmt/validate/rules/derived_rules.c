/* Derived parts store a hash of their source: a different source makes them stale. */
#include <string.h>

#include "build/source_reading.h"
#include "validate/validation.h"

void sbfi_check_derived(sbfi_validation *v) {
  char hash[SBFI_SHA256_TEXT_SIZE];
  bool hashed = false;
  for (uint32_t i = 0; i < v->asset->derivations.count; i++) {
    const sbf_derivation *derivation = &v->asset->derivations.at[i];
    if (derivation->source_hash[0] == 0) continue;
    if (!hashed && sbfi_build_source_hash(v->asset, hash, NULL) != SBF_OK) {
      v->out_of_memory = true;
      return;
    }
    hashed = true;
    if (strcmp(hash, derivation->source_hash) != 0)
      sbfi_found(v, SBF_CODE_DERIVED_STALE, sbfi_path_of("/sbf/derivations/derivation[%u]", i + 1).text, -1,
          "the source has changed since '%s' built the derived parts", derivation->id);
  }
}
