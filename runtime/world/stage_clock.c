#include "world/stage_clock.h"

#include <string.h>

static double read_clock(const sbr_world *world) {
  return world->clock.now_s(world->clock.user);
}

void sbri_stages_begin(sbr_world *world) {
  if (!world->clock.now_s) return;
  memset(&world->profile, 0, sizeof world->profile);
  world->profile.tick = world->ticks;
  world->profile.whole.begin_s = read_clock(world);
}

void sbri_stage_end(sbr_world *world, sbr_stage stage) {
  if (!world->clock.now_s) return;
  sbr_time_span *whole = &world->profile.whole;
  double begin_s = whole->begin_s + whole->duration_s;
  whole->duration_s = read_clock(world) - whole->begin_s;
  world->profile.stages[stage] = (sbr_time_span){begin_s, whole->begin_s + whole->duration_s - begin_s};
}
