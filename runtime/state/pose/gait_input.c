/* Input of a character's gait, and its resulting position. */
#include "math/trig.h"
#include "shapes/ground.h"
#include "state/pose/frames.h"

static const sbri_surroundings *query_around(
    const sbr_world *world, const sbri_character *c, sbri_surroundings *around) {
  if (!around || c->hold) return NULL;
  sbf_vec3 position;
  float heading;
  sbr_double3 at = sbri_header(c)->origin;
  sbri_gait_get_placement(sbri_gait(c), &position, &heading);
  at.x += (double)position.x, at.z += (double)position.z;
  at.y += (double)(sbri_gait_level(sbri_gait(c)) + position.y);
  sbri_surroundings_find(&c->model->rig, c->scale, &world->colliders, &c->ground, at, around);
  return around->colliders ? around : NULL;
}

static float gravity_of(const sbr_world *world, const sbri_character *c) {
  return -(world->has_gravity ? world->gravity : c->model->asset->environment.gravity).y;
}

sbri_gait_input sbri_gait_input_of(
    const sbr_world *world, const sbri_character *c, sbri_surroundings *around) {
  const sbri_character_state *head = sbri_header(c);
  const sbri_surroundings *seen = query_around(world, c, around);
  bool up = !c->model->rigid.body_count || sbri_rigid_drive(c)->fall.posture == SBR_POSTURE_UPRIGHT;
  return (sbri_gait_input){.forward = up ? head->forward : 0,
      .sideways = up ? head->sideways : 0,
      .turn = up ? head->turn : 0,
      .up = up ? head->up : 0,
      .displacement = head->displacement,
      .rotation = head->rotation,
      .tick_s = (float)world->time.tick_s,
      .scale = c->scale,
      .keeps_rest_pose = c->hold,
      .origin = head->origin,
      .ground = seen ? &seen->ground : &c->ground,
      .surroundings = seen,
      .gravity = gravity_of(world, c)};
}

sbr_transform sbri_current_root_frame(const sbri_character *c, const sbr_ground *ground) {
  sbf_vec3 position;
  float heading, s, k;
  sbri_gait_get_placement(sbri_gait(c), &position, &heading);
  sbr_double3 origin = sbri_header(c)->origin;
  double y = sbri_ground_height(ground, origin.x + (double)position.x, origin.z + (double)position.z, NULL);
  sbri_sincos(0.5f * heading, &s, &k);
  return (sbr_transform){{position.x, (float)(y + (double)position.y - origin.y), position.z}, {0, s, 0, k}};
}
