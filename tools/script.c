#include "script.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sbrun/animation.h"

typedef struct command {
  const char *word;
  script_kind kind;
  int min, max; /* count of arguments */
} command;

enum { LAYERS = 4 }; /* of sbr_character_play_clip */

static const command commands[] = {
    {"drive", SCRIPT_DRIVE, 2, 4},       /* forward, turn, sideways, up */
    {"teleport", SCRIPT_TELEPORT, 3, 4}, /* x, y, z, heading */
    {"reset", SCRIPT_RESET, 0, 0},
    {"reach", SCRIPT_REACH, 4, 5},     /* chain, x, y, z, weight */
    {"release", SCRIPT_RELEASE, 1, 1}, /* chain */
    {"play", SCRIPT_PLAY, 1, 4},       /* clip, weight, fade, layer */
    {"pivot", SCRIPT_PIVOT, 1, 1},     /* index of a leg, or -1 */
    {"pause", SCRIPT_PAUSE, 0, 0},
    {"resume", SCRIPT_RESUME, 0, 0},
};

/* Limit of all numbers: larger positions and speeds are typing errors. */
static const double MAX = 1e9;

static bool is_number(const char *text, const char *end, double value) {
  return end != text && fabs(value) <= MAX; /* false for NaN */
}

/* Reads `SECONDS COMMAND NUMBERS`; false if the text has another form. */
static bool parse_line(char *text, script_line *line) {
  char *rest, *word, *end;
  line->at_s = strtod(text, &rest);
  if (!is_number(text, rest, line->at_s) || line->at_s < 0) return false;
  word = strtok(rest, " \t\r\n");
  if (!word) return false;
  for (size_t c = 0; c < sizeof commands / sizeof *commands; c++) {
    if (strcmp(word, commands[c].word) != 0) continue;
    int count = 0;
    for (char *number; (number = strtok(NULL, " \t\r\n")) != NULL; count++) {
      if (count == commands[c].max) return false;
      line->numbers[count] = strtod(number, &end);
      if (!is_number(number, end, line->numbers[count]) || *end) return false;
    }
    line->kind = commands[c].kind;
    line->count = count;
    return count >= commands[c].min;
  }
  return false;
}

/* Reads the next line; drops comments after '#'. Stops early at what no command has: a zero byte, or more
 * characters than a command needs, which `whole` reports. */
static bool read_line(FILE *file, char *text, size_t size, bool *whole) {
  size_t length = 0;
  bool comment = false, any = false;
  *whole = true;
  for (int c; *whole && (c = fgetc(file)) != EOF && (any = true) && c != '\n';) {
    comment |= c == '#';
    if (comment) continue;
    *whole = c != 0 && length + 1 < size;
    if (*whole) text[length++] = (char)c;
  }
  text[length] = 0;
  return any;
}

bool script_load(script *s, cli_call *call, const char *path, int *status) {
  FILE *file = fopen(path, "r");
  *s = (script){.lines = NULL};
  if (!file) {
    *status = cli_wrong(call, "the script %s cannot be read: %s", path, strerror(errno));
    return false;
  }
  char text[512];
  bool good = true, whole;
  for (unsigned number = 1; good && read_line(file, text, sizeof text, &whole); number++) {
    if (whole && text[strspn(text, " \t\r\n")] == 0) continue;
    script_line line = {.number = number}, *grown = realloc(s->lines, (s->count + 1) * sizeof *s->lines);
    if (grown) s->lines = grown;
    good = grown && whole && parse_line(text, &line) &&
           (s->count == 0 || line.at_s >= s->lines[s->count - 1].at_s);
    if (good) {
      s->lines[s->count++] = line;
      continue;
    }
    cli_wrong(call, "%s:%u: not a command `SECONDS COMMAND NUMBERS` in order of time, with numbers up to %g",
        path, number, MAX);
    *status = SBF_BAD_INPUT;
  }
  if (good && ferror(file)) {
    *status = cli_wrong(call, "the script %s cannot be read: %s", path, strerror(errno));
    good = false;
  }
  fclose(file);
  if (!good) script_free(s);
  return good;
}

