/* Pictures of the drawing surface's size that go into it: depths of what is seen through, and the lines. Made
 * when first needed. */
#ifndef RENDER_LAYERS_H
#define RENDER_LAYERS_H

#include "render/gl_api.h"
#include "sbfmt/base.h"

typedef struct layer_set {
  GLsizei width, height;           /* pixels of the drawing surface */
  GLuint veil_texture, veil_frame; /* depths of the nearest surface that is seen through */
  /* Lines have edges of their own making, and gain nothing from four samples a pixel: drawn by themselves
   * with one, they cost half. */
  GLuint line_texture, line_frame, line_depth;
} layer_set;

/* For a surface of this size. SBF_FAILED, with a message, where OpenGL has no room; made before is fine. */
sbf_status layers_make(
    layer_set *set, const gl_api *gl, GLsizei width, GLsizei height, sbf_diagnostic *diagnostic);
void layers_destroy(layer_set *set, const gl_api *gl);

#endif
