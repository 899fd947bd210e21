/* Keys and pointer by a file, for tests and for demonstrations: as events that a keyboard and a mouse would
 * give.
 *
 * A line each, in the order of frames: FRAME WHAT, where WHAT is one of
 *   down KEY | up KEY | tap KEY    by SDL's names: W, 1, Left, Space
 *   press X Y | move X Y | release the left button; shares of the window, from its upper left corner
 *   wheel N                        notches, away from the hand positive
 *   shot FILE.png                  the picture of this frame
 * Words behind a # and empty lines are skipped. */
#ifndef VIEW_INPUT_SCRIPT_H
#define VIEW_INPUT_SCRIPT_H

#include "cli.h"
#include "view/window.h"

enum { INPUT_SHOT_PATH = 512 };

typedef enum input_kind {
  INPUT_KEY,
  INPUT_PRESS,
  INPUT_MOVE,
  INPUT_RELEASE,
  INPUT_WHEEL,
  INPUT_SHOT
} input_kind;

typedef struct input_line {
  uint32_t frame;
  input_kind kind;
  SDL_Keycode key;
  bool down, up; /* of a key: one or both */
  float fraction[2];
  int notches;
  char shot[INPUT_SHOT_PATH];
} input_line;

typedef struct input_script {
  input_line *lines;
  uint32_t count, next;
  float pointer[2]; /* its last position */
  bool is_pressed;  /* the key of line `next` is pressed and must be released */
} input_script;

/* False, with a message and *status set, if the file cannot be read (SBF_FAILED) or is invalid
 * (SBF_BAD_INPUT). */
bool input_script_load(
    input_script *script, const sdl_api *sdl, const cli_call *call, const char *path, int *status);
void input_script_free(input_script *script);

/* Next event of the frame; false if there is none. `*shot` receives the path of a requested picture.
 * Events bypass SDL's queue, because SDL 3 behind SDL 2's interface drops synthetic keys. */
bool input_script_next(
    input_script *script, const window *w, uint32_t frame, SDL_Event *event, const char **shot);

#endif
