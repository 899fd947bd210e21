/* Objects outside the skeleton's node tree, such as a turret that is not parented to its tank. */
#ifndef SBFI_ATTACH_OBJECTS_H
#define SBFI_ATTACH_OBJECTS_H

#include "import/convert/conversion.h"

/* Attaches each loose object to the bone that it touches: through a skin or another attached object. Objects
 * larger than the character, or that end below its soles like a ground plane, stay loose.
 *
 * `skins` are the skinned meshes. `objects` holds one surface per scene mesh; NULL entries are not
 * attached. Writes c->bone_of_mesh and reports each as RIG_SECTION_GUESSED. */
sbf_status sbfi_attach_objects(sbfi_conversion *c, const sbf_render_mesh *skins, uint32_t skin_count,
    const sbf_polygon_mesh *const *objects);

#endif
