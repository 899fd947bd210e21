/* Drawing target: OpenGL 3.3, without a window or display through EGL, on any device of EGL (Mesa's
 * llvmpipe on a machine without a graphics card), or in a context of the caller, such as a window's. One
 * canvas per thread at a time. */
#ifndef RENDER_CANVAS_H
#define RENDER_CANVAS_H

#include "sbfmt/base.h"

enum { DRAW_CANVAS_LARGEST = 4096 }; /* pixels, in both directions */

typedef enum draw_canvas_quality {
  DRAW_CANVAS_MOVIE, /* anti-aliasing with four samples per pixel */
  DRAW_CANVAS_STILL  /* also drawn at twice the size, within the machine's limits */
} draw_canvas_quality;

typedef struct draw_canvas draw_canvas;
struct gl_api; /* gl_api.h */
typedef void (*gl_function)(void);

/* OpenGL context, current for this thread. */
typedef struct draw_context {
  gl_function (*find)(const char *name, void *user); /* NULL if the function does not exist */
  void (*close)(void *user);                         /* when the canvas is closed; may be NULL */
  void *user;                                        /* argument of both */
} draw_context;

/* SBF_FAILED, with a message that says what to install, if EGL or OpenGL 3.3 is missing. */
sbf_status draw_canvas_open(draw_canvas **opened, uint32_t width, uint32_t height,
    draw_canvas_quality quality, sbf_diagnostic *diagnostic);
/* The same in a context of the caller, which the canvas closes when it is closed or cannot be opened. */
sbf_status draw_canvas_open_in(draw_canvas **opened, const draw_context *context, uint32_t width,
    uint32_t height, draw_canvas_quality quality, sbf_diagnostic *diagnostic);
void draw_canvas_close(draw_canvas *canvas); /* NULL is ignored */

uint32_t draw_canvas_width(const draw_canvas *canvas); /* of the resulting picture */
uint32_t draw_canvas_height(const draw_canvas *canvas);
const struct gl_api *draw_canvas_gl(const draw_canvas *canvas);
const char *draw_canvas_renderer(const draw_canvas *canvas); /* name of the driver */

/* Makes the canvas the drawing target; returns the ratio of the drawing surface to the picture (1 or 2). */
uint32_t draw_canvas_bind(draw_canvas *canvas);

/* Changes the picture's size, 1 to DRAW_CANVAS_LARGEST; its content is lost. After a failure it can only
 * be closed. */
sbf_status draw_canvas_resize(
    draw_canvas *canvas, uint32_t width, uint32_t height, sbf_diagnostic *diagnostic);

/* Copies the picture to the lower left corner of the window whose context it is drawn in. */
void draw_canvas_show(draw_canvas *canvas);

/* The picture: width * height * 3 bytes, rows from the top. */
sbf_status draw_canvas_read(draw_canvas *canvas, uint8_t *rgb, sbf_diagnostic *diagnostic);

#endif
