/* Images as textures of OpenGL, each made once. */
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

/* The image's texture, smoothed and repeated; of NULL a white one; 0 where there is none to be had. Takes the
 * place of what is bound to the active unit where it makes one. */
GLuint image_textures_of(image_textures *textures, const gl_api *gl, const draw_image *image);
void image_textures_destroy(image_textures *textures, const gl_api *gl);

#endif
