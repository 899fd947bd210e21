#include "render/gl_api.h"

#include <stddef.h>

const char *gl_api_load(gl_api *gl, gl_function (*find)(const char *name, void *user), void *user) {
#define RENDER_GL_LOAD(type, name)                                                                           \
  if (!(gl->name = (type)find("gl" #name, user))) return "gl" #name;
  RENDER_GL_FUNCTIONS(RENDER_GL_LOAD)
#undef RENDER_GL_LOAD
  return NULL;
}
