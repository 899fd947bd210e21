/* What the materials of an asset look like when drawn: base colours, and the images on them. */
#ifndef SKIN_MATERIAL_H
#define SKIN_MATERIAL_H

#include "render/draw_scene.h"
#include "sbfmt/asset.h"

/* The images that base colours name. All zero: none are drawn. */
typedef struct skin_images {
  draw_image **at; /* (textures of the asset) NULL: not drawn */
  uint32_t count;
} skin_images;

/* Reads the images from the asset, or from files beside `file`, where the asset is from. An image that cannot
 * be drawn is reported to `note`; its material's colour is used instead. */
typedef void (*skin_image_note)(void *user, const sbf_diagnostic *note);
void skin_images_load(
    skin_images *images, const sbf_asset *asset, const char *file, skin_image_note note, void *user);
void skin_images_free(skin_images *images);

/* The look of one material slot of a mesh. */
typedef struct skin_material {
  draw_colour colour;
  const draw_image *image; /* NULL: none */
  sbf_vec4 base;    /* linear: what `colour` is made of, and what colours of points are multiplied by */
  bool has_colours; /* the mesh has vertex colours: skin_corner_colour */
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

/* Its colour, where the look says that the mesh has colours. */
draw_colour skin_corner_colour(const sbf_render_mesh *mesh, const skin_material *style, uint32_t corner);

/* Fills what the look says of a mesh to be drawn but its images' places and colours. */
void skin_material_apply(const skin_material *style, draw_mesh *mesh);

#endif
