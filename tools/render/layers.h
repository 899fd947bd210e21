/* Intermediate render targets of the drawing surface's size: depth of transparent surfaces, and lines.
 * Created at first use. */
#ifndef RENDER_LAYERS_H
#define RENDER_LAYERS_H

#include "render/gl_api.h"
#include "sbfmt/base.h"

typedef struct layer_set {
  GLsizei width, height;           /* pixels of the drawing surface */
  GLuint xray_texture, xray_frame; /* depth of the nearest transparent surface */
  /* Lines are anti-aliased by their shader and need no multisampling: a separate target with one sample
   * halves their cost. */
  GLuint line_texture, line_frame, line_depth;
} layer_set;

/* Creates them for a surface of this size. SBF_FAILED, with a message, if OpenGL has no memory; existing
 * ones are reused. */
sbf_status layers_make(
    layer_set *set, const gl_api *gl, GLsizei width, GLsizei height, sbf_diagnostic *diagnostic);
void layers_destroy(layer_set *set, const gl_api *gl);

#endif
