/* Decoders of image formats, which base_image.c selects by the first bytes. Private to it. */
#ifndef RENDER_IMAGE_FORMS_H
#define RENDER_IMAGE_FORMS_H

#include "render/base_image.h"

/* Allocates the pixels; NULL if they are too many or memory runs out: `why` has the reason. */
draw_image *image_make(uint64_t width, uint64_t height, char why[DRAW_IMAGE_WHY]);

/* Like draw_image_decode. Without its library at build time, each reports that in `why`. */
draw_image *image_of_jpeg(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]);
draw_image *image_of_webp(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]);

#endif