/* Whether an item with that index exists; -1 means none, if allowed. */
static bool has(const cli_call *call, const char *path, const script_line *line, double number,
    const char *what, uint32_t count, bool none) {
  if ((number >= 0 && number < count && number == floor(number)) || (none && number == -1)) return true;
  cli_wrong(call, "%s:%u: there is no %s %g: %s %u, counted from 0", path, line->number, what, number,
      strcmp(what, "layer") == 0 ? "there are" : "the file has", count);
  return false;
}

bool script_fits(const script *s, const cli_call *call, const char *path, const sbf_asset *asset) {
  uint32_t legs = asset->gaits.count ? asset->gaits.at[0].legs.count : 0;
  for (uint32_t i = 0; i < s->count; i++) {
    const script_line *line = &s->lines[i];
    double first = line->numbers[0];
    if (line->kind == SCRIPT_PLAY && (!has(call, path, line, first, "clip", asset->clips.count, true) ||
                                         !has(call, path, line, line->numbers[3], "layer", LAYERS, false)))
      return false;
    if (line->kind == SCRIPT_PIVOT && !has(call, path, line, first, "leg", legs, true)) return false;
    if ((line->kind == SCRIPT_REACH || line->kind == SCRIPT_RELEASE) &&
        !has(call, path, line, first, "IK chain", asset->ik_chains.count, false))
      return false;
  }
  return true;
}

void script_free(script *s) {
  free(s->lines);
  *s = (script){.lines = NULL};
}

void script_drive(script *s, double time_s, sbr_world *world, sbr_character_id character, double forward,
    double sideways, double turn, double up) {
  s->speed = hypot(hypot(forward, sideways), up);
  s->since_s = time_s;
  sbr_character_set_drive(world, character, (float)forward, (float)sideways, (float)turn);
  if (up != 0 || s->up != 0) sbr_character_set_vertical_speed(world, character, (float)up);
  s->up = up;
}

void script_play(script *s, double time_s, sbr_world *world, sbr_character_id character) {
  for (; s->next < s->count && s->lines[s->next].at_s <= time_s + 1e-9; s->next++) {
    const script_line *line = &s->lines[s->next];
    const double *n = line->numbers;
    switch (line->kind) {
    case SCRIPT_DRIVE:
      script_drive(s, time_s, world, character, n[0], n[2], n[1], n[3]);
      break;
    case SCRIPT_TELEPORT:
      sbr_character_teleport(world, character, (sbr_double3){n[0], n[1], n[2]}, (float)n[3]);
      break;
    case SCRIPT_RESET:
      sbr_character_reset(world, character);
      break;
    case SCRIPT_REACH: {
      sbr_ik_target target = sbr_default_ik_target();
      target.position = (sbr_double3){n[1], n[2], n[3]};
      target.weight = line->count > 4 ? (float)n[4] : 1;
      if (n[0] >= 0) sbr_character_set_ik_target(world, character, (uint32_t)n[0], &target);
      break;
    }
    case SCRIPT_RELEASE:
      if (n[0] >= 0) sbr_character_set_ik_target(world, character, (uint32_t)n[0], NULL);
      break;
    case SCRIPT_PLAY: {
      sbr_clip_play how = sbr_default_clip_play();
      how.weight = line->count > 1 ? (float)n[1] : 1, how.fade_s = (float)n[2];
      sbr_character_play_clip(world, character, n[3] > 0 ? (uint32_t)n[3] : 0, (int32_t)n[0], &how);
      break;
    }
    case SCRIPT_PIVOT:
      sbr_character_set_pivot_leg(world, character, (int32_t)n[0]);
      break;
    case SCRIPT_PAUSE:
      sbr_character_set_paused(world, character, true);
      break;
    case SCRIPT_RESUME:
      sbr_character_set_paused(world, character, false);
      break;
    }
  }
}
