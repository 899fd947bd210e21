/* Objects that lie loose in a file beside its skeleton: a turret that nobody parented to the tank. */
#ifndef SBFI_ATTACH_OBJECTS_H
#define SBFI_ATTACH_OBJECTS_H

#include "import/convert/conversion.h"

/* Gives each loose object the bone of what it touches: of the skin there, or of another object that has one.
 * Left loose are those larger than the character, and those that end below its soles, as the ground does.
 *
 * `skins` are the skinned meshes; `objects` has a surface for each mesh of the scene that may be attached,
 * else NULL. Writes c->bone_of_mesh, reports each as RIG_SECTION_GUESSED. */
sbf_status sbfi_attach_objects(sbfi_conversion *c, const sbf_render_mesh *skins, uint32_t skin_count,
    const sbf_polygon_mesh *const *objects);

#endif
