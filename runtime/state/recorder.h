/* Public calls as a recording stores them (sbrun/record.h). */
#ifndef SBRI_RECORDER_H
#define SBRI_RECORDER_H

#include "sbrun/record.h"

/* Numbers in the format of recordings: they never change and are never reused. */
typedef enum sbri_recorded {
  SBRI_RECORDED_HASH,     /* ticks, high and low word of the hash */
  SBRI_RECORDED_STEP,     /* seconds */
  SBRI_RECORDED_TICK,     /* none */
  SBRI_RECORDED_MADE,     /* character; its creation is not recorded */
  SBRI_RECORDED_DESTROY,  /* character, as for all that follow */
  SBRI_RECORDED_DRIVE,    /* forward, sideways, turn */
  SBRI_RECORDED_TELEPORT, /* x, y, z, heading */
  SBRI_RECORDED_RESET,
  SBRI_RECORDED_WAKE,
  SBRI_RECORDED_PAUSE,          /* 1 or 0 */
  SBRI_RECORDED_REACH,          /* chain, position, rotation, weight */
  SBRI_RECORDED_RELEASE,        /* chain */
  SBRI_RECORDED_PIVOT,          /* leg */
  SBRI_RECORDED_PLAY,           /* layer, clip, weight, fade, speed, start, mask */
  SBRI_RECORDED_RIGID_MODE,     /* body, mode */
  SBRI_RECORDED_RIGID_DRIVE,    /* frequency, damping ratio, strength, joint damping, joint friction */
  SBRI_RECORDED_RIGID_FRACTION, /* body, fraction */
  SBRI_RECORDED_RIGID_PUSH,     /* body, position, impulse */
  SBRI_RECORDED_RIGID_FALL,     /* fraction, rest, rise */
  SBRI_RECORDED_DETAIL_LEVEL,   /* detail level */
  SBRI_RECORDED_VISIBILITY,     /* visibility */
  SBRI_RECORDED_VIEW,           /* index, count, eye, forward, height, width, lines; no character */
  SBRI_RECORDED_SOFT_VELOCITY,  /* body, velocity, angular velocity */
  SBRI_RECORDED_SOFT_IMPULSE,   /* body, vertex, impulse */
  SBRI_RECORDED_SOFT_FORCE,     /* body, vertex, force, seconds */
  SBRI_RECORDED_SOFT_HOLD,      /* body, vertex, target, frequency, damping ratio, maximum force */
  SBRI_RECORDED_SOFT_RELEASE,   /* body, vertex */
  SBRI_RECORDED_VERTICAL,       /* vertical speed */
  SBRI_RECORDED_DISPLACE,       /* displacement, rotation */
  SBRI_RECORDED_COUNT
} sbri_recorded;

enum { SBRI_RECORDED_MAX = 11 }; /* maximum number of values */

/* Records a call if its numbers are usable (math/usable.h). Returns whether they are; a call with other
 * numbers must do nothing. */
bool sbri_record(sbr_world *world, sbri_recorded what, const double *numbers);

/* A recording begins with this. Each call follows as its number and its count of values, 4 bytes each, and
 * the values as doubles, all little-endian. */
#define SBRI_RECORDING_MAGIC "!sbrrec1"
enum { SBRI_RECORDING_MAGIC_BYTES = 8, SBRI_RECORDED_HEADER_BYTES = 8, SBRI_RECORDED_NUMBER_BYTES = 8 };
/* Number of values of the call. */
uint32_t sbri_recorded_count(sbri_recorded what);

#endif
