#include "view/sdl_api.h"

#include <dlfcn.h>
#include <string.h>

#include "render/fault.h"

#define INSTALL_HINT "install it (Debian, Ubuntu: apt install libsdl2-2.0-0)"

sbf_status sdl_api_load(sdl_api *sdl, sbf_diagnostic *error) {
  void *library = dlopen("libSDL2-2.0.so.0", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  void *symbol;
  if (!library)
    return fault_set(
        error, SBF_CODE_NO_WINDOW, "the window needs SDL 2, which is not on this machine: " INSTALL_HINT);
/* POSIX guarantees this conversion; ISO C has no cast between data and function pointers. */
#define SDL_LOAD(name)                                                                                       \
  if (!(symbol = dlsym(library, "SDL_" #name)))                                                              \
    return fault_set(                                                                                        \
        error, SBF_CODE_NO_WINDOW, "this SDL has no SDL_" #name ", a newer one does: " INSTALL_HINT);        \
  memcpy(&sdl->name, &symbol, sizeof symbol);
  VIEW_SDL_FUNCTIONS(SDL_LOAD)
#undef SDL_LOAD
  return SBF_OK;
}
