/* Sleep of whole characters.
 *
 * A character sleeps if all its bodies sleep, it is commanded to stand, and a tick of its gait has left the
 * gait's state and the pose unchanged, bit for bit. Every further tick would do the same until a call or the
 * ground changes its input. A sleeping character costs one check per tick. */
#include <string.h>

#include "coupling/ragdoll/ragdoll.h"
#include "shapes/ground.h"
#include "soft/soft.h"
#include "world/step.h"

/* Number of ticks between two checks of a ground that the host may change. */
enum { CHECK_INTERVAL = 4 };

bool sbri_character_may_sleep(const sbr_world *world, const sbri_character *c) {
  const sbri_character_state *head = sbri_header(c);
  if (!world->sleep_ticks || head->forward != 0 || head->sideways != 0 || head->turn != 0 || head->up != 0)
    return false;
  if (sbri_any_loads(c) || head->rotation != 0 || sbri_dot(head->displacement, head->displacement) > 0)
    return false;
  if (head->fade_ticks > 0 || head->fade_before > 0 || head->fade_kept) return false;
  for (uint32_t i = 0; i < c->model->island_count; i++)
    if (!sbri_island_states(c)[i].asleep) return false;
  return sbri_rigid_is_still(c);
}

void sbri_character_store_gait(sbri_character *c) {
  memcpy(sbri_gait_before(c), sbri_gait(c), sbri_gait_state_size(&c->model->rig));
}

bool sbri_character_is_still(const sbri_character *c) {
  return memcmp(sbri_gait_before(c), sbri_gait(c), sbri_gait_state_size(&c->model->rig)) == 0 &&
         memcmp(sbri_previous_pose(c), sbri_pose(c), c->model->frame_count * sizeof(sbr_transform)) == 0;
}

bool sbri_character_sleeps(const sbr_world *world, sbri_character *c) {
  if (!sbri_header(c)->asleep) return false;
  bool checks = !sbri_ground_is_fixed(&c->ground) && world->time.ticks % CHECK_INTERVAL == 0;
  if (!checks && !world->colliders.is_moving) return true;
  /* The feet and the bodies make their own checks. */
  sbri_header(c)->asleep = 0;
  return false;
}
