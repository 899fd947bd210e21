/* Hash of the input of a build: two assets with the same hash get the same derived parts. */
#ifndef SBFI_SOURCE_READING_H
#define SBFI_SOURCE_READING_H

#include "xml/source_hash.h"

/* SHA-256, in hexadecimal, of the canonical XML of the source parts that a build reads: bones, rigid bodies,
 * soft bodies, and shape and skin of render meshes. Changes of gaits, joints, materials, clips and so on make
 * nothing stale. The asset has passed sbf_asset_check. */
sbf_status sbfi_build_source_hash(
    const sbf_asset *asset, char text[SBFI_SHA256_TEXT_SIZE], sbf_diagnostic *error);

#endif
