/* OpenGL of Windows (WGL) in a window that is never shown, since a context needs one. */
#include "render/gl_context.h"

#include <stdint.h>
#include <stdlib.h>
#include <windows.h>

#include "base/fault.h"

/* Of WGL_ARB_create_context and WGL_ARB_create_context_profile. */
enum {
  CONTEXT_MAJOR_VERSION = 0x2091,
  CONTEXT_MINOR_VERSION = 0x2092,
  CONTEXT_PROFILE_MASK = 0x9126,
  CONTEXT_CORE_PROFILE_BIT = 1
};
typedef HGLRC(WINAPI create_context_attributes)(HDC device, HGLRC shared, const int *attributes);

typedef struct wgl_context {
  HWND window;
  HDC device;
  HGLRC context;
} wgl_context;

static gl_function find_function(const char *name, void *user) {
  (void)user;
  PROC found = wglGetProcAddress(name);
  /* Some drivers answer with these instead of NULL; functions of OpenGL 1.1 are in the library alone. */
  if ((intptr_t)found >= -1 && (intptr_t)found <= 3)
    found = GetProcAddress(GetModuleHandleA("opengl32.dll"), name);
  return (gl_function)found;
}

static void close_context(void *user) {
  wgl_context *made = user;
  wglMakeCurrent(NULL, NULL);
  if (made->context) wglDeleteContext(made->context);
  if (made->device) ReleaseDC(made->window, made->device);
  if (made->window) DestroyWindow(made->window);
  free(made);
}

/* A plain context first: only within one can the function be asked for that makes the one wanted. */
static bool open_context(wgl_context *made) {
  static const int wanted[] = {
      CONTEXT_MAJOR_VERSION, 3, CONTEXT_MINOR_VERSION, 3, CONTEXT_PROFILE_MASK, CONTEXT_CORE_PROFILE_BIT, 0};
  PIXELFORMATDESCRIPTOR format = {.nSize = sizeof format,
      .nVersion = 1,
      .dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL,
      .iPixelType = PFD_TYPE_RGBA,
      .cColorBits = 32,
      .cDepthBits = 24};
  made->window = CreateWindowA("STATIC", "sbfmt", WS_POPUP, 0, 0, 1, 1, NULL, NULL, NULL, NULL);
  made->device = made->window ? GetDC(made->window) : NULL;
  if (!made->device || !SetPixelFormat(made->device, ChoosePixelFormat(made->device, &format), &format))
    return false;
  HGLRC plain = wglCreateContext(made->device);
  if (!plain || !wglMakeCurrent(made->device, plain)) return false;
  create_context_attributes *create =
      (create_context_attributes *)find_function("wglCreateContextAttribsARB", NULL);
  if (create) made->context = create(made->device, NULL, wanted);
  wglMakeCurrent(NULL, NULL);
  wglDeleteContext(plain);
  return made->context && wglMakeCurrent(made->device, made->context);
}

sbf_status draw_gl_context(draw_context *context, sbf_diagnostic *diagnostic) {
  wgl_context *made = calloc(1, sizeof *made);
  if (!made) return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY, "no memory for a canvas");
  if (!open_context(made)) {
    DWORD number = GetLastError();
    close_context(made);
    return fault_set(diagnostic, SBF_CODE_NO_OPENGL,
        "Windows gives no OpenGL 3.3 (error %lu): " DRAW_INSTALL_OPENGL, (unsigned long)number);
  }
  *context = (draw_context){find_function, close_context, made};
  return SBF_OK;
}
