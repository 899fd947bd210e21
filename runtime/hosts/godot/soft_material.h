/* Materials of an asset as Godot's. */
#ifndef SBFMT_GODOT_SOFT_MATERIAL_H
#define SBFMT_GODOT_SOFT_MATERIAL_H

#include "soft_character.h"

/* Of a slot of a render mesh: a StandardMaterial3D, shared by all nodes with the asset. */
gd_variant soft_material_of(const soft_character *one, const sbf_render_mesh *mesh, uint32_t slot);
/* Transform of its texture coordinates, that of its first texture; NULL: none. */
const sbf_uv_transform *soft_material_uv(const sbf_material *material);

#endif
