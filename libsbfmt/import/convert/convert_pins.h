/* Pins requested by name: from vertex groups and skin weights to pin sets. */
#ifndef SBFI_CONVERT_PINS_H
#define SBFI_CONVERT_PINS_H

#include "import/convert/conversion.h"

/* Checks that every requested pin names a group of some mesh and a bone of the rig. The error names the
 * first that does not. */
sbf_status sbfi_convert_check_pins(sbfi_conversion *c);

/* Whether a requested pin names a group of the mesh. */
bool sbfi_mesh_is_pinned(const sbfi_conversion *c, const sbfi_scene_mesh *mesh);

/* Adds pin sets to the body of a mesh, one for each pin that names a group of the mesh, by the rule of
 * sbf_convert_options. False if memory runs out. */
bool sbfi_pin_body(sbfi_conversion *c, const sbfi_scene_mesh *mesh, sbf_soft_body *body);

/* Adds pin sets to a skin, one for each hold that names a group of the mesh. False if memory runs out. */
bool sbfi_pin_skin(sbfi_conversion *c, const sbfi_scene_mesh *mesh, sbf_render_mesh *skin);

/* Stored weight of a goal of `weight` in 0..1; see sbf_convert_options. */
static inline float sbfi_goal_weight(double weight) {
  return (float)(weight / (2 - weight));
}

#endif
