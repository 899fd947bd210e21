/* Soft bodies on simulated bones that are put back into their rest shape. */
#include <math.h>

#include "coupling/ragdoll/ragdoll.h"
#include "harness.h"
#include "math/vec3.h"
#include "momentum.h"
#include "rigid_scenes.h"
#include "soft/soft.h"
#include "state/world.h"

static const float BOX_KG[2] = {0.5f, 2};

/* A block of soft tissue of that mass that hangs on a box at each end, or on one alone. */
static scene block(float soft_kg, uint32_t ends) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  scene_bodies(&s, 1);
  lattice_box box = lattice_box_make(
      (sbf_vec3){-0.2f, -0.05f, -0.05f}, (sbf_vec3){0.4f, 0.1f, 0.1f}, 8, 2, 2, soft_kg / 0.004f, 3e4f, 0.4f);
  sbf_level *level = scene_lattice(&s, 0, &box);
  for (uint32_t end = 0; end < ends; end++) {
    uint32_t points[9], body = rigid_box(&s, (sbf_vec3){end ? 0.22f : -0.22f, 0, 0},
                            (sbf_vec3){0.08f, 0.12f, 0.2f}, BOX_KG[end]);
    for (uint32_t i = 0; i < 9; i++) points[i] = lattice_box_point(&box, end ? 8 : 0, i % 3, i / 3);
    rigid_pin(&s, level, end, (int32_t)body, points, 9);
  }
  lattice_box_free(&box);
  scene_start(&s);
  return s;
}

/* Angular momentum about the centre of mass of all. */
static void turning_of(const scene *s, uint32_t ends, double to[3]) {
  scene_momentum all = scene_momentum_of(s);
  const sbri_character *c = sbri_character_of(s->world, s->character);
  sbri_whole_momentum m = sbri_island_momentum(c, 0);
  for (uint32_t b = 0; b < ends; b++)
    sbri_momentum_add(&m, (double)BOX_KG[b], sbri_rigid_bodies(c)[b].pose.position, (sbf_vec3){0, 0, 0});
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    to[k] = all.angular[k] - (m.first[i] * all.linear[j] - m.first[j] * all.linear[i]) / all.mass;
  }
}

static double kinetic_of(const scene *s, uint32_t ends) {
  sbr_body_health health = sbr_character_get_body_health(s->world, s->character, 0);
  return health.kinetic_j + rigid_energy(s, ends);
}

static const struct {
  float soft_kg;
  uint32_t ends;
} blocks[] = {{1, 1}, {1, 2}, {50, 2}, {0.05f, 2}};

/* A pile of soft tissue whose points move at some metres per second is put back. Momentum and angular
 * momentum of bones and soft tissue are conserved, and energy does not rise. */
START_TEST(a_reset_keeps_the_momentum)
{
  uint32_t ends = blocks[_i].ends;
  scene s = block(blocks[_i].soft_kg, ends);
  sbri_character *c = sbri_character_of(s.world, s.character);
  const sbri_island *island = &c->model->islands[0];
  rigid_push(&s, 0, (sbf_vec3){0, 0, 0.05f}, (sbf_vec3){0.5f, 0.8f, 0.2f});
  scene_ticks(&s, 5);
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    sbri_point *x = &sbri_positions(c)[island->first_slot + slot];
    float *v = sbri_velocities(c) + 3 * (size_t)island->first_slot +
               3 * (size_t)(slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    if (!(island->masses[slot] > 0)) continue;
    *x = (sbri_point){0.3f * x->y, -0.5f * x->x, 0.2f * x->z, 0};
    v[0] += 3 * x->y, v[SBRI_BLOCK] += 2 + 20 * x->z, v[2 * SBRI_BLOCK] += (float)(slot % 5) - 1;
  }
  double before[3], after[3], energy = kinetic_of(&s, ends);
  scene_momentum was = scene_momentum_of(&s), now;
  turning_of(&s, ends, before);
  sbri_whole_momentum had = sbri_island_momentum(c, 0);
  sbri_island_reset_to_rest(c, 0);
  sbri_attached_body_set_momentum(c, 0, &had);
  now = scene_momentum_of(&s);
  turning_of(&s, ends, after);
  for (int k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(now.linear[k], was.linear[k], 1e-6 * was.mass * 3);
    ck_assert_double_eq_tol(after[k], before[k], 1e-6 * was.mass * 3);
  }
  ck_assert_double_ge(fabs(was.linear[1]), 0.3 * was.mass);
  ck_assert_double_le(kinetic_of(&s, ends), energy);
  scene_free(&s);
}
END_TEST

/* A body with NaN positions has no momentum to conserve: it takes the motion of its bone. */
START_TEST(bodies_with_invalid_numbers_follow_their_bone)
{
  scene s = block(1, 1);
  sbri_character *c = sbri_character_of(s.world, s.character);
  rigid_push(&s, 0, (sbf_vec3){0, 0, 0}, (sbf_vec3){0, 1, 0});
  scene_ticks(&s, 30);
  sbri_whole_momentum none = {0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  sbf_vec3 v = rigid_state(&s, 0).velocity, turn = rigid_state(&s, 0).angular_velocity;
  sbri_island_reset_to_rest(c, 0);
  sbri_attached_body_set_momentum(c, 0, &none);
  ck_assert_float_eq(rigid_state(&s, 0).velocity.y, v.y);
  const sbri_point *x = &sbri_positions(c)[c->model->islands[0].first_slot];
  sbf_vec3 arm = sbri_sub((sbf_vec3){x->x, x->y, x->z}, sbri_rigid_bodies(c)[0].pose.position);
  sbf_vec3 with = sbri_add(v, sbri_cross(turn, arm)), goes = scene_slot_velocity(c, &c->model->islands[0], 0);
  ck_assert_float_le(sbri_length(sbri_sub(with, goes)), 1e-5f);
  ck_assert_float_ge(fabsf(v.y), 0.1f);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("put_back");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, a_reset_keeps_the_momentum, 0, sizeof blocks / sizeof *blocks);
  tcase_add_test(tests, bodies_with_invalid_numbers_follow_their_bone);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
