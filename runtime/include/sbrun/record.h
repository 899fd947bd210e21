/* Recording and replaying the calls to a world: for bug reports, tests and ghosts.
 *
 * A recording contains every call that moves a world (steps with their seconds, drives, teleports, targets,
 * clips, impulses) and the state hash at its begin, once a second and at its end. Replayed in a world made
 * from the same assets with the same options it gives the same states to the bit, with any number of threads,
 * any instruction set and on any machine; the hashes show the first difference. It takes a few bytes a frame.
 *
 * The format: the eight bytes "!sbrrec1", then one record per call: its kind and the count of its numbers,
 * each as a little-endian uint32, then the numbers as little-endian doubles. A recording that was cut off
 * is played up to its last whole record. */
#ifndef SBRUN_RECORD_H
#define SBRUN_RECORD_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Output of a recording: called with some tens of bytes at each call that moves the world, on the calling
 * thread. */
typedef struct sbr_record_output {
  void (*write)(
      void *user, const void *bytes, size_t size); /* must accept all bytes and handle its own errors */
  void *user;                                      /* the host's */
} sbr_record_output;

/* Begins a recording and ends the previous one; NULL: only ends it. Destroying the world ends it too. It does
 * not contain characters created and snapshots restored during it, colliders, or a ground of the host, which
 * must be the same in a replay. */
SBF_API void sbr_world_set_recording(sbr_world *world, const sbr_record_output *output);

/* A recording that is being played. Fields are read by the host; sbr_replay_begin sets them. */
typedef struct sbr_replay {
  sbr_world *world;           /* world in which it is played */
  const unsigned char *bytes; /* the recording; must outlive the playing */
  size_t size;                /* bytes of complete records */
  size_t at;                  /* offset of the next record */
  double frame_s;             /* length of the last frame */
  uint64_t frame_count;       /* steps in it */
  uint64_t frames;            /* played so far */
  uint64_t checks;            /* hashes compared so far */
  bool differs;               /* a hash was different: */
  uint64_t differs_at_tick;   /* tick of the first different hash */
} sbr_replay;

/* Checks the recording and compares the initial state: if `differs` is set, the world was made differently.
 * SBF_BAD_INPUT if the bytes are no recording, or characters were created during it. */
SBF_API sbf_status sbr_replay_begin(
    sbr_replay *replay, sbr_world *world, const void *bytes, size_t size, sbf_diagnostic *error);
/* Plays calls through the next step and checks the hash after it. False at the end of the recording. */
SBF_API bool sbr_replay_step(sbr_replay *replay);

#ifdef __cplusplus
}
#endif
#endif
