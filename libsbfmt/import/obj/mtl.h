/* Wavefront MTL: the materials of an OBJ file. */
#ifndef SBFI_MTL_H
#define SBFI_MTL_H

#include "import/scene/name_table.h"
#include "import/scene/scene.h"

/* Reads one library and sets those of the materials it describes, and their marks in `described`; `names`
 * numbers them. Images are appended to
 * `images` (sbfi_scene_image). Roughness is Pr, or where that is missing 1 - sqrt(Ns) / 30 (Blender's reading
 * of the specular exponent). What cannot be understood is passed over: a material never stops an import.
 * False where memory runs out. */
bool sbfi_mtl_read(sbfi_scene *scene, const char *bytes, size_t size, const sbfi_name_table *names,
    sbfi_scene_material *materials, bool *described, sbfi_array *images);

/* Default of a material that no library describes. */
sbfi_scene_material sbfi_mtl_default(const char *name);

#endif
