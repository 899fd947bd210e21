#include "render/canvas.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/fault.h"
#include "render/gl_api.h"

/* libEGL is opened at run time and stays open: Mesa keeps threads and thread-local storage of its own, and
 * unloading it under them has crashed programs at exit. */
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

struct draw_canvas {
  egl_api egl;
  gl_api gl;
  EGLDisplay display;
  EGLContext context;
  uint32_t width, height; /* of the picture */
  uint32_t scale;         /* of the drawing surface to it */
  GLuint drawn, drawn_colour, drawn_depth;
  GLuint resolved, resolved_colour; /* one sample a pixel, same size as drawn */
  GLuint reduced, reduced_colour;   /* the picture's size; 0 where scale is 1 */
  uint8_t *rgba;                    /* read back, rows from the bottom */
  char renderer[128];
};

#define INSTALL_HINT "install Mesa's EGL and OpenGL (Debian, Ubuntu: apt install libegl1 libgl1-mesa-dri)"

static gl_function symbol_of(void *library, const char *name) {
  /* POSIX promises that the bits survive; ISO C has no cast between data and function pointers. */
  void *symbol = dlsym(library, name);
  gl_function function = NULL;
  if (symbol) memcpy(&function, &symbol, sizeof function);
  return function;
}

static sbf_status load_egl(egl_api *egl, sbf_diagnostic *diagnostic) {
  void *library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!library)
    return fault_set(diagnostic, SBF_CODE_NO_OPENGL, "libEGL.so.1 is not on this machine: " INSTALL_HINT);
#define EGL_LOAD(type, name)                                                                                 \
  if (!(egl->name = (type)symbol_of(library, "egl" #name)))                                                  \
    return fault_set(diagnostic, SBF_CODE_NO_OPENGL, "libEGL.so.1 has no egl" #name ": " INSTALL_HINT);
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

/* Without a surface or a window system where EGL can; else whatever it takes as its default. */
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

static sbf_status open_context(draw_canvas *canvas, sbf_diagnostic *diagnostic) {
  const egl_api *egl = &canvas->egl;
  static const EGLint context_wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3,
      EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  static const EGLint config_wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  canvas->display = find_display(egl);
  if (canvas->display == EGL_NO_DISPLAY || !egl->Initialize(canvas->display, NULL, NULL)) {
    canvas->display = EGL_NO_DISPLAY;
    return fault_set(diagnostic, SBF_CODE_NO_OPENGL,
        "EGL finds nothing to draw with (error 0x%04x): " INSTALL_HINT, (unsigned)egl->GetError());
  }
  const char *extensions = egl->QueryString(canvas->display, EGL_EXTENSIONS);
  if (!names_extension(extensions, "EGL_KHR_surfaceless_context"))
    return fault_set(diagnostic, SBF_CODE_NO_OPENGL, "EGL cannot draw without a window here: " INSTALL_HINT);
  EGLConfig config = EGL_NO_CONFIG_KHR;
  EGLint found = 0;
  if (!names_extension(extensions, "EGL_KHR_no_config_context"))
    egl->ChooseConfig(canvas->display, config_wanted, &config, 1, &found);
  if (egl->BindAPI(EGL_OPENGL_API))
    canvas->context = egl->CreateContext(canvas->display, config, EGL_NO_CONTEXT, context_wanted);
  if (canvas->context == EGL_NO_CONTEXT ||
      !egl->MakeCurrent(canvas->display, EGL_NO_SURFACE, EGL_NO_SURFACE, canvas->context))
    return fault_set(diagnostic, SBF_CODE_NO_OPENGL, "EGL gives no OpenGL 3.3 (error 0x%04x): " INSTALL_HINT,
        (unsigned)egl->GetError());
  return SBF_OK;
}

static gl_function find_function(const char *name, void *user) {
  return ((const egl_api *)user)->GetProcAddress(name);
}

static GLuint make_colour(const gl_api *gl, GLsizei width, GLsizei height, GLsizei samples) {
  GLuint made = 0;
  gl->GenRenderbuffers(1, &made);
  gl->BindRenderbuffer(GL_RENDERBUFFER, made);
  gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width, height);
  gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, made);
  return made;
}

static bool make_surfaces(draw_canvas *canvas, GLsizei samples) {
  const gl_api *gl = &canvas->gl;
  GLsizei width = (GLsizei)(canvas->width * canvas->scale),
          height = (GLsizei)(canvas->height * canvas->scale);
  gl->GenFramebuffers(1, &canvas->drawn);
  gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->drawn);
  canvas->drawn_colour = make_colour(gl, width, height, samples);
  gl->GenRenderbuffers(1, &canvas->drawn_depth);
  gl->BindRenderbuffer(GL_RENDERBUFFER, canvas->drawn_depth);
  gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width, height);
  gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, canvas->drawn_depth);
  bool good = gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  gl->GenFramebuffers(1, &canvas->resolved);
  gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->resolved);
  canvas->resolved_colour = make_colour(gl, width, height, 0);
  good = good && gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  if (canvas->scale > 1) {
    gl->GenFramebuffers(1, &canvas->reduced);
    gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->reduced);
    canvas->reduced_colour = make_colour(gl, (GLsizei)canvas->width, (GLsizei)canvas->height, 0);
    good = good && gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }
  return good && gl->GetError() == GL_NO_ERROR;
}

