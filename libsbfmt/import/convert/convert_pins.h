/* Pins asked for by name: from vertex groups and skin weights to pin sets. */
#ifndef SBFI_CONVERT_PINS_H
#define SBFI_CONVERT_PINS_H

#include "import/convert/conversion.h"

/* Whether every pin that the options ask for names a group of some mesh and a bone of the rig; else an error
 * that says which does not. */
sbf_status sbfi_convert_check_pins(sbfi_conversion *c);

/* Whether one of the pins names a group that the mesh has. */
bool sbfi_mesh_is_pinned(const sbfi_conversion *c, const sbfi_scene_mesh *mesh);

/* Gives the body that the mesh became its pin sets, one for each pin that names a group of the mesh, by the
 * rule of sbf_convert_options. False where memory runs out. */
bool sbfi_pin_body(sbfi_conversion *c, const sbfi_scene_mesh *mesh, sbf_soft_body *body);

/* Gives a skin the pin sets of the holds that name a group of the mesh. False where memory runs out. */
bool sbfi_hold_skin(sbfi_conversion *c, const sbfi_scene_mesh *mesh, sbf_render_mesh *skin);

/* The weight in a file of a goal of `weight` in 0..1; see sbf_convert_options. */
static inline float sbfi_goal_weight(double weight) {
  return (float)(weight / (2 - weight));
}

#endif
