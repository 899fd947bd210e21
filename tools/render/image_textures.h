/* Textures of images, each created once. */
#ifndef RENDER_IMAGE_TEXTURES_H
#define RENDER_IMAGE_TEXTURES_H

#include "render/base_image.h"
#include "render/gl_api.h"

typedef struct image_textures {
  struct image_texture {
    const draw_image *image;
    GLuint texture;
  } * at;
  size_t count;
} image_textures;

/* Texture of the image, filtered and repeated; for NULL a white one; 0 on failure. A new texture replaces
 * the binding of the active unit. */
GLuint image_textures_of(image_textures *textures, const gl_api *gl, const draw_image *image);
void image_textures_destroy(image_textures *textures, const gl_api *gl);

#endif
