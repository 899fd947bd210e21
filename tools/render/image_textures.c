#include "render/image_textures.h"

#include <stdlib.h>

static GLuint make(const gl_api *gl, const draw_image *image) {
  static const uint8_t white[4] = {255, 255, 255, 255};
  GLint max = 0;
  GLuint made = 0, width = image ? image->width : 1, height = image ? image->height : 1;
  gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &max);
  if (width > (GLuint)max || height > (GLuint)max) return 0;
  gl->GenTextures(1, &made);
  gl->BindTexture(GL_TEXTURE_2D, made);
  gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, (GLsizei)width, (GLsizei)height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
      image ? image->rgba : white);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl->GenerateMipmap(GL_TEXTURE_2D);
  return made;
}

GLuint image_textures_of(image_textures *textures, const gl_api *gl, const draw_image *image) {
  for (size_t i = 0; i < textures->count; i++)
    if (textures->at[i].image == image) return textures->at[i].texture;
  struct image_texture *grown = realloc(textures->at, (textures->count + 1) * sizeof *grown);
  if (!grown) return 0;
  textures->at = grown;
  grown[textures->count] = (struct image_texture){image, make(gl, image)};
  return grown[textures->count++].texture;
}

void image_textures_destroy(image_textures *textures, const gl_api *gl) {
  for (size_t i = 0; i < textures->count; i++) gl->DeleteTextures(1, &textures->at[i].texture);
  free(textures->at);
  *textures = (image_textures){NULL, 0};
}
