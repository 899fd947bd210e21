/* Paints a scene on a canvas in the style of product photography: a key light with soft shadows, a fill, a
 * back light, sky and floor glow, ambient occlusion on the floor. Opaque objects first, then lines from
 * far to near, then transparent surfaces. */
#ifndef RENDER_PAINTER_H
#define RENDER_PAINTER_H

#include "render/camera.h"
#include "render/canvas.h"
#include "render/draw_scene.h"

typedef struct draw_painter draw_painter;

/* The canvas must outlive the painter; both belong to one thread. */
sbf_status draw_painter_create(draw_painter **created, draw_canvas *canvas, sbf_diagnostic *diagnostic);
void draw_painter_destroy(draw_painter *painter); /* NULL is ignored */

/* Paints one frame; read it with draw_canvas_read. Changes only the scene's order of lines. */
sbf_status draw_painter_paint(
    draw_painter *painter, draw_scene *scene, const draw_camera *camera, sbf_diagnostic *diagnostic);

#endif
