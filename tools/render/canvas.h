/* A picture to draw on: OpenGL 3.3, without a window or a display through EGL, on whatever EGL finds (on a
 * machine without a graphics card that is Mesa's llvmpipe), or in a context of the caller's, as of a window.
 * One canvas a thread at a time. */
#ifndef RENDER_CANVAS_H
#define RENDER_CANVAS_H

#include "sbfmt/base.h"

enum { DRAW_CANVAS_LARGEST = 4096 }; /* pixels, either way */

typedef enum draw_canvas_quality {
  DRAW_CANVAS_MOVIE, /* edges smoothed by four samples a pixel */
  DRAW_CANVAS_STILL  /* drawn at twice the size besides, where that is within the machine's limits */
} draw_canvas_quality;

typedef struct draw_canvas draw_canvas;
struct gl_api; /* gl_api.h */
typedef void (*gl_function)(void);

/* Where OpenGL comes from: a context that is current for this thread. */
typedef struct draw_context {
  gl_function (*find)(const char *name, void *user); /* NULL: there is none of that name */
  void (*close)(void *user);                         /* when the canvas is closed; may be NULL */
  void *user;                                        /* handed to both */
} draw_context;

/* SBF_FAILED, with a message that says what to install, where there is no EGL or no OpenGL 3.3. */
sbf_status draw_canvas_open(draw_canvas **opened, uint32_t width, uint32_t height,
    draw_canvas_quality quality, sbf_diagnostic *diagnostic);
/* The same in a context of the caller's, which the canvas closes when it is closed, or cannot be opened. */
sbf_status draw_canvas_open_in(draw_canvas **opened, const draw_context *context, uint32_t width,
    uint32_t height, draw_canvas_quality quality, sbf_diagnostic *diagnostic);
void draw_canvas_close(draw_canvas *canvas); /* NULL is fine */

uint32_t draw_canvas_width(const draw_canvas *canvas); /* of the picture read back */
uint32_t draw_canvas_height(const draw_canvas *canvas);
const struct gl_api *draw_canvas_gl(const draw_canvas *canvas);
const char *draw_canvas_renderer(const draw_canvas *canvas); /* as the driver names itself */

/* Drawing goes to the canvas after this; returns how many pixels of the drawing surface make one of the
 * picture, either way (1 or 2). */
uint32_t draw_canvas_bind(draw_canvas *canvas);

/* Another size of picture, 1 to DRAW_CANVAS_LARGEST; what was drawn is lost. After a failure only closing is
 * left. */
sbf_status draw_canvas_resize(
    draw_canvas *canvas, uint32_t width, uint32_t height, sbf_diagnostic *diagnostic);

/* Copies the picture to the window whose context it is drawn in, into its lower left corner. */
void draw_canvas_show(draw_canvas *canvas);

/* The picture: width * height * 3 bytes, rows from the top. */
sbf_status draw_canvas_read(draw_canvas *canvas, uint8_t *rgb, sbf_diagnostic *diagnostic);

#endif
