#include "world/stage_clock.h"

#include <string.h>

static double read_clock(const sbr_world *world) {
  return world->timing.clock.now_s(world->timing.clock.user);
}

void sbri_stages_begin(sbr_world *world) {
  if (!world->timing.clock.now_s) return;
  memset(&world->timing.profile, 0, sizeof world->timing.profile);
  world->timing.profile.tick = world->time.ticks;
  world->timing.profile.whole.begin_s = read_clock(world);
}

void sbri_stage_end(sbr_world *world, sbr_stage stage) {
  if (!world->timing.clock.now_s) return;
  sbr_time_span *whole = &world->timing.profile.whole;
  double begin_s = whole->begin_s + whole->duration_s;
  whole->duration_s = read_clock(world) - whole->begin_s;
  world->timing.profile.stages[stage] =
      (sbr_time_span){begin_s, whole->begin_s + whole->duration_s - begin_s};
}
