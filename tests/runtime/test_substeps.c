#include <math.h>

#include "harness.h"
#include "random.h"
#include "sbfmt/codes.h"
#include "scenes.h"
#include "state/world.h"

static scene section(float modulus, float beta) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0, 0});
  scene_body(&s, 0)->attributes.young_modulus = modulus;
  scene_body(&s, 0)->attributes.stiffness_damping = beta;
  scene_section(&s, 0, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.15f, 0.3f}, 4);
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  return s;
}

/* Energy after two seconds over that at the start, in which all points lie a little off. */
static double growth(scene *s) {
  sbri_character *c = sbri_character_of(s->world, s->character);
  uint32_t random = 1;
  for (uint32_t i = 0; i < c->model->islands[0].free_count; i++) {
    sbri_positions(c)[i].x += 1e-4f * (float)(int32_t)random_next(&random) / 2147483648.0f;
  }
  double before = sbr_character_get_body_health(s->world, s->character, 0).elastic_j;
  scene_ticks(s, 120);
  sbr_body_health h = sbr_character_get_body_health(s->world, s->character, 0);
  return h.finite && h.recoveries == 0 ? (h.elastic_j + h.kinetic_j) / before : INFINITY;
}

START_TEST(substeps_are_sufficient_and_hardly_more)
{
  const float moduli[] = {2e4f, 3e5f, 2e6f};
  for (int i = 0; i < 3; i++) {
    scene s = section(moduli[i], 0);
    scene_start(&s);
    uint32_t needed = sbr_model_get_substeps(s.model);
    ck_assert_double_lt(growth(&s), 4); /* it vibrates more, the nearer the bound */
    scene_free(&s);

    if (needed < 8) continue; /* rounding up leaves a wide margin */
    scene few = section(moduli[i], 0);
    few.model_options.substeps = (uint32_t)((double)needed / 1.35);
    scene_start(&few);
    ck_assert_uint_lt(few.model_options.substeps, needed);
    ck_assert_double_gt(growth(&few), 100);
    scene_free(&few);
  }
}
END_TEST

START_TEST(damped_springs_need_more)
{
  scene plain = section(3e5f, 0), damped = section(3e5f, 1e-3f);
  scene_start(&plain);
  scene_start(&damped);
  ck_assert_uint_gt(sbr_model_get_substeps(damped.model), sbr_model_get_substeps(plain.model));
  ck_assert_double_lt(growth(&damped), 0.01);
  scene_free(&plain);
  scene_free(&damped);
}
END_TEST

START_TEST(stretched_springs_need_more_up_to_a_bound)
{
  scene s = section(3e5f, 0);
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  uint32_t rest = sbri_stable_substeps(island, 1.0 / 60, 0),
           some = sbri_stable_substeps(island, 1.0 / 60, 0.2f);
  uint32_t much = sbri_stable_substeps(island, 1.0 / 60, 0.95f);
  ck_assert_uint_gt(some, rest);
  ck_assert_uint_gt(much, some);
  ck_assert_double_le(much, ceil(1.02 * island->stability.bound_rad_s / 120));
  ck_assert_uint_eq(sbri_stable_substeps(island, 1.0 / 60, -3), rest);
  scene_free(&s);
}
END_TEST

/* Numbers beyond the range of an integer are not converted, because the result differs between machines. */
START_TEST(extremely_stiff_bodies_have_bounded_substeps)
{
  const double frequencies[] = {1e9, 1e30, INFINITY, (double)NAN};
  uint32_t bound = 0;
  for (int i = 0; i < 4; i++) {
    sbri_island island = {.stability.external_rad_s = frequencies[i]};
    uint32_t substeps = sbri_stable_substeps(&island, 1.0 / 60, 0);
    ck_assert_uint_gt(substeps, SBRI_MAX_SUBSTEPS);
    ck_assert_uint_le(4 * (uint64_t)substeps, UINT32_MAX); /* what schemes multiply it by */
    if (i > 0) ck_assert_uint_eq(substeps, bound);
    bound = substeps;
  }
}
END_TEST

/* Scrambled, every point at random in a box: springs stretched tenfold and more. */
START_TEST(a_body_thrown_into_a_knot_does_not_burst)
{
  scene s = section(1e5f, 0);
  scene_body(&s, 0)->attributes.damping_ratio = 0.2f;
  scene_start(&s);
  sbri_character *c = sbri_character_of(s.world, s.character);
  uint32_t random = 5;
  for (uint32_t i = 0; i < c->model->islands[0].free_count; i++) {
    float *p = &sbri_positions(c)[i].x;
    for (int k = 0; k < 3; k++) { p[k] = 0.5f * (float)(int32_t)random_next(&random) / 2147483648.0f; }
  }
  sbri_island_states(c)[0].stretch = 0.95f; /* the same as if it had reached this state by itself */
  double before = sbr_character_get_body_health(s.world, s.character, 0).elastic_j, max = 0;
  for (int i = 0; i < 300; i++) {
    scene_ticks(&s, 1);
    sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(h.finite);
    max = fmax(max, h.elastic_j + h.kinetic_j);
  }
  ck_assert_double_lt(max, 1.5 * before);
  scene_free(&s);
}
END_TEST

START_TEST(too_stiff_bodies_are_refused)
{
  scene s = section(1e12f, 0);
  sbf_diagnostic error;
  s.model_options.scheme = SBF_SCHEME_SYMPLECTIC; /* left to the runtime, it would take another */
  ck_assert_int_eq(sbr_model_create(s.asset, &s.model_options, &s.model, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_TOO_STIFF);
  ck_assert_ptr_null(s.model);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("substeps");
  TCase *c = tcase_create("substeps");
  tcase_add_test(c, substeps_are_sufficient_and_hardly_more);
  tcase_add_test(c, damped_springs_need_more);
  tcase_add_test(c, stretched_springs_need_more_up_to_a_bound);
  tcase_add_test(c, extremely_stiff_bodies_have_bounded_substeps);
  tcase_add_test(c, a_body_thrown_into_a_knot_does_not_burst);
  tcase_add_test(c, too_stiff_bodies_are_refused);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
