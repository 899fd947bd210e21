/* Recordings of a world's calls, and their playback. */
#include <stdlib.h>
#include <string.h>

#include "sbrun/record.h"
#include "web.h"

/* A growing recording; if memory runs out it ends at its last complete record. */
typedef struct recording {
  unsigned char *bytes;
  size_t size, capacity;
  bool full;
} recording;

static void write(void *user, const void *bytes, size_t size) {
  recording *to = user;
  if (to->full) return;
  if (to->size + size > to->capacity) {
    size_t capacity = 2 * (to->size + size) + 4096;
    unsigned char *larger = realloc(to->bytes, capacity);
    if (!larger) {
      to->full = true;
      return;
    }
    to->bytes = larger, to->capacity = capacity;
  }
  memcpy(to->bytes + to->size, bytes, size);
  to->size += size;
}

/* NULL: memory ran out. */
recording *WEB_CALL(web_record_begin)(sbr_world *world) {
  recording *made = calloc(1, sizeof *made);
  if (made) sbr_world_set_recording(world, &(sbr_record_output){write, made});
  return made;
}
/* Ends the recording of a world; its bytes remain until web_record_free. */
void WEB_CALL(web_record_end)(sbr_world *world) {
  sbr_world_set_recording(world, NULL);
}
const void *WEB_CALL(web_record_bytes)(const recording *made, uint32_t *size) {
  *size = (uint32_t)made->size;
  return made->bytes;
}
void WEB_CALL(web_record_free)(recording *made) {
  free(made->bytes);
  free(made);
}

/* `bytes` must stay until web_free of the result; NULL: see web_failure_message. */
sbr_replay *WEB_CALL(web_replay_begin)(sbr_world *world, const void *bytes, size_t size) {
  sbr_replay *made = calloc(1, sizeof *made);
  memset(web_failure(), 0, sizeof(sbf_diagnostic));
  if (made && sbr_replay_begin(made, world, bytes, size, web_failure()) != SBF_OK) {
    free(made);
    return NULL;
  }
  return made;
}
uint32_t WEB_CALL(web_replay_frame)(sbr_replay *replay) {
  return sbr_replay_step(replay);
}
/* Five numbers: frames in total, frames played, hashes compared, whether one differed, and its tick. */
void WEB_CALL(web_replay_state)(const sbr_replay *replay, double *to) {
  const double numbers[5] = {(double)replay->frame_count, (double)replay->frames, (double)replay->checks,
      replay->differs, (double)replay->differs_at_tick};
  memcpy(to, numbers, sizeof numbers);
}
