#include "render/base_image.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/image_forms.h"

draw_image *image_make(uint64_t width, uint64_t height, char why[DRAW_IMAGE_WHY]) {
  if (width < 1 || height < 1 || width > DRAW_IMAGE_LARGEST || height > DRAW_IMAGE_LARGEST) {
    snprintf(why, DRAW_IMAGE_WHY, "it is wider or higher than %d pixels", DRAW_IMAGE_LARGEST);
    return NULL;
  }
  draw_image *image = malloc(sizeof *image + 4 * (size_t)(width * height));
  if (!image) {
    snprintf(why, DRAW_IMAGE_WHY, "memory ran out");
    return NULL;
  }
  image->width = (uint32_t)width;
  image->height = (uint32_t)height;
  return image;
}

static draw_image *image_of_png(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]) {
  png_image png = {.version = PNG_IMAGE_VERSION};
  draw_image *image = NULL;
  bool good = png_image_begin_read_from_memory(&png, bytes, size);
  if (good && !(image = image_make(png.width, png.height, why))) {
    png_image_free(&png);
    return NULL;
  }
  png.format = PNG_FORMAT_RGBA;
  if (good && png_image_finish_read(&png, NULL, image->rgba, 0, NULL)) return image;
  free(image);
  snprintf(why, DRAW_IMAGE_WHY, "it is damaged (%s)", png.message);
  png_image_free(&png);
  return NULL;
}

static bool begins_with(const uint8_t *bytes, size_t size, size_t at, const char *with, size_t length) {
  return size >= at + length && memcmp(bytes + at, with, length) == 0;
}

draw_image *draw_image_decode(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]) {
  if (begins_with(bytes, size, 0, "\x89PNG\r\n\x1a\n", 8)) return image_of_png(bytes, size, why);
  if (begins_with(bytes, size, 0, "\xff\xd8\xff", 3)) return image_of_jpeg(bytes, size, why);
  if (begins_with(bytes, size, 0, "RIFF", 4) && begins_with(bytes, size, 8, "WEBP", 4))
    return image_of_webp(bytes, size, why);
  snprintf(why, DRAW_IMAGE_WHY, "it is neither PNG nor JPEG nor WebP");
  return NULL;
}

void draw_image_destroy(draw_image *image) {
  free(image);
}
