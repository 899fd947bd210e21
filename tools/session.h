/* One character simulated with the options of `run` and `render`: loaded, placed, driven, stepped. */
#ifndef SESSION_H
#define SESSION_H

#include "cli.h"
#include "recording.h"
#include "sbfmt/io.h"
#include "sbrun/sbrun.h"
#include "script.h"
#include "thread_pool.h"

/* The common options of both verbs; put them first in a verb's table. */
#define SESSION_OPTIONS(seconds_help, fps_help)                                                              \
  {"--seconds", "S", seconds_help}, {"--fps", "N", fps_help},                                                \
      {"--scheme", "NAME",                                                                                   \
          "automatic, symplectic, position_based, relaxation, explicit_euler, heun, block_descent "          \
          "(automatic)"},                                                                                    \
      {"--substeps", "N", "substeps of a control tick (as many as the scheme needs)"},                       \
      {"--instructions", "NAME",                                                                             \
          "automatic, scalar, sse2, avx2, avx512, neon; the motion is the same for all (automatic)"},        \
      {"--threads", "N", "worker threads; the motion is the same for any number (1)"},                       \
      {"--drive", "M/S,RAD/S[,UP]", "wanted speed, turn, vertical speed (0,0,0)"},                           \
      {"--ground", "KIND", "flat, slope:DEGREES, stairs:RISE,RUN or noise:HEIGHT,SEED (flat)"},              \
      {"--hold", NULL, "keep the bones in their rest pose"}, {"--free", NULL, "drop every pin"},             \
      {"--raise", "M",                                                                                       \
          "start that much higher and fall (0); bodies without pins always start above the ground"},         \
      {"--gravity", "M/S2", "gravity, downward (the file's)"},                                               \
      {"--clip", "NAME", "play this clip, by name or number, in place of the gait"},                         \
      {"--level", "N", "simulation level, 0 is the finest (0); bodies with fewer levels use their last"},    \
      {"--ragdoll", NULL, "simulate every rigid body with a mass; only joints hold it"},                     \
      {"--strength", "TIMES",                                                                                \
          "drive every rigid body to its pose; the torque limit is TIMES the torque that holds its limb "    \
          "level; 0: no limit"},                                                                             \
      {"--record", "OUT.sbrec", "record all input of the character for --replay"},                           \
      {"--replay", "FILE.sbrec", "replay a recording with the same file and options, equal to the bit"}, {   \
    "--script", "FILE", "timed commands; see docs/scripts.md"                                                \
  }

/* Settings of the world and its character from the options. */
typedef struct session_settings {
  sbr_model_options model;
  double drive[3]; /* m/s, rad/s, m/s upwards */
  double raise;    /* m */
  double gravity;  /* m/s^2, downward */
  double strength; /* of `driven`, as in sbr_rigid_drive */
  long threads;
  int32_t clip; /* SBF_NONE: none */
  bool hold;
  bool ragdoll, driven; /* rigid bodies are simulated with free joints, or driven to their pose */
} session_settings;

typedef struct session {
  session_settings settings;
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

/* `seconds` and `fps` are the verb's defaults. False, with a message printed and *status set, if the
 * options or the file are invalid. */
bool session_open(session *s, cli_call *call, double seconds, double fps, int *status);
void session_close(session *s);

/* Recreates model, world and character from `settings` and `ground`, with the same file; recording and replay
 * end. After a failure the session can only be closed. */
sbf_status session_restart(session *s, const cli_call *call, sbf_diagnostic *error);

/* Executes the script's due commands, or the recording, and advances by one frame; false after the last. */
bool session_step(session *s);
/* The same for a frame of this length in seconds, > 0, also beyond the planned end. A replayed frame has
 * its recorded length. */
bool session_step_by(session *s, double seconds);

/* After the last frame: ends a recording; false, with a message printed, if it could not be written. */
bool session_finish(session *s, const cli_call *call);

#endif
