/* Methods of SoftCharacter3D that move it at a velocity, as CharacterBody3D moves. */
#include <math.h>

#include "method_table.h"
#include "soft_character.h"

/* Fraction of the wanted displacement below which something was in the way. */
static const float BLOCKED = 0.7f;

static float wrapped(float angle) {
  return atan2f(sinf(angle), cosf(angle));
}

/* Turn towards the velocity in one frame, rad. */
static float turn_of_frame(const soft_character *one, sbf_vec3 velocity, float frame_s) {
  float max = (float)one->settings.drive.max_turn_speed * frame_s;
  if (velocity.x * velocity.x + velocity.z * velocity.z < 1e-8f) return 0;
  return fminf(
      fmaxf(wrapped(atan2f(velocity.x, velocity.z) - transform_heading(&one->placement.shown_at)), -max),
      max);
}

CALL(move_and_slide) {
  soft_character *one = self;
  sbf_vec3 v = one->movement.velocity, real = one->movement.real_velocity,
           wanted = one->movement.wanted_velocity;
  UNUSED;
  gd_assign(result, gd_bool(false));
  if (!one->world || one->is_in_editor) return;
  if (one->loose.is_loose) {
    soft_character_error(one, "move_and_slide: nothing of it walks: use set_soft_velocity or apply_impulse");
    return;
  }
  float frame_s = (float)gd_take_float(GD_CALL(&one->node, "get_physics_process_delta_time"));
  float along = real.x * wanted.x + real.z * wanted.z, speed = wanted.x * wanted.x + wanted.z * wanted.z;
  gd_assign(result, gd_bool(speed > 0 && along < BLOCKED * speed));
  one->movement.wanted_velocity = v;
  sbr_character_displace(one->world, one->id, (sbf_vec3){v.x * frame_s, v.y * frame_s, v.z * frame_s},
      turn_of_frame(one, v, frame_s));
}

CALL(get_real_velocity) {
  const soft_character *one = self;
  UNUSED;
  gd_assign(result, gd_vector3(one->movement.real_velocity));
}

void soft_character_measure_velocity(soft_character *one, float frame_s) {
  sbf_vec3 o = one->placement.shown_at.origin, was = one->placement.last_origin;
  one->placement.last_origin = o;
  if (frame_s > 0)
    one->movement.real_velocity =
        (sbf_vec3){(o.x - was.x) / frame_s, (o.y - was.y) / frame_s, (o.z - was.z) / frame_s};
}

const gd_method soft_character_movement_methods[] = {
    {"move_and_slide", move_and_slide, ANSWER(BOOL), 0, {{0}}},
    {"get_real_velocity", get_real_velocity, ANSWER(VECTOR3), 0, {{0}}},
    {0},
};