static sbf_status open_surfaces(
    draw_canvas *canvas, draw_canvas_quality quality, sbf_diagnostic *diagnostic) {
  const gl_api *gl = &canvas->gl;
  GLint samples = 0, largest = 0;
  const char *missing = gl_api_load(&canvas->gl, find_function, &canvas->egl);
  if (missing)
    return fault_set(diagnostic, SBF_CODE_NO_OPENGL, "the OpenGL driver has no %s: " INSTALL_HINT, missing);
  snprintf(canvas->renderer, sizeof canvas->renderer, "%s", (const char *)gl->GetString(GL_RENDERER));
  gl->GetIntegerv(GL_MAX_SAMPLES, &samples);
  gl->GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  uint32_t longest = canvas->width > canvas->height ? canvas->width : canvas->height;
  /* Twice the size is four times the memory and the time; a big picture needs it least. */
  bool doubled = quality == DRAW_CANVAS_STILL && longest <= 2048 && 2 * longest <= (uint32_t)largest;
  canvas->scale = doubled ? 2 : 1;
  if ((uint32_t)largest < longest)
    return fault_set(diagnostic, SBF_CODE_BAD_CALL,
        "%ux%u pixels are more than this OpenGL draws: at most %d", (unsigned)canvas->width,
        (unsigned)canvas->height, (int)largest);
  if (!make_surfaces(canvas, samples < 4 ? samples : 4))
    return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY,
        "OpenGL has no room for a picture of %ux%u pixels: ask for a smaller one", (unsigned)canvas->width,
        (unsigned)canvas->height);
  canvas->rgba = malloc((size_t)canvas->width * canvas->height * 4);
  if (!canvas->rgba)
    return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY, "no memory to read a picture of %ux%u pixels back",
        (unsigned)canvas->width, (unsigned)canvas->height);
  return SBF_OK;
}

sbf_status draw_canvas_open(draw_canvas **opened, uint32_t width, uint32_t height,
    draw_canvas_quality quality, sbf_diagnostic *diagnostic) {
  *opened = NULL;
  if (width == 0 || height == 0 || width > DRAW_CANVAS_LARGEST || height > DRAW_CANVAS_LARGEST)
    return fault_set(diagnostic, SBF_CODE_BAD_CALL, "a picture of %ux%u pixels: each side may have 1 to %d",
        (unsigned)width, (unsigned)height, DRAW_CANVAS_LARGEST);
  draw_canvas *made = calloc(1, sizeof *made);
  if (!made) return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY, "no memory for a canvas");
  made->width = width, made->height = height;
  made->display = EGL_NO_DISPLAY, made->context = EGL_NO_CONTEXT;
  /* Mesa tells standard error of every driver it tried; what counts is said in our own message. */
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  sbf_status status = load_egl(&made->egl, diagnostic);
  if (status == SBF_OK) status = open_context(made, diagnostic);
  if (status == SBF_OK) status = open_surfaces(made, quality, diagnostic);
  if (status != SBF_OK) {
    draw_canvas_close(made);
    return status;
  }
  *opened = made;
  return SBF_OK;
}

