/* What a character's gait is told, and where it has come to. */
#include "collide/ground.h"
#include "math/trig.h"
#include "pose/frames.h"

static const sbri_surroundings *look_around(
    const sbr_world *world, const sbri_character *c, sbri_surroundings *around) {
  if (!around || c->hold) return NULL;
  sbf_vec3 place;
  float heading;
  sbr_double3 at = sbri_head(c)->origin;
  sbri_gait_placement(sbri_gait(c), &place, &heading);
  at.x += (double)place.x, at.z += (double)place.z;
  at.y += (double)(sbri_gait_level(sbri_gait(c)) + place.y);
  sbri_surroundings_find(&c->model->rig, c->scale, &world->colliders, &c->ground, at, around);
  return around->colliders ? around : NULL;
}

static float gravity_of(const sbr_world *world, const sbri_character *c) {
  return -(world->has_gravity ? world->gravity : c->model->asset->environment.gravity).y;
}

sbri_gait_input sbri_gait_input_of(
    const sbr_world *world, const sbri_character *c, sbri_surroundings *around) {
  const sbri_character_state *head = sbri_head(c);
  const sbri_surroundings *seen = look_around(world, c, around);
  bool up = !c->model->rigid.body_count || sbri_rigid_drive(c)->posture == SBR_RIGID_UP;
  return (sbri_gait_input){.forward = up ? head->forward : 0,
      .sideways = up ? head->sideways : 0,
      .turn = up ? head->turn : 0,
      .up = up ? head->up : 0,
      .moved = head->moved,
      .turned = head->turned,
      .tick_s = (float)world->tick_s,
      .scale = c->scale,
      .hold = c->hold,
      .origin = head->origin,
      .ground = seen ? &seen->ground : &c->ground,
      .around = seen,
      .gravity = gravity_of(world, c)};
}

sbr_transform sbri_root_place(const sbri_character *c, const sbr_ground *ground) {
  sbf_vec3 place;
  float heading, s, k;
  sbri_gait_placement(sbri_gait(c), &place, &heading);
  sbr_double3 origin = sbri_head(c)->origin;
  double y = sbri_ground_height(ground, origin.x + (double)place.x, origin.z + (double)place.z, NULL);
  sbri_sincos(0.5f * heading, &s, &k);
  return (sbr_transform){{place.x, (float)(y + (double)place.y - origin.y), place.z}, {0, s, 0, k}};
}
