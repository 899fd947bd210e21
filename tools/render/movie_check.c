#include "render/movie_check.h"

#include <stdio.h>
#include <string.h>

static const char GIF_TRAILER = 0x3B;
enum { MP4_BOX_HEADER = 8, RIFF_HEADER = 8 };

static bool read_at(FILE *file, long at, uint8_t *to, size_t size) {
  return fseek(file, at, SEEK_SET) == 0 && fread(to, 1, size, file) == size;
}

static bool ends_a_gif(FILE *file, long size) {
  uint8_t last;
  return size > 0 && read_at(file, size - 1, &last, 1) && last == GIF_TRAILER;
}

/* ISO/IEC 14496-12, 4.2: a box begins with its size, big-endian, and its type; size 1: 64 bits follow. */
static bool is_filled_by_boxes(FILE *file, long size) {
  bool has_index = false;
  long at = 0;
  while (at < size) {
    uint8_t b[MP4_BOX_HEADER + 8];
    if (!read_at(file, at, b, MP4_BOX_HEADER)) return false;
    uint64_t length = 0;
    bool is_large = !memcmp(b, "\0\0\0\1", 4);
    if (is_large && !read_at(file, at, b, sizeof b)) return false;
    for (int i = 0; i < (is_large ? 8 : 4); i++)
      length = length << 8 | b[(is_large ? MP4_BOX_HEADER : 0) + i];
    if (length < MP4_BOX_HEADER || length > (uint64_t)(size - at)) return false;
    has_index = has_index || !memcmp(b + 4, "moov", 4);
    at += (long)length;
  }
  return has_index;
}

/* RFC 9649, 2.4: the header states the number of bytes after it, little-endian. */
static bool fills_its_riff(FILE *file, long size) {
  uint8_t b[RIFF_HEADER];
  if (!read_at(file, 0, b, sizeof b) || memcmp(b, "RIFF", 4) != 0) return false;
  uint32_t length = (uint32_t)b[4] | (uint32_t)b[5] << 8 | (uint32_t)b[6] << 16 | (uint32_t)b[7] << 24;
  return (uint64_t)length + RIFF_HEADER == (uint64_t)size;
}

bool draw_movie_file_is_whole(draw_movie_kind kind, const char *path) {
  FILE *file = fopen(path, "rb");
  if (!file) return false;
  long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
  bool whole = size > 0 && (kind == DRAW_MOVIE_GIF      ? ends_a_gif(file, size)
                               : kind == DRAW_MOVIE_MP4 ? is_filled_by_boxes(file, size)
                                                        : fills_its_riff(file, size));
  fclose(file);
  return whole;
}
