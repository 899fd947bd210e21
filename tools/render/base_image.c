#include "render/base_image.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static draw_image *refuse(png_image *png, char *why, const char *reason) {
  snprintf(why, DRAW_IMAGE_WHY, "%s", reason);
  png_image_free(png);
  return NULL;
}

draw_image *draw_image_decode(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]) {
  png_image png = {.version = PNG_IMAGE_VERSION};
  if (size >= 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0)
    return refuse(&png, why, "it is a JPEG, and only PNG is drawn");
  if (size < 8 || memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) != 0) return refuse(&png, why, "it is no PNG");
  if (!png_image_begin_read_from_memory(&png, bytes, size)) goto damaged;
  if (png.width > DRAW_IMAGE_LARGEST || png.height > DRAW_IMAGE_LARGEST)
    return refuse(&png, why, "it is wider or higher than 8192 pixels");
  png.format = PNG_FORMAT_RGBA;
  draw_image *image = malloc(sizeof *image + (size_t)4 * png.width * png.height);
  if (!image) return refuse(&png, why, "memory ran out");
  image->width = png.width;
  image->height = png.height;
  if (png_image_finish_read(&png, NULL, image->rgba, 0, NULL)) return image;
  free(image);
damaged:
  snprintf(why, DRAW_IMAGE_WHY, "it is damaged (%s)", png.message);
  png_image_free(&png);
  return NULL;
}

void draw_image_destroy(draw_image *image) {
  free(image);
}
