#include "meeting_scenes.h"

#include "harness.h"
#include "sbrun/collision.h"

scene meeting_begin(sbf_vec3 gravity) {
  scene s = rigid_begin();
  s.asset->environment.gravity = gravity;
  return s;
}

void meeting_start(scene *s) {
  scene_start(s);
  ck_assert(sbr_world_bodies_meet(s->world, 0, NULL) == SBF_OK);
}

void meeting_throw(scene *s, sbr_character_id who, uint32_t body, sbf_vec3 impulse) {
  sbr_double3 o = sbr_character_origin(s->world, who);
  sbf_vec3 c = sbr_character_rigid_state(s->world, who, body).center;
  sbr_character_rigid_push(
      s->world, who, body, (sbr_double3){o.x + (double)c.x, o.y + (double)c.y, o.z + (double)c.z}, impulse);
}

sbr_character_id meeting_another(scene *s, sbr_double3 position) {
  sbr_character_definition d = s->character_definition;
  sbr_character_id id;
  d.position = position;
  ck_assert(sbr_character_create(s->world, s->model, &d, &id, NULL) == SBF_OK);
  return id;
}
