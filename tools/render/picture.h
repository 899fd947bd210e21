/* A picture as PNG, in a file or in memory. */
#ifndef RENDER_PICTURE_H
#define RENDER_PICTURE_H

#include "sbfmt/base.h"

/* `rgb`: width * height * 3 bytes, rows from the top, sRGB. Writes the file atomically. */
sbf_status draw_picture_write_png(
    const char *path, const uint8_t *rgb, uint32_t width, uint32_t height, sbf_diagnostic *diagnostic);

/* The same bytes in memory from malloc, which the caller frees. */
sbf_status draw_picture_encode_png(const uint8_t *rgb, uint32_t width, uint32_t height, uint8_t **png,
    size_t *size, sbf_diagnostic *diagnostic);

#endif
