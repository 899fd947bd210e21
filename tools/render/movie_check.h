/* Whether a film's file is whole. */
#ifndef RENDER_MOVIE_CHECK_H
#define RENDER_MOVIE_CHECK_H

#include "render/movie.h"

/* False if the file is missing, cut short or without its index: ffmpeg may exit with 0 after its last writes
 * have failed. Only what states or ends the length is read. */
bool draw_movie_file_is_whole(draw_movie_kind kind, const char *path);

#endif
