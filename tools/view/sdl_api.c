#include "view/sdl_api.h"

#include "base/fault.h"
#include "base/system.h"

#ifdef _WIN32
#define LIBRARY "SDL2.dll"
#define INSTALL_HINT "put SDL2.dll beside sbfmt.exe"
#else
#define LIBRARY "libSDL2-2.0.so.0"
#define INSTALL_HINT "install it (Debian, Ubuntu: apt install libsdl2-2.0-0)"
#endif

sbf_status sdl_api_load(sdl_api *sdl, sbf_diagnostic *error) {
  void *library = system_open_library(LIBRARY);
  if (!library)
    return fault_set(
        error, SBF_CODE_NO_WINDOW, "the window needs SDL 2, which is not on this machine: " INSTALL_HINT);
#define SDL_LOAD(name)                                                                                       \
  if (!(sdl->name = (__typeof__(sdl->name))system_library_function(library, "SDL_" #name)))                  \
    return fault_set(                                                                                        \
        error, SBF_CODE_NO_WINDOW, "this SDL has no SDL_" #name ", a newer one does: " INSTALL_HINT);
  VIEW_SDL_FUNCTIONS(SDL_LOAD)
#undef SDL_LOAD
  return SBF_OK;
}
