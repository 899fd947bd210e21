/* Corner colours and the order of texture coordinate sets. */
#ifndef SBFI_CONVERT_COLORS_H
#define SBFI_CONVERT_COLORS_H

#include "import/convert/conversion.h"

/* Fills colors and color_corners; `corner_order` maps the asset's corners to the scene's. Skips colours
 * that are all white, and those of formats where programs store other data in colours. */
sbf_status sbfi_convert_colors(
    sbfi_conversion *c, const sbfi_scene_mesh *mesh, const uint32_t *corner_order, sbf_render_mesh *render);

/* Texture coordinate set used by base colour images of the mesh; it must come first. If materials differ,
 * the first material's set is used, with a warning. */
uint32_t sbfi_first_uv_set(sbfi_conversion *c, const sbfi_scene_mesh *mesh);

#endif
