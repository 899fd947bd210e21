#include "render/picture.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"
#include "base/output_file.h"
#include "base/system.h"

/* libpng would print a line of its own before ours. */
static void jump(png_structp png, png_const_charp message) {
  (void)message;
  png_longjmp(png, 1);
}

static void ignore(png_structp png, png_const_charp message) {
  (void)png;
  (void)message;
}

/* libpng reports errors by longjmp, which keeps only volatile state: so this function contains only the
 * call that jumps, and owns nothing but libpng's structures. */
static bool encode(FILE *file, const uint8_t *rgb, uint32_t width, uint32_t height) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, jump, ignore);
  png_infop info = png ? png_create_info_struct(png) : NULL;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(png ? &png : NULL, info ? &info : NULL);
    return false;
  }
  png_init_io(png, file);
  png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
      PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  for (uint32_t y = 0; y < height; y++) png_write_row(png, rgb + (size_t)y * width * 3);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

sbf_status draw_picture_write_png(
    const char *path, const uint8_t *rgb, uint32_t width, uint32_t height, sbf_diagnostic *diagnostic) {
  output_file output;
  sbf_status status = output_file_begin(&output, path, diagnostic);
  if (status != SBF_OK) return status;
  FILE *file = fopen(output.written_path, "wb");
  bool good = file && encode(file, rgb, width, height);
  int why = errno;
  if (file && fclose(file) != 0 && good) good = false, why = errno;
  if (!good) {
    output_file_abandon(&output);
    return fault_set_file(diagnostic, SBF_CODE_IO_CANNOT_WRITE, path,
        "cannot write: %s; check the folder, its permissions and the free space", strerror(why));
  }
  return output_file_commit(&output, diagnostic);
}

sbf_status draw_picture_encode_png(const uint8_t *rgb, uint32_t width, uint32_t height, uint8_t **png,
    size_t *size, sbf_diagnostic *diagnostic) {
  system_memory_stream stream;
  FILE *file = system_memory_stream_open(&stream);
  bool good = file && encode(file, rgb, width, height);
  *png = (uint8_t *)system_memory_stream_close(&stream, size);
  if (good && *png) return SBF_OK;
  free(*png);
  *png = NULL;
  return fault_set(diagnostic, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a picture");
}
