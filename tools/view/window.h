/* A window with OpenGL 3.3, by SDL. One per program. */
#ifndef VIEW_WINDOW_H
#define VIEW_WINDOW_H

#include "render/canvas.h"
#include "view/sdl_api.h"

typedef struct window {
  sdl_api sdl;
  SDL_Window *shown;
  SDL_GLContext context;
} window;

/* Its OpenGL is current for this thread until window_close. `steady`: enables vertical synchronization.
 * SBF_FAILED, with a message, if SDL, a display or OpenGL 3.3 is missing. */
sbf_status window_open(window *w, const char *title, uint32_t width, uint32_t height, bool steady,
    draw_context *context, sbf_diagnostic *error);
void window_close(window *w);

/* Pixels, which may be finer than pointer units; between 1 and the largest canvas. */
void window_pixels(const window *w, uint32_t *width, uint32_t *height);

/* Converts a pointer position to fractions of width and height, from the upper left corner. */
void window_fraction(const window *w, int x, int y, float fraction[2]);
/* The inverse. */
void window_position(const window *w, const float fraction[2], int *x, int *y);

double window_seconds(const window *w); /* a clock */

#endif
