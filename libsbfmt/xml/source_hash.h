/* Hash of the source parts from which a derivation was made. */
#ifndef SBFI_SOURCE_HASH_H
#define SBFI_SOURCE_HASH_H

#include "base/sha256.h"
#include "model/element_path.h"

/* SHA-256, in hexadecimal, of the canonical XML of all source parts: without derived parts, derivation
 * records and machine-dependent values. `keep` restricts it to the parts that a build pass reads; it is
 * called for every child element; NULL keeps all. The asset has passed sbf_asset_check. */
sbf_status sbfi_source_hash(const sbf_asset *asset, bool (*keep)(void *user, const sbfi_element_path *child),
    void *user, char text[SBFI_SHA256_TEXT_SIZE], sbf_diagnostic *error);

#endif
