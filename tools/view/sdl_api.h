/* The functions of SDL2 that the window uses, loaded at run time: the program does everything else on a
 * machine without SDL. */
#ifndef VIEW_SDL_API_H
#define VIEW_SDL_API_H

#define SDL_MAIN_HANDLED
#include <SDL2/SDL.h>

#include "sbfmt/base.h"

#define VIEW_SDL_FUNCTIONS(X)                                                                                \
  X(CreateWindow)                                                                                            \
  X(DestroyWindow)                                                                                           \
  X(GL_CreateContext)                                                                                        \
  X(GL_DeleteContext)                                                                                        \
  X(GL_GetDrawableSize)                                                                                      \
  X(GL_GetProcAddress)                                                                                       \
  X(GL_SetAttribute)                                                                                         \
  X(GL_SetSwapInterval)                                                                                      \
  X(GL_SwapWindow)                                                                                           \
  X(GetCurrentVideoDriver)                                                                                   \
  X(GetError)                                                                                                \
  X(GetKeyFromName)                                                                                          \
  X(GetPerformanceCounter)                                                                                   \
  X(GetPerformanceFrequency)                                                                                 \
  X(GetWindowSize)                                                                                           \
  X(Init)                                                                                                    \
  X(PollEvent)                                                                                               \
  X(Quit)                                                                                                    \
  X(SetHint)                                                                                                 \
  X(SetMainReady)                                                                                            \
  X(SetWindowTitle)

/* sdl->Init is SDL_Init, and so on. */
typedef struct sdl_api {
#define VIEW_SDL_MEMBER(name) __typeof__(SDL_##name) *name;
  VIEW_SDL_FUNCTIONS(VIEW_SDL_MEMBER)
#undef VIEW_SDL_MEMBER
} sdl_api;

/* SBF_FAILED, with a message that says what to install, if SDL is missing. */
sbf_status sdl_api_load(sdl_api *sdl, sbf_diagnostic *error);

#endif
