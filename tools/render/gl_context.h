/* OpenGL 3.3 without a window that one sees: one implementation per system (gl_context_posix.c, through EGL;
 * gl_context_windows.c; gl_context_node.c, which has none). */
#ifndef RENDER_GL_CONTEXT_H
#define RENDER_GL_CONTEXT_H

#include "render/canvas.h"

#ifdef _WIN32
#define DRAW_INSTALL_OPENGL "install the graphics card's driver"
#else
#define DRAW_INSTALL_OPENGL                                                                                  \
  "install Mesa's EGL and OpenGL (Debian, Ubuntu: apt install libegl1 libgl1-mesa-dri)"
#endif

/* Creates a context, current for this thread; closing it is up to the receiver. SBF_FAILED, with a message
 * that says what to install, if there is none. */
sbf_status draw_gl_context(draw_context *context, sbf_diagnostic *diagnostic);

#endif
