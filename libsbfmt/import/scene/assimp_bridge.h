/* Reads every format of assimp into a scene: the program sbfmt-import reads the file in a separate
 * process. */
#ifndef SBFI_ASSIMP_BRIDGE_H
#define SBFI_ASSIMP_BRIDGE_H

#include "import/scene/scene.h"

/* Fills a scene after sbfi_scene_init. On failure the caller must free it. */
sbf_status sbfi_assimp_read(
    sbfi_scene *scene, const char *path, const sbfi_scene_options *options, sbf_diagnostic *error);

/* Reads a stream from the child; scene->format is set. `bytes` is aligned to 4. */
sbf_status sbfi_assimp_parse(sbfi_scene *scene, const uint8_t *bytes, size_t size,
    const sbf_allocator *allocator, sbf_diagnostic *error);

#endif
