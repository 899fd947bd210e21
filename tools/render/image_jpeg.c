#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/image_forms.h"

#ifdef SBFMT_JPEG
#include <jerror.h>
#include <jpeglib.h>
#include <setjmp.h>

/* A progressive file of a few kilobytes can request thousands of scans over all of its pixels. */
enum { MAX_SCANS = 100 };

typedef struct reading {
  struct jpeg_error_mgr errors;
  struct jpeg_progress_mgr progress;
  jmp_buf failed;
  char *why;
  uint8_t *row; /* of a CMYK file */
  draw_image *image;
} reading;

static reading *reading_of(j_common_ptr jpeg) {
  return jpeg->client_data;
}

static void fail(j_common_ptr jpeg) {
  char message[JMSG_LENGTH_MAX];
  jpeg->err->format_message(jpeg, message);
  snprintf(reading_of(jpeg)->why, DRAW_IMAGE_WHY, "it is damaged (%.100s)", message);
  longjmp(reading_of(jpeg)->failed, 1);
}

/* Missing data, which the library replaces by grey, is an error; its other warnings are invisible. */
static void note(j_common_ptr jpeg, int level) {
  int code = jpeg->err->msg_code;
  if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_NOT_SEQUENTIAL))
    fail(jpeg);
}

static void count_scans(j_common_ptr jpeg) {
  if (((j_decompress_ptr)jpeg)->input_scan_number <= MAX_SCANS) return;
  snprintf(reading_of(jpeg)->why, DRAW_IMAGE_WHY, "it is damaged (more than %d scans)", MAX_SCANS);
  longjmp(reading_of(jpeg)->failed, 1);
}

/* CMYK as stored by Adobe's programs, which write most such files: 255 is no ink. */
static void write_inks(const uint8_t *inks, uint32_t width, bool inverted, uint8_t *rgba) {
  for (uint32_t x = 0; x < width; x++, inks += 4, rgba += 4) {
    int black = inverted ? inks[3] : 255 - inks[3];
    for (int k = 0; k < 3; k++) rgba[k] = (uint8_t)((inverted ? inks[k] : 255 - inks[k]) * black / 255);
    rgba[3] = 255;
  }
}

static void read_rows(struct jpeg_decompress_struct *jpeg, reading *r) {
  bool inks = jpeg->out_color_space == JCS_CMYK;
  uint32_t width = r->image->width;
  while (jpeg->output_scanline < jpeg->output_height) {
    uint8_t *to = r->image->rgba + 4 * (size_t)width * jpeg->output_scanline;
    JSAMPROW row = inks ? r->row : to;
    jpeg_read_scanlines(jpeg, &row, 1);
    if (inks) write_inks(r->row, width, jpeg->saw_Adobe_marker, to);
    for (uint32_t x = width; !inks && x-- > 0;) { /* expands three bytes to four in place, from the end */
      const uint8_t rgb[3] = {to[3 * x], to[3 * x + 1], to[3 * x + 2]};
      memcpy(to + 4 * (size_t)x, rgb, 3);
      to[4 * (size_t)x + 3] = 255;
    }
  }
}

/* The library reports errors by longjmp; `r` holds the resources to free then. */
static bool decode(
    struct jpeg_decompress_struct *jpeg, reading *r, const uint8_t *bytes, unsigned long size) {
  if (setjmp(r->failed)) return false;
  jpeg_create_decompress(jpeg);
  jpeg->client_data = r;
  jpeg->progress = &r->progress;
  jpeg_mem_src(jpeg, bytes, size);
  jpeg_read_header(jpeg, TRUE);
  bool inks = jpeg->jpeg_color_space == JCS_CMYK || jpeg->jpeg_color_space == JCS_YCCK;
  jpeg->out_color_space = inks ? JCS_CMYK : JCS_RGB;
  r->image = image_make(jpeg->image_width, jpeg->image_height, r->why);
  if (!r->image) return false;
  r->row = malloc(4 * (size_t)r->image->width);
  if (!r->row) {
    snprintf(r->why, DRAW_IMAGE_WHY, "memory ran out");
    return false;
  }
  jpeg_start_decompress(jpeg);
  read_rows(jpeg, r);
  jpeg_finish_decompress(jpeg);
  return true;
}

draw_image *image_of_jpeg(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]) {
  reading r = {.why = why, .progress = {.progress_monitor = count_scans}};
  struct jpeg_decompress_struct jpeg = {.err = jpeg_std_error(&r.errors), .client_data = &r};
  r.errors.error_exit = fail;
  r.errors.emit_message = note;
  bool good = decode(&jpeg, &r, bytes, (unsigned long)size);
  jpeg_destroy_decompress(&jpeg);
  free(r.row);
  if (good) return r.image;
  free(r.image);
  return NULL;
}

#else

draw_image *image_of_jpeg(const uint8_t *bytes, size_t size, char why[DRAW_IMAGE_WHY]) {
  (void)bytes, (void)size;
  snprintf(why, DRAW_IMAGE_WHY,
      "it is a JPEG, and this sbfmt was built without libjpeg (Debian: libjpeg-dev): give a PNG");
  return NULL;
}

#endif
