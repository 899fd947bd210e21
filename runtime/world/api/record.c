/* Writing of recordings: sbrun/record.h. */
#include "world/api/api.h"

static void write_hash(sbr_world *world) {
  uint64_t hash = sbr_world_get_state_hash(world);
  world->recording.hashed_at_tick = world->time.ticks;
  sbri_record(world, SBRI_RECORDED_HASH,
      (const double[]){(double)world->time.ticks, (double)(hash >> 32), (double)(uint32_t)hash});
}

void sbri_record_hash(sbr_world *world) {
  bool is_due = (double)(world->time.ticks - world->recording.hashed_at_tick) * world->time.tick_s >= 1;
  if (world->recording.output.write && is_due) write_hash(world);
}

void sbr_world_set_recording(sbr_world *world, const sbr_record_output *output) {
  if (!world) return;
  if (world->recording.output.write && world->recording.hashed_at_tick != world->time.ticks)
    write_hash(world);
  world->recording.output = output ? *output : (sbr_record_output){NULL, NULL};
  if (!world->recording.output.write) return;
  world->recording.output.write(
      world->recording.output.user, SBRI_RECORDING_MAGIC, SBRI_RECORDING_MAGIC_BYTES);
  write_hash(world);
}
