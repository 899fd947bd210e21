/* Loads a character from binary glTF 2.0 with the extension SBF_soft_body
 * (spec/gltf/SBF_soft_body/README.md): meshes, materials and clips that every viewer shows, and the soft
 * bodies that move with them. Part of the core library; sbf_export (sbfmt/export.h) writes such files.
 *
 * A load that succeeds makes the same promises as the packed form's. */
#ifndef SBFMT_GLTF_H
#define SBFMT_GLTF_H

#include "sbfmt/packed.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether the bytes begin as binary glTF; 4 bytes suffice. */
SBF_API bool sbf_gltf_is_begun(const void *bytes, size_t size);

/* Whether the file is binary glTF with the extension. False if it cannot be read. */
SBF_API bool sbf_gltf_has_soft_bodies(const char *path);

/* Loads the asset. `options` may be NULL; `check_crc`, `selection`, `outline` and `given_lists` have no
 * effect. GLTF_NO_SOFT_BODY if the file lacks the extension, GLTF_CHANGED if another program has changed the
 * meshes or clips that it refers to. The asset keeps nothing of `bytes`. Thread safe. */
SBF_API sbf_status sbf_gltf_load_memory(const void *bytes, size_t size, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *error);
SBF_API sbf_status sbf_gltf_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error);

#ifdef __cplusplus
}
#endif
#endif
