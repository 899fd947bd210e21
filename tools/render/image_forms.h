/* The forms of image files that base_image.c tells apart by their first bytes. Private to it. */
#ifndef RENDER_IMAGE_FORMS_H
#define RENDER_IMAGE_FORMS_H

#include "render/base_image.h"

/* Room for the pixels; NULL where they are too many or memory runs out: `why` says which. */
draw_image *image_make(uint64_t width, uint64_t height, char why[DRAW_IMAGE_WHY]);

/* As draw_image_decode. Without its library at build time, each says so in `why`. */
draw_image *image_of_jpeg(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]);
draw_image *image_of_webp(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]);

#endif
