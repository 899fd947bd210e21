/* One control tick of a character: gait, rigid bodies, and the frames that its soft bodies are attached to.
 */
#include "coupling/body_contact/body_contacts.h"
#include "coupling/ragdoll/ragdoll.h"
#include "soft/soft.h"
#include "state/pose/frames.h"
#include "world/detail/detail_levels.h"
#include "world/step.h"

bool sbri_character_is_grouped(const sbr_world *world, const sbri_character *c) {
  return world->body_contacts && world->body_contacts->group_of[c - world->characters] != UINT32_MAX;
}

static void note_landing(sbri_character *c) {
  float heading;
  sbri_gait_event *event = &c->events[c->event_count++];
  *event = (sbri_gait_event){.kind = SBRI_GAIT_LANDED};
  sbri_gait_get_placement(sbri_gait(c), &event->position, &heading);
}

static void end_displacement(sbri_character *c) {
  sbri_header(c)->displacement = sbri_vec3(0, 0, 0);
  sbri_header(c)->rotation = 0;
}

void sbri_character_tick(sbr_world *world, sbri_character *c) {
  c->event_count = 0;
  if (!c->model || sbri_character_sleeps(world, c)) return;
  if (!sbri_header(c)->paused && !world->body_contacts)
    sbri_detail_level_change(world, c); /* with body contacts step.c has changed it already */
  for (uint32_t i = 0; i < c->model->island_count; i++)
    sbri_tears_of(c)[i].count = sbri_tears_of(c)[i].unsplit = 0;
  sbri_character_rebase(c);
  sbri_character_stop(c);
  if (sbri_header(c)->paused) return;
  sbri_loads_begin(world, c);
  sbri_fade_tick(world, c);
  if (sbri_is_away(c)) {
    sbri_away_tick(world, c);
    end_displacement(c);
    return;
  }
  if (sbri_reflex_tick(world, c)) note_landing(c);
  sbri_surroundings around;
  sbri_gait_input input = sbri_gait_input_of(world, c, &around);
  sbr_transform *pose = sbri_pose(c);
  bool has_bodies = c->model->island_count > 0; /* only soft bodies need frame deltas */
  if (has_bodies) sbri_deltas_make(c, pose, 1, sbri_previous_deltas(c));
  bool may_sleep = sbri_character_may_sleep(world, c);
  if (may_sleep) sbri_character_store_gait(c);
  c->event_count += sbri_gait_tick(&c->model->rig, sbri_gait(c), &input, pose, c->events + c->event_count,
      SBRI_TICK_EVENTS - c->event_count);
  end_displacement(c);
  pose[sbri_root_frame(c->model)] = sbri_current_root_frame(c, input.ground);
  if (sbri_character_is_grouped(world, c)) return;
  sbri_rigid_tick_parts(world, c);
  sbri_jiggles_tick(c, (float)world->time.tick_s * c->time_scale);
  if (has_bodies) sbri_deltas_make(c, pose, 1, sbri_deltas(c));
  sbri_header(c)->asleep = may_sleep && !world->colliders.is_moving && sbri_character_is_still(c);
}
