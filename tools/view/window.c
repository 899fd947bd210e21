#include "view/window.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"

static gl_function find_function(const char *name, void *user) {
  void *symbol = ((window *)user)->sdl.GL_GetProcAddress(name);
  gl_function function = NULL;
  if (symbol) memcpy(&function, &symbol, sizeof function);
  return function;
}

static void ask_for_opengl(const sdl_api *sdl) {
  sdl->GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
  sdl->GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 3);
  sdl->GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
  sdl->GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
  /* The picture is drawn offscreen with anti-aliasing and copied here. */
  sdl->GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0);
}

/* Without a desktop SDL would use an invisible screen without keys, whose window nobody could close. */
static sbf_status open_display(const sdl_api *sdl, sbf_diagnostic *error) {
  bool works = sdl->Init(SDL_INIT_VIDEO) == 0;
  const char *driver = works ? sdl->GetCurrentVideoDriver() : NULL, *asked = getenv("SDL_VIDEODRIVER");
  bool unseen =
      driver && !(asked && *asked) &&
      (strcmp(driver, "offscreen") == 0 || strcmp(driver, "dummy") == 0 || strcmp(driver, "evdev") == 0);
  if (works && !unseen) return SBF_OK;
  sbf_status status = fault_set(error, SBF_CODE_NO_WINDOW,
      "there is no display to open a window on (%s): run it in a desktop's session, or draw a picture with "
      "`sbfmt render`",
      unseen ? driver : sdl->GetError());
  if (works) sdl->Quit();
  return status;
}

sbf_status window_open(window *w, const char *title, uint32_t width, uint32_t height, bool steady,
    draw_context *context, sbf_diagnostic *error) {
  *w = (window){.shown = NULL};
  sdl_api *sdl = &w->sdl;
  sbf_status status = sdl_api_load(sdl, error);
  if (status != SBF_OK) return status;
  sdl->SetMainReady();
  sdl->SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
  sdl->SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  status = open_display(sdl, error);
  if (status != SBF_OK) return status;
  ask_for_opengl(sdl);
  w->shown = sdl->CreateWindow(title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, (int)width, (int)height,
      SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
  w->context = w->shown ? sdl->GL_CreateContext(w->shown) : NULL;
  if (!w->context) {
    status = fault_set(error, SBF_CODE_NO_WINDOW,
        "SDL gives no window with OpenGL 3.3 (%s): install Mesa's (Debian, Ubuntu: apt install libgl1 "
        "libgl1-mesa-dri)",
        sdl->GetError());
    window_close(w);
    return status;
  }
  if (!steady || sdl->GL_SetSwapInterval(-1) != 0) sdl->GL_SetSwapInterval(steady);
  *context = (draw_context){find_function, NULL, w};
  return SBF_OK;
}

void window_close(window *w) {
  if (w->context) w->sdl.GL_DeleteContext(w->context);
  if (w->shown) w->sdl.DestroyWindow(w->shown);
  if (w->sdl.Quit) w->sdl.Quit();
  *w = (window){.shown = NULL};
}

void window_pixels(const window *w, uint32_t *width, uint32_t *height) {
  int wide = 0, high = 0;
  w->sdl.GL_GetDrawableSize(w->shown, &wide, &high);
  *width = wide < 1 ? 1 : wide > DRAW_CANVAS_LARGEST ? DRAW_CANVAS_LARGEST : (uint32_t)wide;
  *height = high < 1 ? 1 : high > DRAW_CANVAS_LARGEST ? DRAW_CANVAS_LARGEST : (uint32_t)high;
}

static void units(const window *w, float size[2]) {
  int wide = 0, high = 0;
  w->sdl.GetWindowSize(w->shown, &wide, &high);
  size[0] = (float)(wide < 1 ? 1 : wide);
  size[1] = (float)(high < 1 ? 1 : high);
}

void window_fraction(const window *w, int x, int y, float fraction[2]) {
  float size[2];
  units(w, size);
  fraction[0] = ((float)x + 0.5f) / size[0];
  fraction[1] = ((float)y + 0.5f) / size[1];
}

void window_position(const window *w, const float fraction[2], int *x, int *y) {
  float size[2];
  units(w, size);
  *x = (int)floorf(fraction[0] * size[0]);
  *y = (int)floorf(fraction[1] * size[1]);
}

double window_seconds(const window *w) {
  return (double)w->sdl.GetPerformanceCounter() / (double)w->sdl.GetPerformanceFrequency();
}
