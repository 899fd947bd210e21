/* Selection of the scheme by the runtime: explicit steps where they suffice, position-based steps for bodies
 * that are too stiff or unstable, and the rest shape for bodies that do not recover. */
#include "soft/solvers/router.h"

#include <math.h>

#include "harness.h"
#include "random.h"
#include "scenes.h"
#include "state/world.h"

static scene section(float modulus) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  scene_body(&s, 0)->attributes.young_modulus = modulus;
  scene_body(&s, 0)->attributes.damping_ratio = 0.2f;
  scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.3f, 0.6f}, 3);
  return s;
}

static uint32_t recovering(const scene *s) {
  return sbri_island_states(&s->world->characters[0])[0].recovery.ticks;
}

START_TEST(soft_bodies_are_stepped_explicitly)
{
  uint64_t hashes[2];
  for (int k = 0; k < 2; k++) {
    scene s = section(8e4f);
    s.model_options.scheme = k ? SBF_SCHEME_SYMPLECTIC : SBF_SCHEME_AUTOMATIC;
    scene_start(&s);
    ck_assert_ptr_eq(s.model->islands[0].scheme, &sbri_symplectic);
    ck_assert(s.model->islands[0].stepping.is_routed == (k == 0));
    sbr_character_set_drive(s.world, s.character, 0.5f, 0, 1);
    scene_ticks(&s, 120);
    ck_assert_uint_eq(recovering(&s), 0);
    hashes[k] = sbr_world_get_state_hash(s.world);
    scene_free(&s);
  }
  ck_assert_uint_eq(hashes[0], hashes[1]);
}
END_TEST

START_TEST(stiff_bodies_are_stepped_implicitly)
{
  scene s = section(1e12f);
  scene_start(&s);
  ck_assert_ptr_eq(s.model->islands[0].scheme, &sbri_position_based);
  ck_assert_uint_le(sbr_model_get_substeps(s.model), 32);
  sbr_character_set_drive(s.world, s.character, 1, 0, 1);
  scene_ticks(&s, 120);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(health.finite);
  ck_assert_float_eq_tol(health.volume_ratio, 1, 0.05f);
  ck_assert_uint_eq(health.recoveries, 0);
  scene_free(&s);
}
END_TEST

START_TEST(requests_are_applied)
{
  scene s = section(8e4f);
  s.model_options.substeps = 9;
  scene_start(&s);
  ck_assert(!s.model->islands[0].stepping.is_routed);
  ck_assert_uint_eq(sbr_model_get_substeps(s.model), 9);
  scene_free(&s);
}
END_TEST

/* Speeds of more than a cell a substep, at random. */
START_TEST(thrown_bodies_recover_and_return_to_their_scheme)
{
  scene s = section(8e4f);
  scene_start(&s);
  scene_ticks(&s, 5);
  float *velocities = sbri_velocities(&s.world->characters[0]);
  uint32_t state = 7;
  for (uint32_t i = 0; i < 3 * s.model->islands[0].free_count; i++) {
    velocities[i] = 300 * random_between(&state, -1, 1);
  }
  scene_ticks(&s, 1);
  ck_assert_uint_eq(recovering(&s), SBRI_RECOVERING_TICKS);
  for (int i = 0; i < 240; i++) {
    scene_ticks(&s, 1);
    ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  }
  ck_assert_uint_eq(recovering(&s), 0);
  ck_assert_float_eq_tol(sbr_character_get_body_health(s.world, s.character, 0).volume_ratio, 1, 0.1f);
  scene_free(&s);
}
END_TEST

/* One point passes through the opposite side of its cells. The body is too soft to move fast, and too few
 * elements invert for it to count as collapsed. */
START_TEST(one_inverted_element_is_trouble)
{
  scene s = scene_begin();
  lattice_box box =
      lattice_box_make((sbf_vec3){-0.1f, 1, -0.1f}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 2, 2, 2, 1000, 500, 0.3f);
  scene_lattice(&s, 0, &box);
  uint32_t middle = lattice_box_point(&box, 1, 1, 1);
  scene_start(&s);
  ck_assert(s.model->islands[0].stepping.is_routed);
  scene_ticks(&s, 2);
  ck_assert_uint_eq(recovering(&s), 0);
  sbri_positions(&s.world->characters[0])[s.model->bodies[0].slots.from_point[middle]].x += 0.13f;
  uint32_t max = 0;
  for (int i = 0; i < 2; i++) {
    scene_ticks(&s, 1);
    max = recovering(&s) > max ? recovering(&s) : max;
  }
  ck_assert_uint_ge(max, SBRI_RECOVERING_TICKS - 1);
  lattice_box_free(&box);
  scene_free(&s);
}
END_TEST

/* Pushed through itself, all of it. */
START_TEST(inverted_bodies_recover_within_a_second)
{
  scene s = section(8e4f);
  scene_start(&s);
  sbri_point *at = sbri_positions(&s.world->characters[0]);
  const sbri_island *island = &s.model->islands[0];
  for (uint32_t i = 0; i < island->free_count; i++) at[i].x = -at[i].x;
  ck_assert_float_lt(sbr_character_get_body_health(s.world, s.character, 0).volume_ratio, 0);
  for (int i = 0; i < 60; i++) {
    scene_ticks(&s, 1);
    ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  }
  ck_assert_float_eq_tol(sbr_character_get_body_health(s.world, s.character, 0).volume_ratio, 1, 0.1f);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("router");
  TCase *c = tcase_create("router");
  tcase_add_test(c, soft_bodies_are_stepped_explicitly);
  tcase_add_test(c, stiff_bodies_are_stepped_implicitly);
  tcase_add_test(c, requests_are_applied);
  tcase_add_test(c, thrown_bodies_recover_and_return_to_their_scheme);
  tcase_add_test(c, one_inverted_element_is_trouble);
  tcase_add_test(c, inverted_bodies_recover_within_a_second);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
