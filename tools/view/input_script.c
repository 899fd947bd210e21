#include "view/input_script.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST = 1024 };

static bool parse_position(const char *rest, input_line *line) {
  char more;
  return sscanf(rest, "%f %f %c", &line->fraction[0], &line->fraction[1], &more) == 2 &&
         line->fraction[0] >= 0 && line->fraction[0] <= 1 && line->fraction[1] >= 0 && line->fraction[1] <= 1;
}

/* Error message, or NULL. `rest`: text after the word. */
static const char *parse_action(const sdl_api *sdl, const char *word, const char *rest, input_line *line) {
  char more;
  line->down = strcmp(word, "down") == 0 || strcmp(word, "tap") == 0;
  line->up = strcmp(word, "up") == 0 || strcmp(word, "tap") == 0;
  if (line->down || line->up) {
    line->kind = INPUT_KEY;
    line->key = sdl->GetKeyFromName(rest);
    return line->key == SDLK_UNKNOWN ? "there is no key of that name: W, 1, Left and Space are some" : NULL;
  }
  if (strcmp(word, "press") == 0 || strcmp(word, "move") == 0) {
    line->kind = *word == 'p' ? INPUT_PRESS : INPUT_MOVE;
    return parse_position(rest, line) ? NULL
                                      : "two shares of the window, 0 to 1, belong behind press and move";
  }
  if (strcmp(word, "release") == 0) {
    line->kind = INPUT_RELEASE;
    return *rest ? "nothing belongs behind release" : NULL;
  }
  if (strcmp(word, "wheel") == 0) {
    line->kind = INPUT_WHEEL;
    return sscanf(rest, "%d %c", &line->notches, &more) == 1 && abs(line->notches) <= 1000
               ? NULL
               : "a whole number of notches belongs behind wheel";
  }
  if (strcmp(word, "shot") == 0) {
    line->kind = INPUT_SHOT;
    if (!*rest || strlen(rest) >= sizeof line->shot) return "the name of a PNG belongs behind shot";
    memcpy(line->shot, rest, strlen(rest) + 1);
    return NULL;
  }
  return "the word behind the frame is none of down, up, tap, press, move, release, wheel, shot";
}

static const char *parse_line(const sdl_api *sdl, char *text, const input_line *before, input_line *line) {
  char word[16];
  int at = 0;
  size_t end = strlen(text);
  while (end && strchr(" \t\r\n", text[end - 1])) text[--end] = 0;
  if (sscanf(text, "%u %15s %n", &line->frame, word, &at) < 2 || line->frame > 1000000000u)
    return "a frame and a word belong here, as in `10 down W`";
  if (before && line->frame < before->frame) return "frames must not go back";
  return parse_action(sdl, word, at ? text + at : "", line);
}

static bool push(input_script *script, const input_line *line) {
  input_line *grown = realloc(script->lines, (script->count + 1u) * sizeof *grown);
  if (!grown) return false;
  script->lines = grown;
  grown[script->count++] = *line;
  return true;
}

bool input_script_load(
    input_script *script, const sdl_api *sdl, const cli_call *call, const char *path, int *status) {
  char text[LONGEST];
  FILE *file = fopen(path, "r");
  *script = (input_script){.lines = NULL};
  *status = SBF_FAILED;
  if (!file) {
    cli_wrong(call, "the input %s cannot be read: %s", path, strerror(errno));
    return false;
  }
  for (int number = 1; fgets(text, sizeof text, file); number++) {
    input_line line = {.frame = 0};
    bool whole = strchr(text, '\n') || feof(file);
    text[strcspn(text, "#")] = 0;
    if (whole && text[strspn(text, " \t\r\n")] == 0) continue;
    const input_line *before = script->count ? &script->lines[script->count - 1] : NULL;
    const char *wrong = whole ? parse_line(sdl, text, before, &line) : "the line is too long";
    if (!wrong && !push(script, &line)) wrong = "memory ran out";
    if (!wrong) continue;
    cli_wrong(call, "%s, line %d: %s", path, number, wrong);
    *status = SBF_BAD_INPUT;
    fclose(file);
    input_script_free(script);
    return false;
  }
  bool good = !ferror(file);
  if (!good) cli_wrong(call, "the input %s cannot be read: %s", path, strerror(errno));
  fclose(file);
  if (!good) input_script_free(script);
  return good;
}

void input_script_free(input_script *script) {
  free(script->lines);
  *script = (input_script){.lines = NULL};
}

/* SDL_Event is a union: initializes the whole member, because its first one does not cover the others. */
static SDL_Event key_event(SDL_Keycode key, bool down) {
  return (SDL_Event){.key = {.type = down ? SDL_KEYDOWN : SDL_KEYUP,
                         .state = down ? SDL_PRESSED : SDL_RELEASED,
                         .keysym = {.sym = key}}};
}

static SDL_Event pointer_event(input_script *script, const window *w, const input_line *line) {
  int from[2], to[2];
  window_position(w, script->pointer, &from[0], &from[1]);
  if (line->kind != INPUT_RELEASE) memcpy(script->pointer, line->fraction, sizeof script->pointer);
  window_position(w, script->pointer, &to[0], &to[1]);
  if (line->kind == INPUT_MOVE)
    return (SDL_Event){.motion = {.type = SDL_MOUSEMOTION,
                           .x = to[0],
                           .y = to[1],
                           .xrel = to[0] - from[0],
                           .yrel = to[1] - from[1]}};
  return (SDL_Event){.button = {.type = line->kind == INPUT_PRESS ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP,
                         .button = SDL_BUTTON_LEFT,
                         .x = to[0],
                         .y = to[1]}};
}

static SDL_Event wheel_event(int notches) {
  return (SDL_Event){.wheel = {.type = SDL_MOUSEWHEEL, .y = notches}};
}

bool input_script_next(
    input_script *script, const window *w, uint32_t frame, SDL_Event *event, const char **shot) {
  for (; script->next < script->count && script->lines[script->next].frame <= frame; script->next++) {
    const input_line *line = &script->lines[script->next];
    if (line->kind == INPUT_SHOT) {
      *shot = line->shot;
      continue;
    }
    if (line->kind == INPUT_KEY) {
      *event = key_event(line->key, line->down && !script->is_pressed);
      script->is_pressed = line->down && line->up && !script->is_pressed;
      script->next += !script->is_pressed;
      return true;
    }
    *event = line->kind == INPUT_WHEEL ? wheel_event(line->notches) : pointer_event(script, w, line);
    script->next++;
    return true;
  }
  return false;
}
