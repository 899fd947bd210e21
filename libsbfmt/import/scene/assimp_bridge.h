/* Every form that assimp reads, to a scene: the program sbfmt-import reads the file in a process of its own.
 */
#ifndef SBFI_ASSIMP_BRIDGE_H
#define SBFI_ASSIMP_BRIDGE_H

#include "import/scene/scene.h"

/* Fills a scene that sbfi_scene_init made. Leaves it to the caller to free on failure. */
sbf_status sbfi_assimp_read(
    sbfi_scene *scene, const char *path, const sbfi_scene_options *options, sbf_diagnostic *error);

/* The same from a stream the child wrote; scene->format is set. `bytes` is at a multiple of 4. */
sbf_status sbfi_assimp_take(sbfi_scene *scene, const uint8_t *bytes, size_t size,
    const sbf_allocator *allocator, sbf_diagnostic *error);

#endif
