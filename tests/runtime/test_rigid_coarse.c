/* Rigid parts stepped coarsely: cheaper, with intact joints. */
#include <math.h>

#include "coupling/ragdoll/ragdoll.h"
#include "harness.h"
#include "host_threads.h"
#include "rigid_person.h"

enum { SHOVES = 24, FINE_SHOVES = 4, TICKS = 360, RESTS_FROM = 300 };

typedef struct fall {
  float separation, deep;    /* m: the farthest that a joint was off, the deepest that a corner was */
  float on_the_way, at_rest; /* rad: of limits */
  uint32_t steps;            /* in the first two seconds */
  int moved;                 /* ticks until nothing moves by more than 1 mm/s any more */
} fall;

static float larger(float a, float b) {
  return a > b ? a : b;
}

static float next_fraction(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (float)(*seed >> 8) / 16777216.0f;
}

static scene begin(bool whole, bool stairs, bool coarse) {
  scene s = whole ? whole_person() : person();
  if (stairs) s.world_definition.ground = sbr_ground_stairs(-0.17, 0.29);
  s.world_definition.sleep_after_s = 0.5;
  s.model_options.rigid_coarse = coarse;
  scene_start(&s);
  return s;
}

static float fastest(const scene *s, uint32_t parts) {
  float max = 0;
  for (uint32_t b = 0; b < parts; b++) {
    sbf_vec3 v = rigid_state(s, b).velocity;
    max = larger(max, sqrtf(v.x * v.x + v.y * v.y + v.z * v.z));
  }
  return max;
}

/* How deep the lowest corner is in level ground. */
static float depth(const scene *s, uint32_t parts) {
  const sbri_rigid_model *model = &s->model->rigid;
  float min = 0;
  double o = sbr_character_get_origin(s->world, s->character).y;
  for (uint32_t b = 0; b < parts; b++) {
    const sbr_transform *pose = &sbri_rigid_bodies(&s->world->characters[0])[b].pose;
    for (uint32_t i = 0; i < model->bodies[b].vertex_count; i++) {
      sbf_vec3 at = sbri_rotate(pose->rotation, model->bodies[b].vertices[i]);
      min = fminf(min, (float)(o + (double)pose->position.y + (double)at.y));
    }
  }
  return -min;
}

static fall falls(bool whole, bool stairs, bool coarse, sbf_vec3 shove) {
  scene s = begin(whole, stairs, coarse);
  uint32_t parts = whole ? ALL_PARTS : PARTS;
  fall found = {0};
  person_shove(&s, 1, shove);
  for (int t = 0; t < TICKS; t++) {
    sbr_world_tick(s.world);
    float *beyond = t < RESTS_FROM ? &found.on_the_way : &found.at_rest;
    for (uint32_t j = 0; j + 1 < parts; j++) {
      sbr_joint_state now = rigid_joint_state(&s, j);
      found.separation = larger(found.separation, now.separation),
      *beyond = larger(*beyond, now.angle_violation);
    }
    if (!stairs) found.deep = larger(found.deep, depth(&s, parts));
    if (t > 0 && t < 120) found.steps += sbri_rigid_drive(&s.world->characters[0])->substeps;
    if (fastest(&s, parts) > 1e-3f) found.moved = t + 1;
  }
  scene_free(&s);
  return found;
}

static sbf_vec3 shove_of(uint32_t *seed, bool stairs) {
  float aside = 120 * next_fraction(seed) - 60, on = 60 + 120 * next_fraction(seed);
  return (sbf_vec3){aside, 0, stairs || on < 120 ? on : -on};
}

/* Persons of 14 and 20 parts, pushed at random on level ground and down stairs. No joint separates by a third
 * of a millimetre, no limit is exceeded by a degree in motion or a tenth of one at rest, no corner is 4 mm in
 * the ground, and after 5 s nothing moves by more than 1 mm/s. All this in at most two thirds of the
 * steps. */
START_TEST(bodies_stay_whole_and_rest_with_coarse_steps)
{
  bool whole = _i & 1, stairs = _i & 2;
  uint32_t seed = 4242, steps = 0, steps_of_fine = 0;
  for (int i = 0; i < SHOVES; i++) {
    sbf_vec3 shove = shove_of(&seed, stairs);
    fall f = falls(whole, stairs, true, shove);
    ck_assert_float_le(f.separation, 3e-4f);
    ck_assert_float_le(f.on_the_way, 0.0175f);
    ck_assert_float_le(f.at_rest, 0.00175f);
    ck_assert_float_le(f.deep, 4e-3f);
    ck_assert_int_le(f.moved, RESTS_FROM);
    if (i >= FINE_SHOVES) continue;
    steps += f.steps;
    steps_of_fine += falls(whole, stairs, false, shove).steps;
  }
  ck_assert_uint_le(3 * steps, 2 * steps_of_fine);
}
END_TEST

/* A model's own number of steps is unchanged; in flight it is a quarter. */
START_TEST(requested_steps_are_kept)
{
  scene s = whole_person();
  s.model_options.rigid_coarse = true, s.model_options.rigid_substeps = 16;
  scene_start(&s);
  scene_ticks(&s, 2);
  ck_assert_uint_ge(sbri_rigid_drive(&s.world->characters[0])->substeps, 4);
  scene_free(&s);
}
END_TEST

/* Three beside each other: the same bits on one thread, on two and on four. */
START_TEST(threads_change_nothing)
{
  uint64_t hashes[3];
  for (int i = 0; i < 3; i++) {
    int threads = 1 << i;
    scene s = whole_person();
    s.world_definition.tasks = (sbr_tasks){.run = run_on_threads, .user = &threads};
    s.model_options.rigid_coarse = true;
    scene_start(&s);
    for (int k = 1; k < 3; k++) {
      sbr_character_definition d = s.character_definition;
      sbr_character_id id;
      d.position.x = 1.9 * (k == 1 ? 1 : -1);
      ck_assert(sbr_character_create(s.world, s.model, &d, &id, NULL) == SBF_OK);
    }
    person_shove(&s, 1, (sbf_vec3){40, 0, 110});
    scene_ticks(&s, 120);
    hashes[i] = sbr_world_get_state_hash(s.world);
    scene_free(&s);
  }
  ck_assert_uint_eq(hashes[0], hashes[1]);
  ck_assert_uint_eq(hashes[0], hashes[2]);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rigid coarse");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, bodies_stay_whole_and_rest_with_coarse_steps, 0, 4);
  tcase_add_test(tests, requested_steps_are_kept);
  tcase_add_test(tests, threads_change_nothing);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