void draw_canvas_close(draw_canvas *canvas) {
  if (!canvas) return;
  const gl_api *gl = &canvas->gl;
  if (canvas->resolved) {
    GLuint frames[] = {canvas->drawn, canvas->resolved, canvas->reduced};
    GLuint buffers[] = {
        canvas->drawn_colour, canvas->drawn_depth, canvas->resolved_colour, canvas->reduced_colour};
    gl->DeleteFramebuffers(3, frames); /* 0 is ignored */
    gl->DeleteRenderbuffers(4, buffers);
  }
  if (canvas->display != EGL_NO_DISPLAY) {
    /* The display itself stays, to be had again: ending it unloads Mesa's driver, which then leaks what it
     * still held. */
    canvas->egl.MakeCurrent(canvas->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (canvas->context != EGL_NO_CONTEXT) canvas->egl.DestroyContext(canvas->display, canvas->context);
  }
  free(canvas->rgba);
  free(canvas);
}

uint32_t draw_canvas_width(const draw_canvas *canvas) {
  return canvas->width;
}
uint32_t draw_canvas_height(const draw_canvas *canvas) {
  return canvas->height;
}
const struct gl_api *draw_canvas_gl(const draw_canvas *canvas) {
  return &canvas->gl;
}
const char *draw_canvas_renderer(const draw_canvas *canvas) {
  return canvas->renderer;
}

uint32_t draw_canvas_bind(draw_canvas *canvas) {
  const gl_api *gl = &canvas->gl;
  gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->drawn);
  gl->Viewport(0, 0, (GLsizei)(canvas->width * canvas->scale), (GLsizei)(canvas->height * canvas->scale));
  return canvas->scale;
}

static void blit(const gl_api *gl, GLuint from, GLuint to, GLint width, GLint height, GLint to_width,
    GLint to_height, GLenum filter) {
  gl->BindFramebuffer(GL_READ_FRAMEBUFFER, from);
  gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  gl->BlitFramebuffer(0, 0, width, height, 0, 0, to_width, to_height, GL_COLOR_BUFFER_BIT, filter);
}

sbf_status draw_canvas_read(draw_canvas *canvas, uint8_t *rgb, sbf_diagnostic *diagnostic) {
  const gl_api *gl = &canvas->gl;
  GLint width = (GLint)canvas->width, height = (GLint)canvas->height, scale = (GLint)canvas->scale;
  GLuint picture = canvas->resolved;
  blit(gl, canvas->drawn, canvas->resolved, width * scale, height * scale, width * scale, height * scale,
      GL_NEAREST);
  if (canvas->scale > 1) {
    /* Halving with linear filtering takes the mean of each four pixels. */
    picture = canvas->reduced;
    blit(gl, canvas->resolved, picture, width * scale, height * scale, width, height, GL_LINEAR);
  }
  gl->BindFramebuffer(GL_READ_FRAMEBUFFER, picture);
  gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl->ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, canvas->rgba);
  GLenum error = gl->GetError();
  if (error != GL_NO_ERROR)
    return fault_set(diagnostic, SBF_CODE_OPENGL_FAILED, "OpenGL reported error 0x%04x while drawing", error);
  for (uint32_t y = 0; y < canvas->height; y++) {
    const uint8_t *from = canvas->rgba + (size_t)(canvas->height - 1 - y) * canvas->width * 4;
    for (uint32_t x = 0; x < canvas->width; x++, from += 4, rgb += 3)
      rgb[0] = from[0], rgb[1] = from[1], rgb[2] = from[2];
  }
  return SBF_OK;
}
