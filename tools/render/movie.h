/* Writes frames to a GIF, MP4 or WebP file with the program ffmpeg. */
#ifndef RENDER_MOVIE_H
#define RENDER_MOVIE_H

#include "sbfmt/base.h"

typedef enum draw_movie_kind {
  DRAW_MOVIE_GIF, /* loops forever; one palette for the whole film */
  DRAW_MOVIE_MP4, /* H.264, yuv420p: plays everywhere */
  DRAW_MOVIE_WEBP /* loops forever, for pages; full colour at a fraction of a GIF's size */
} draw_movie_kind;

/* For looping formats: a GIF counts hundredths of a second, and players slow down frames shorter than two. */
enum { DRAW_MOVIE_LOOP_FPS_MAX = 50 };

typedef struct draw_movie_options {
  draw_movie_kind kind;
  uint32_t width, height; /* of every frame, pixels */
  uint32_t fps;           /* frames per second, 1 to 240; GIF and WebP: up to 50 */
  uint32_t frame_count;   /* expected number; 0: unknown */
  uint32_t colors;    /* of a GIF's palette, 4 to 256; 0: 256. Fewer disable dithering: much smaller files */
  uint32_t quality;   /* of a WebP, 1 to 100; 0: 80 */
  const char *ffmpeg; /* the program; NULL: "ffmpeg" in PATH */
} draw_movie_options;

typedef struct draw_movie draw_movie;

/* Starts ffmpeg. SBF_FAILED with a message if it is missing, or `path` cannot be written. The film is
 * written under a temporary name beside `path` and renamed when finished. */
sbf_status draw_movie_open(
    draw_movie **opened, const char *path, const draw_movie_options *options, sbf_diagnostic *diagnostic);

/* `rgb`: width * height * 3 bytes, rows from the top. On SBF_FAILED the movie must still be abandoned. */
sbf_status draw_movie_add_frame(draw_movie *movie, const uint8_t *rgb, sbf_diagnostic *diagnostic);

sbf_status draw_movie_finish(draw_movie *movie, sbf_diagnostic *diagnostic); /* frees the movie in any case */
void draw_movie_abandon(draw_movie *movie); /* stops ffmpeg, leaves no file; NULL is ignored */

#endif
