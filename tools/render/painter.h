/* Paints a scene on a canvas, as a photographer would show a product: a key light with soft shadows, a fill,
 * a light from behind, sky and floor glow, the floor darker where something stands on it. Solid things first,
 * then lines from far to near, then what is seen through. */
#ifndef RENDER_PAINTER_H
#define RENDER_PAINTER_H

#include "render/camera.h"
#include "render/canvas.h"
#include "render/draw_scene.h"

typedef struct draw_painter draw_painter;

/* The canvas must outlive the painter; both belong to one thread. */
sbf_status draw_painter_create(draw_painter **created, draw_canvas *canvas, sbf_diagnostic *diagnostic);
void draw_painter_destroy(draw_painter *painter); /* NULL is fine */

/* Paints one frame; read it with draw_canvas_read. Only the scene's order of lines is changed. */
sbf_status draw_painter_paint(
    draw_painter *painter, draw_scene *scene, const draw_camera *camera, sbf_diagnostic *diagnostic);

#endif
