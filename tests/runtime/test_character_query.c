#include "harness.h"
#include "scenes.h"
#include "state/world.h"

static const float DAMPING = 3; /* N s/m, of the spring */

/* A mass on a spring that swings, so that a step's error differs from tick to tick. */
static scene swinging(sbf_scheme scheme, uint32_t substeps, float step_error_m, bool damped) {
  static const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}};
  static const float masses[] = {0, 1}, stiffness = 900;
  scene s = scene_begin();
  sbf_level *level = scene_points(&s, 0, positions, masses, 2);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &stiffness, 1);
  scene_pin(&s, level, -1, &(uint32_t){0}, 1);
  sbf_spring_set *set = (sbf_spring_set *)(uintptr_t)level->springs.at;
  if (damped) set->damping = (sbf_f32_list){&DAMPING, 1};
  s.model_options.scheme = scheme;
  s.model_options.substeps = substeps;
  s.model_options.step_error_m = step_error_m;
  s.world_definition.sleep_after_s = 0;
  s.character_definition.position.y = 50;
  scene_start(&s);
  return s;
}

static uint32_t passes_of(sbf_scheme scheme, uint32_t substeps, float step_error_m, bool damped) {
  scene s = swinging(scheme, substeps, step_error_m, damped);
  ck_assert_uint_eq(sbr_character_get_element_visits(s.world, s.character, 0), 0);
  scene_ticks(&s, 10);
  uint32_t passes = sbr_character_get_element_visits(s.world, s.character, 0);
  scene_free(&s);
  return passes;
}

START_TEST(element_visits_match_the_scheme)
{
  ck_assert_uint_eq(passes_of(SBF_SCHEME_SYMPLECTIC, 4, 0, false), 10 * 4);
  ck_assert_uint_eq(passes_of(SBF_SCHEME_POSITION_BASED, 4, 0, false), 10 * 4);
  ck_assert_uint_eq(passes_of(SBF_SCHEME_EXPLICIT_EULER, 4, 0, false), 10 * 4);
  ck_assert_uint_eq(passes_of(SBF_SCHEME_RELAXATION, 1, 0, false), 10);
  /* One as a tick begins, and two a step; with damping one more, by the velocities as they are then. */
  ck_assert_uint_eq(passes_of(SBF_SCHEME_HEUN, 4, 0, false), 10 * (1 + 2 * 4));
  ck_assert_uint_eq(passes_of(SBF_SCHEME_HEUN, 4, 0, true), 10 * (1 + 3 * 4));
  /* In each sweep from both ends of a spring. */
  uint32_t sweeps = passes_of(SBF_SCHEME_BLOCK_DESCENT, 4, 0, false) / (10 * 4 * 2);
  ck_assert_uint_ge(sweeps, 1);
  ck_assert_uint_eq(passes_of(SBF_SCHEME_BLOCK_DESCENT, 8, 0, false), 10 * 8 * 2 * sweeps);
}
END_TEST

START_TEST(steps_that_a_scheme_chooses_are_counted)
{
  uint32_t before = 0;
  for (float error = 1e-5f; error > 1e-9f; error *= 0.1f) {
    uint32_t passes = passes_of(SBF_SCHEME_HEUN, 0, error, false);
    ck_assert_uint_gt(passes, before);
    before = passes;
  }
}
END_TEST

START_TEST(element_visits_belong_to_the_state)
{
  enum { MAX = 1 << 20 };
  static unsigned char kept[MAX];
  scene s = swinging(SBF_SCHEME_SYMPLECTIC, 2, 0, true);
  size_t size = sbr_world_get_snapshot_size(s.world);
  ck_assert_uint_le(size, MAX);
  ck_assert_int_eq(sbr_world_save_snapshot(s.world, kept, size), SBF_OK);
  scene_ticks(&s, 5);
  ck_assert_uint_eq(sbr_character_get_element_visits(s.world, s.character, 0), 10);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, kept, size), SBF_OK);
  ck_assert_uint_eq(sbr_character_get_element_visits(s.world, s.character, 0), 0);
  ck_assert_uint_eq(sbr_character_get_element_visits(s.world, s.character, 7), 0);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("character_query");
  TCase *c = tcase_create("passes");
  tcase_add_test(c, element_visits_match_the_scheme);
  tcase_add_test(c, steps_that_a_scheme_chooses_are_counted);
  tcase_add_test(c, element_visits_belong_to_the_state);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
