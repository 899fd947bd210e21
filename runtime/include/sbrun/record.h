/* Recording and replaying the calls to a world: for bug reports, tests and ghosts.
 *
 * A recording holds every call that moves a world (steps with their seconds, drives, teleports, targets,
 * clips, impulses) and the state hash at its begin, once a second and at its end. Replayed in a world made
 * from the same assets with the same options it gives the same states to the bit, with any number of threads,
 * any instruction set and on any machine; the hashes show where it does not. It takes a few bytes a frame.
 *
 * The format: the eight bytes "!sbrrec1", then one record a call: what it was and how many numbers follow,
 * each as a little-endian uint32, then those numbers as little-endian doubles. A recording that was cut off
 * is played up to its last whole record. */
#ifndef SBRUN_RECORD_H
#define SBRUN_RECORD_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a recording goes: called with some tens of bytes at each call that moves the world, by the thread
 * that makes it. */
typedef struct sbr_record_output {
  void (*write)(void *user, const void *bytes, size_t size); /* takes them all, or deals with it itself */
  void *user;                                                /* the host's */
} sbr_record_output;

/* Begins a recording; the one before ends. NULL: none begins. A world that is destroyed ends its own.
 * What it does not hold: characters that are made and snapshots that are restored meanwhile, colliders, and a
 * ground of the host's, which must be the same. */
SBF_API void sbr_world_set_recording(sbr_world *world, const sbr_record_output *output);

/* A recording that is being played. Fields are read by the host; sbr_replay_begin sets them. */
typedef struct sbr_replay {
  sbr_world *world;           /* world in which it is played */
  const unsigned char *bytes; /* the recording; must outlive the playing */
  size_t size;                /* of its whole records */
  size_t at;                  /* offset of the next record */
  double frame_s;             /* length of the last frame */
  uint64_t frame_count;       /* steps in it */
  uint64_t frames;            /* played so far */
  uint64_t checks;            /* hashes compared so far */
  bool differs;               /* some hash was another: */
  uint64_t differs_at_tick;   /* the first such */
} sbr_replay;

/* Checks the recording and compares the initial state: if `differs` is set, the world was made differently.
 * SBF_BAD_INPUT if the bytes are no recording, or characters were created during it. */
SBF_API sbf_status sbr_replay_begin(
    sbr_replay *replay, sbr_world *world, const void *bytes, size_t size, sbf_diagnostic *error);
/* Plays up to and with the next step, and the hash behind it; false where nothing was left to step. */
SBF_API bool sbr_replay_step(sbr_replay *replay);

#ifdef __cplusplus
}
#endif
#endif
