/* One character brought to life as the options of `run` and `render` say: loaded, placed, driven, stepped. */
#ifndef SESSION_H
#define SESSION_H

#include "cli.h"
#include "recording.h"
#include "sbfmt/io.h"
#include "sbrun/sbrun.h"
#include "script.h"
#include "thread_pool.h"

/* The options that both verbs share; put them first in a verb's table. */
#define SESSION_OPTIONS                                                                                      \
  {"--seconds", "S", "how long"}, {"--fps", "N", "frames a second"},                                         \
      {"--scheme", "NAME",                                                                                   \
          "automatic, symplectic, position_based, relaxation, explicit_euler, heun, block_descent "          \
          "(automatic)"},                                                                                    \
      {"--substeps", "N", "of a control tick (as many as the scheme needs)"},                                \
      {"--instructions", "NAME",                                                                             \
          "automatic, scalar, sse2, avx2, avx512, neon; the motion is the same for all (automatic)"},        \
      {"--threads", "N", "worker threads; the motion is the same for any number (1)"},                       \
      {"--drive", "M/S,RAD/S", "wanted speed and turn (0,0)"},                                               \
      {"--ground", "KIND", "flat, slope:DEGREES, stairs:RISE,RUN or noise:HEIGHT,SEED (flat)"},              \
      {"--hold", NULL, "keep the bones in their rest pose"}, {"--free", NULL, "drop every pin"},             \
      {"--raise", "M",                                                                                       \
          "start that much higher (0); what nothing holds starts above the ground in any case"},             \
      {"--gravity", "M/S2", "downward (the file's)"},                                                        \
      {"--clip", "NAME",                                                                                     \
          "play this clip as it is keyed, by its name or number; the gait leaves the bones to it"},          \
      {"--level", "N", "simulation level, 0 the finest (0)"},                                                \
      {"--record", "OUT.sbrec", "record all that moves the character, to be played again"},                  \
      {"--replay", "FILE.sbrec", "play what was recorded, with the same file and options, to the bit"}, {    \
    "--script", "FILE", "commands over time; see docs/scripts.md"                                            \
  }

typedef struct session {
  sbf_asset *asset;
  sbr_model *model;
  sbr_world *world;
  sbr_character_id character;
  thread_pool *threads;
  script script;
  recording recording;
  sbr_ground ground;
  double seconds, fps, time_s;
  double frame_s; /* length of the last frame */
  uint32_t frame_count, frame;
} session;

/* `seconds` and `fps` are what the verb takes where the call does not say. False, with a message printed and
 * *status set, where the options or the file do not allow it. */
bool session_open(session *s, cli_call *call, double seconds, double fps, int *status);
void session_close(session *s);

/* Plays the script's commands that are due, or what was recorded, and advances by one frame; false after the
 * last. */
bool session_step(session *s);

/* After the last: ends a recording; false, with a message printed, where it could not be written. */
bool session_finish(session *s, const cli_call *call);

#endif
