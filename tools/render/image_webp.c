#include <stdio.h>
#include <stdlib.h>

#include "render/image_forms.h"

#ifdef SBFMT_WEBP
#include <webp/decode.h>

draw_image *image_of_webp(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]) {
  WebPBitstreamFeatures about;
  if (WebPGetFeatures(bytes, size, &about) != VP8_STATUS_OK) {
    snprintf(why, DRAW_IMAGE_WHY, "it is damaged (its WebP header cannot be read)");
    return NULL;
  }
  if (about.has_animation) {
    snprintf(why, DRAW_IMAGE_WHY, "it is an animation");
    return NULL;
  }
  draw_image *image = image_make((uint64_t)about.width, (uint64_t)about.height, why);
  if (!image) return NULL;
  int row = 4 * about.width;
  if (WebPDecodeRGBAInto(bytes, size, image->rgba, (size_t)row * image->height, row)) return image;
  free(image);
  snprintf(why, DRAW_IMAGE_WHY, "it is damaged (its WebP pixels end early or contradict themselves)");
  return NULL;
}

#else

draw_image *image_of_webp(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]) {
  (void)bytes, (void)size;
  snprintf(why, DRAW_IMAGE_WHY,
      "it is a WebP, and this sbfmt was built without libwebp (Debian: libwebp-dev): give a PNG");
  return NULL;
}

#endif
