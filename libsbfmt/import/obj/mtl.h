/* Wavefront MTL: the materials of an OBJ file. */
#ifndef SBFI_MTL_H
#define SBFI_MTL_H

#include "import/scene/name_table.h"
#include "import/scene/scene.h"

/* Reads a library, sets the materials that it describes, and marks them in `described`; `names` numbers
 * them. Appends images to `images` (sbfi_scene_image). Roughness is Pr, or 1 - sqrt(Ns) / 30 (Blender's
 * interpretation of the specular exponent). Ignores invalid statements: a material never stops an import.
 * False if memory runs out. */
bool sbfi_mtl_read(sbfi_scene *scene, const char *bytes, size_t size, const sbfi_name_table *names,
    sbfi_scene_material *materials, bool *described, sbfi_array *images);

/* Default for a material without a description. */
sbfi_scene_material sbfi_mtl_default(const char *name);

#endif
