/* A picture into a PNG file. */
#ifndef RENDER_PICTURE_H
#define RENDER_PICTURE_H

#include "sbfmt/base.h"

/* `rgb`: width * height * 3 bytes, rows from the top, sRGB. The file is there whole or not at all. */
sbf_status draw_picture_write_png(
    const char *path, const uint8_t *rgb, uint32_t width, uint32_t height, sbf_diagnostic *diagnostic);

#endif
