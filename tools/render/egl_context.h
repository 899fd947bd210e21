/* OpenGL 3.3 without a window or a display, through EGL. */
#ifndef RENDER_EGL_CONTEXT_H
#define RENDER_EGL_CONTEXT_H

#include "render/canvas.h"

#define DRAW_INSTALL_OPENGL                                                                                  \
  "install Mesa's EGL and OpenGL (Debian, Ubuntu: apt install libegl1 libgl1-mesa-dri)"

/* Makes one, current for this thread; what comes of it closes it. SBF_FAILED, with a message that says what
 * to install, where there is none to be had. */
sbf_status draw_egl_context(draw_context *context, sbf_diagnostic *diagnostic);

#endif
