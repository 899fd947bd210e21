/* Writes public calls into a recording. */
#include <string.h>

#include "math/usable.h"
#include "state/world.h"

/* Number of values of each call. */
static const uint8_t counts[SBRI_RECORDED_COUNT] = {[SBRI_RECORDED_HASH] = 3,
    [SBRI_RECORDED_STEP] = 1,
    [SBRI_RECORDED_TICK] = 0,
    [SBRI_RECORDED_MADE] = 1,
    [SBRI_RECORDED_DESTROY] = 1,
    [SBRI_RECORDED_DRIVE] = 4,
    [SBRI_RECORDED_TELEPORT] = 5,
    [SBRI_RECORDED_RESET] = 1,
    [SBRI_RECORDED_WAKE] = 1,
    [SBRI_RECORDED_PAUSE] = 2,
    [SBRI_RECORDED_REACH] = 10,
    [SBRI_RECORDED_RELEASE] = 2,
    [SBRI_RECORDED_PIVOT] = 2,
    [SBRI_RECORDED_PLAY] = 8,
    [SBRI_RECORDED_RIGID_MODE] = 3,
    [SBRI_RECORDED_RIGID_DRIVE] = 6,
    [SBRI_RECORDED_RIGID_FRACTION] = 3,
    [SBRI_RECORDED_RIGID_PUSH] = 8,
    [SBRI_RECORDED_RIGID_FALL] = 4,
    [SBRI_RECORDED_DETAIL_LEVEL] = 2,
    [SBRI_RECORDED_VISIBILITY] = 2,
    [SBRI_RECORDED_VIEW] = 11,
    [SBRI_RECORDED_SOFT_VELOCITY] = 8,
    [SBRI_RECORDED_SOFT_IMPULSE] = 6,
    [SBRI_RECORDED_SOFT_FORCE] = 7,
    [SBRI_RECORDED_SOFT_HOLD] = 9,
    [SBRI_RECORDED_SOFT_RELEASE] = 3,
    [SBRI_RECORDED_VERTICAL] = 2,
    [SBRI_RECORDED_DISPLACE] = 5};

uint32_t sbri_recorded_count(sbri_recorded what) {
  return counts[what];
}

static void put_u32(unsigned char *to, uint32_t value) {
  for (int i = 0; i < 4; i++) to[i] = (unsigned char)(value >> 8 * i);
}

static void put_double(unsigned char *to, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  put_u32(to, (uint32_t)bits);
  put_u32(to + 4, (uint32_t)(bits >> 32));
}

bool sbri_record(sbr_world *world, sbri_recorded what, const double *numbers) {
  unsigned char bytes[SBRI_RECORDED_HEADER_BYTES + SBRI_RECORDED_MAX * SBRI_RECORDED_NUMBER_BYTES];
  if (!sbri_usable(numbers, counts[what])) return false;
  if (!world->recording.output.write) return true;
  put_u32(bytes, (uint32_t)what);
  put_u32(bytes + 4, counts[what]);
  for (uint32_t i = 0; i < counts[what]; i++)
    put_double(bytes + SBRI_RECORDED_HEADER_BYTES + i * SBRI_RECORDED_NUMBER_BYTES, numbers[i]);
  world->recording.output.write(world->recording.output.user, bytes,
      SBRI_RECORDED_HEADER_BYTES + (size_t)counts[what] * SBRI_RECORDED_NUMBER_BYTES);
  return true;
}
