/* A text of timed commands, one per line: `SECONDS COMMAND NUMBERS`, in order of time. */
#ifndef SCRIPT_H
#define SCRIPT_H

#include "cli.h"
#include "sbrun/sbrun.h"

typedef enum script_kind {
  SCRIPT_DRIVE,
  SCRIPT_TELEPORT,
  SCRIPT_RESET,
  SCRIPT_REACH,
  SCRIPT_RELEASE,
  SCRIPT_PLAY,
  SCRIPT_PIVOT,
  SCRIPT_PAUSE,
  SCRIPT_RESUME
} script_kind;

typedef struct script_line {
  double at_s;
  script_kind kind;
  double numbers[5];
  int count;       /* number of arguments */
  unsigned number; /* number of the line in the file */
} script_line;

typedef struct script {
  script_line *lines;
  uint32_t count, next;
  double up;             /* vertical speed of the last drive, m/s */
  double speed, since_s; /* m/s, speed of the last drive, and its start time */
} script;

/* False, with a message that names the line, if the file cannot be read or a line is invalid; *status then
 * has the kind of error. */
bool script_load(script *s, cli_call *call, const char *path, int *status);
void script_free(script *s);

/* Whether the file has the chains, clips and legs of the script; false, with a message. */
bool script_fits(const script *s, const cli_call *call, const char *path, const sbf_asset *asset);

/* Drives the character from `time_s` on: forward, sideways and up, m/s, and turning, rad/s. */
void script_drive(script *s, double time_s, sbr_world *world, sbr_character_id character, double forward,
    double sideways, double turn, double up);

/* Executes commands that are due at `time_s`. */
void script_play(script *s, double time_s, sbr_world *world, sbr_character_id character);

#endif
