/* Appearance of an asset's materials: base colours, and their images. */
#ifndef SKIN_MATERIAL_H
#define SKIN_MATERIAL_H

#include "render/draw_scene.h"
#include "sbfmt/asset.h"

/* Images of base colours. All zero: none are drawn. */
typedef struct skin_images {
  draw_image **at; /* (textures of the asset) NULL: not drawn */
  uint32_t count;
} skin_images;

/* Reads the images from the asset, or from files beside `file`, the asset's path. Reports an image that
 * cannot be drawn to `note`; its material's colour is used instead. */
typedef void (*skin_image_note)(void *user, const sbf_diagnostic *note);
void skin_images_load(
    skin_images *images, const sbf_asset *asset, const char *file, skin_image_note note, void *user);
void skin_images_free(skin_images *images);

/* Appearance of one material slot of a mesh. */
typedef struct skin_material {
  draw_colour colour;
  const draw_image *image;    /* NULL: none */
  sbf_vec4 base;              /* linear: source of `colour`, and factor of vertex colours */
  bool has_colours;           /* the mesh has vertex colours: skin_corner_colour */
  const sbf_uv_transform *uv; /* NULL: none */
  draw_alpha alpha;
  float cutoff;
  bool one_sided;
} skin_material;
skin_material skin_material_of(
    const sbf_asset *asset, const skin_images *images, const sbf_render_mesh *mesh, uint32_t slot);

/* Texture coordinates of a corner of the full mesh; the mesh has them if its material has an image.
 */
sbf_vec2 skin_corner_uv(const sbf_render_mesh *mesh, const skin_material *style, uint32_t corner);

/* Colour of a corner, if has_colours. */
draw_colour skin_corner_colour(const sbf_render_mesh *mesh, const skin_material *style, uint32_t corner);

/* Fills the material of a mesh to be drawn, except texture coordinates and colours. */
void skin_material_apply(const skin_material *style, draw_mesh *mesh);

#endif
