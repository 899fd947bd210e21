#include "render/gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"
#include "base/system.h"

/* libEGL is loaded at run time. */
#define EGL_MEMBERS(X)                                                                                       \
  X(PFNEGLGETPROCADDRESSPROC, GetProcAddress)                                                                \
  X(PFNEGLQUERYSTRINGPROC, QueryString)                                                                      \
  X(PFNEGLGETDISPLAYPROC, GetDisplay)                                                                        \
  X(PFNEGLINITIALIZEPROC, Initialize)                                                                        \
  X(PFNEGLBINDAPIPROC, BindAPI)                                                                              \
  X(PFNEGLCHOOSECONFIGPROC, ChooseConfig)                                                                    \
  X(PFNEGLCREATECONTEXTPROC, CreateContext)                                                                  \
  X(PFNEGLDESTROYCONTEXTPROC, DestroyContext)                                                                \
  X(PFNEGLMAKECURRENTPROC, MakeCurrent)                                                                      \
  X(PFNEGLGETERRORPROC, GetError)

typedef struct egl_api {
#define EGL_MEMBER(type, name) type name;
  EGL_MEMBERS(EGL_MEMBER)
#undef EGL_MEMBER
} egl_api;

typedef struct egl_context {
  egl_api egl;
  EGLDisplay display;
  EGLContext context;
} egl_context;

static sbf_status load_egl(egl_api *egl, sbf_diagnostic *diagnostic) {
  void *library = system_open_library("libEGL.so.1");
  if (!library)
    return fault_set(
        diagnostic, SBF_CODE_NO_OPENGL, "libEGL.so.1 is not on this machine: " DRAW_INSTALL_OPENGL);
#define EGL_LOAD(type, name)                                                                                 \
  if (!(egl->name = (type)system_library_function(library, "egl" #name)))                                    \
    return fault_set(diagnostic, SBF_CODE_NO_OPENGL, "libEGL.so.1 has no egl" #name ": " DRAW_INSTALL_OPENGL);
  EGL_MEMBERS(EGL_LOAD)
#undef EGL_LOAD
  return SBF_OK;
}

static bool names_extension(const char *list, const char *name) {
  size_t length = strlen(name);
  for (const char *at = list; at && (at = strstr(at, name)); at += length)
    if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0)) return true;
  return false;
}

/* Without a surface or a window system if EGL supports that; otherwise EGL's default display. */
static EGLDisplay find_display(const egl_api *egl) {
  const char *extensions = egl->QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display =
      (PFNEGLGETPLATFORMDISPLAYEXTPROC)egl->GetProcAddress("eglGetPlatformDisplayEXT");
  if (platform_display && names_extension(extensions, "EGL_MESA_platform_surfaceless")) {
    EGLDisplay display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (display != EGL_NO_DISPLAY) return display;
  }
  return egl->GetDisplay(EGL_DEFAULT_DISPLAY);
}

static sbf_status open_context(egl_context *made, sbf_diagnostic *diagnostic) {
  const egl_api *egl = &made->egl;
  static const EGLint context_wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3,
      EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  static const EGLint config_wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  made->display = find_display(egl);
  if (made->display == EGL_NO_DISPLAY || !egl->Initialize(made->display, NULL, NULL)) {
    made->display = EGL_NO_DISPLAY;
    return fault_set(diagnostic, SBF_CODE_NO_OPENGL,
        "EGL finds nothing to draw with (error 0x%04x): " DRAW_INSTALL_OPENGL, (unsigned)egl->GetError());
  }
  const char *extensions = egl->QueryString(made->display, EGL_EXTENSIONS);
  if (!names_extension(extensions, "EGL_KHR_surfaceless_context"))
    return fault_set(
        diagnostic, SBF_CODE_NO_OPENGL, "EGL cannot draw without a window here: " DRAW_INSTALL_OPENGL);
  EGLConfig config = EGL_NO_CONFIG_KHR;
  EGLint found = 0;
  if (!names_extension(extensions, "EGL_KHR_no_config_context"))
    egl->ChooseConfig(made->display, config_wanted, &config, 1, &found);
  if (egl->BindAPI(EGL_OPENGL_API))
    made->context = egl->CreateContext(made->display, config, EGL_NO_CONTEXT, context_wanted);
  if (made->context == EGL_NO_CONTEXT ||
      !egl->MakeCurrent(made->display, EGL_NO_SURFACE, EGL_NO_SURFACE, made->context))
    return fault_set(diagnostic, SBF_CODE_NO_OPENGL,
        "EGL gives no OpenGL 3.3 (error 0x%04x): " DRAW_INSTALL_OPENGL, (unsigned)egl->GetError());
  return SBF_OK;
}

static gl_function find_function(const char *name, void *user) {
  return ((const egl_context *)user)->egl.GetProcAddress(name);
}

static void close_context(void *user) {
  egl_context *made = user;
  if (made->display != EGL_NO_DISPLAY) {
    /* The display stays open for reuse: terminating it unloads Mesa's driver, which then leaks memory. */
    made->egl.MakeCurrent(made->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (made->context != EGL_NO_CONTEXT) made->egl.DestroyContext(made->display, made->context);
  }
  free(made);
}

sbf_status draw_gl_context(draw_context *context, sbf_diagnostic *diagnostic) {
  egl_context *made = calloc(1, sizeof *made);
  if (!made) return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY, "no memory for a canvas");
  made->display = EGL_NO_DISPLAY, made->context = EGL_NO_CONTEXT;
  /* Mesa logs every driver that it tries; our own message has the relevant error. */
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  sbf_status status = load_egl(&made->egl, diagnostic);
  if (status == SBF_OK) status = open_context(made, diagnostic);
  if (status == SBF_OK)
    *context = (draw_context){find_function, close_context, made};
  else
    close_context(made);
  return status;
}
