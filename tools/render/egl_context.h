/* OpenGL 3.3 without a window or a display, through EGL. */
#ifndef RENDER_EGL_CONTEXT_H
#define RENDER_EGL_CONTEXT_H

#include "render/canvas.h"

#define DRAW_INSTALL_OPENGL                                                                                  \
  "install Mesa's EGL and OpenGL (Debian, Ubuntu: apt install libegl1 libgl1-mesa-dri)"

/* Creates a context, current for this thread; closing it is up to the receiver. SBF_FAILED, with a message
 * that says what to install, if there is none. */
sbf_status draw_egl_context(draw_context *context, sbf_diagnostic *diagnostic);

#endif
