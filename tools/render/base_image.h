/* Texture image of a surface, as pixels. */
#ifndef RENDER_BASE_IMAGE_H
#define RENDER_BASE_IMAGE_H

#include "sbfmt/base.h"

enum { DRAW_IMAGE_LARGEST = 8192, DRAW_IMAGE_WHY = 128 };

typedef struct draw_image {
  uint32_t width, height; /* 1 to DRAW_IMAGE_LARGEST */
  uint8_t rgba[];         /* 4 width height; rows from the top, sRGB, straight alpha */
} draw_image;

/* Decodes any PNG, JPEG or WebP file. NULL for other files, damaged ones, or if memory runs out: `why`
 * then has the reason, without a full stop. */
draw_image *draw_image_decode(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]);
void draw_image_destroy(draw_image *image); /* NULL is ignored */

#endif
