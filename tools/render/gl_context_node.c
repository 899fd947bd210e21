/* WebAssembly under Node.js has no OpenGL. */
#include "render/gl_context.h"

#include "base/fault.h"

sbf_status draw_gl_context(draw_context *context, sbf_diagnostic *diagnostic) {
  *context = (draw_context){0};
  return fault_set(diagnostic, SBF_CODE_NO_OPENGL,
      "the program for Node.js draws no pictures: use the program for your system, or write a page with "
      "sbfmt export -o PAGE.html");
}
