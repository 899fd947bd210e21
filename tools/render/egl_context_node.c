/* WebAssembly under Node.js has no OpenGL. */
#include "render/egl_context.h"

#include "render/fault.h"

sbf_status draw_egl_context(draw_context *context, sbf_diagnostic *diagnostic) {
  *context = (draw_context){0};
  return fault_set(diagnostic, SBF_CODE_NO_OPENGL,
      "the program for Node.js draws no pictures: use the program for your system, or write a page with "
      "sbfmt export -o PAGE.html");
}
