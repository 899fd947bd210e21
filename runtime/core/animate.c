/* The animation layer as hosts see it. */
#include "core/world.h"
#include "sbrun/animation.h"

float sbr_character_limit_excess(const sbr_world *world, sbr_character_id character) {
  const sbri_character *c = sbri_character_of(world, character);
  return c ? sbri_rig_limit_excess(&c->model->rig, sbri_pose(c)) : 0;
}

bool sbr_character_center(const sbr_world *world, sbr_character_id character, sbf_vec3 *center) {
  const sbri_character *c = sbri_character_of(world, character);
  if (center) *center = (sbf_vec3){0, 0, 0};
  return c && center && sbri_rig_center(&c->model->rig, sbri_pose(c), c->scale, center);
}
