/* Springs with different stiffness in compression and tension, in every scheme with forces: a mass on one of
 * 1 m along x, pulled or compressed by a constant acceleration. */
#include <math.h>

#include "harness.h"
#include "scenes.h"

static const sbf_scheme schemes[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED,
    SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_HEUN, SBF_SCHEME_BLOCK_DESCENT};
enum { SCHEME_COUNT = 5 };

static const float MASS = 2, STIFFNESS = 50, PULL_M_S2 = 0.5f;

static scene mass_on_a_spring(int scheme, const float *ratio, float acceleration, float tear_strain) {
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}};
  const float masses[] = {0, MASS};
  const uint32_t pinned = 0;
  sbf_level *level = scene_points(&s, 0, positions, masses, 2);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &STIFFNESS, 1);
  sbf_spring_set *set = (sbf_spring_set *)(uintptr_t)level->springs.at;
  set->compression_ratio = (sbf_f32_list){ratio, 1};
  set->tear_strain = tear_strain; /* above 0: rest lengths and strengths are state */
  scene_pin(&s, level, -1, &pinned, 1);
  scene_body(&s, 0)->attributes.damping_ratio = 1;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){acceleration, 0, 0};
  s.model_options.scheme = schemes[scheme];
  s.model_options.substeps = 16;
  return s;
}

/* Rest position: m a / k beyond 1 m, or m a / (r k) short of it, and the spring's force there. */
static void check(int scheme, const float *ratio, float tear_strain) {
  for (int side = -1; side <= 1; side += 2) {
    scene s = mass_on_a_spring(scheme, ratio, (float)side * PULL_M_S2, tear_strain);
    scene_start(&s);
    scene_ticks(&s, 1200);
    double k = (double)(side < 0 ? STIFFNESS * *ratio : STIFFNESS),
           off = side * (double)(MASS * PULL_M_S2) / k;
    ck_assert_double_eq_tol((double)scene_point(&s, 0, 1).x - 1, off,
        5e-5 + 1e-3 * fabs(off)); /* of places of single precision */
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert_double_eq_tol(health.elastic_j, 0.5 * k * off * off, 6e-3 * k * off * off);
    scene_free(&s);
  }
}

START_TEST(compressed_springs_have_their_own_stiffness)
{
  static const float ratios[] = {0.25f, 1, 3};
  for (int r = 0; r < 3; r++) {
    check(_i, &ratios[r], 0);
    if (schemes[_i] != SBF_SCHEME_BLOCK_DESCENT) check(_i, &ratios[r], 10);
  }
}
END_TEST

/* A string has no force in compression, so the mass falls. */
START_TEST(strings_only_pull)
{
  static const float ratio = 0;
  scene s = mass_on_a_spring(_i, &ratio, -PULL_M_S2, 0);
  scene_body(&s, 0)->attributes.damping_ratio = 0;
  scene_start(&s);
  scene_ticks(&s, 60);
  ck_assert_double_eq_tol((double)scene_point(&s, 0, 1).x, 1 - 0.5 * (double)PULL_M_S2, 5e-3);
  scene_free(&s);
}
END_TEST

/* Springs that support the body's weight in the authored shape also do so in compression. */
START_TEST(a_weight_is_supported_by_contact_impulses)
{
  static const float ratio = 0.25f;
  scene s = mass_on_a_spring(_i, &ratio, -PULL_M_S2, 0);
  scene_body(&s, 0)->attributes.sag_free = true;
  s.asset->environment.gravity = s.world_definition.gravity;
  scene_start(&s);
  scene_ticks(&s, 120);
  ck_assert_double_eq_tol((double)scene_point(&s, 0, 1).x, 1, 1e-3);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("spring_forces");
  TCase *c = tcase_create("spring_forces");
  tcase_add_loop_test(c, compressed_springs_have_their_own_stiffness, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, strings_only_pull, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, a_weight_is_supported_by_contact_impulses, 0, SCHEME_COUNT);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
