#include "render/layers.h"

#include "base/fault.h"
#include "render/light_maps.h"

static bool make_line_layer(layer_set *set, const gl_api *gl) {
  gl->GenTextures(1, &set->line_texture);
  gl->BindTexture(GL_TEXTURE_2D, set->line_texture);
  gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, set->width, set->height, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  gl->GenRenderbuffers(1, &set->line_depth);
  gl->BindRenderbuffer(GL_RENDERBUFFER, set->line_depth);
  gl->RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, set->width, set->height);
  gl->GenFramebuffers(1, &set->line_frame);
  gl->BindFramebuffer(GL_FRAMEBUFFER, set->line_frame);
  gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, set->line_texture, 0);
  gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, set->line_depth);
  return gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

sbf_status layers_make(
    layer_set *set, const gl_api *gl, GLsizei width, GLsizei height, sbf_diagnostic *diagnostic) {
  if (set->line_frame && set->width == width && set->height == height) return SBF_OK;
  if (set->line_frame) layers_destroy(set, gl);
  set->width = width, set->height = height;
  gl->ActiveTexture(GL_TEXTURE0);
  bool good = light_maps_make_depth(gl, width, height, &set->xray_texture, &set->xray_frame);
  good = make_line_layer(set, gl) && good;
  if (good && gl->GetError() == GL_NO_ERROR) return SBF_OK;
  layers_destroy(set, gl);
  return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY,
      "OpenGL has no room to draw lines on %dx%d pixels: ask for a smaller picture", (int)width, (int)height);
}

void layers_destroy(layer_set *set, const gl_api *gl) {
  GLuint textures[] = {set->xray_texture, set->line_texture};
  GLuint frames[] = {set->xray_frame, set->line_frame};
  gl->DeleteTextures(2, textures);
  gl->DeleteFramebuffers(2, frames);
  gl->DeleteRenderbuffers(1, &set->line_depth);
  *set = (layer_set){0};
}
