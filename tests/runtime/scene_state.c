#include "scene_state.h"

#include "harness.h"
#include "random.h"

float *scene_velocity(const scene *s, uint32_t slot) {
  return sbri_velocities(&s->world->characters[0]) + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
}

void scene_spoil(const scene *s, bad_start how) {
  sbri_point *x = sbri_positions(&s->world->characters[0]);
  for (uint32_t i = 0; i < s->model->islands[0].free_count; i++) {
    if (how == START_FLAT) x[i].y = 0.1f;
    if (how == START_MIRRORED) x[i].x = -x[i].x;
    if (how == START_ONE_PLACE) x[i] = (sbri_point){0, 0, 0, 0};
    if (how == START_HEAP)
      x[i] =
          (sbri_point){random_scattered(5 * i), random_scattered(5 * i + 1), random_scattered(5 * i + 2), 0};
  }
}

void scene_comes_back(const scene *s) {
  scene going = *s;
  for (int i = 0; i < 60; i++) {
    scene_ticks(&going, 1);
    ck_assert(sbr_character_get_body_health(s->world, s->character, 0).finite);
  }
  sbr_body_health health = sbr_character_get_body_health(s->world, s->character, 0);
  ck_assert(!health.inverted);
  ck_assert_float_lt(health.max_strain, 0.1f);
}
