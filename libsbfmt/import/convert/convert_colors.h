/* Colours of corners, and which set of texture coordinates stands first. */
#ifndef SBFI_CONVERT_COLORS_H
#define SBFI_CONVERT_COLORS_H

#include "import/convert/conversion.h"

/* Fills colors and color_corners; `corner_order` gives the scene's corner at each of the asset's. Where all
 * are white, or programs use colours of such a file for something else, none are taken. */
sbf_status sbfi_convert_colors(
    sbfi_conversion *c, const sbfi_scene_mesh *mesh, const uint32_t *corner_order, sbf_render_mesh *render);

/* The set that base colour images of the mesh are drawn by: it must stand first. Where its materials differ,
 * the first one's, and a warning. */
uint32_t sbfi_first_uv_set(sbfi_conversion *c, const sbfi_scene_mesh *mesh);

#endif
