#include "prepare/softening.h"

#include "harness.h"
#include "sbfmt/codes.h"
#include "scenes.h"
#include "soft/solvers/scheme.h"
#include "state/state.h"
#include "state/world.h"

/* A cube of 0.4 m and 64 kg, 1 m above the ground. */
static scene make(float young_pa, float poisson, sbf_scheme scheme) {
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.4f, 0.4f}, 4, 4, 4, 1000, young_pa, poisson);
  scene s = scene_begin();
  scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->attributes.poisson_ratio = poisson;
  s.model_options.scheme = scheme;
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  lattice_box_free(&box);
  return s;
}

/* ---- Energy of falling bodies ---- */

static const struct {
  sbf_scheme scheme;
  float young_pa, poisson;
} falls[] = {{SBF_SCHEME_POSITION_BASED, 1e6f, 0.499f}, {SBF_SCHEME_POSITION_BASED, 1e7f, 0.499f},
    {SBF_SCHEME_POSITION_BASED, 1e8f, 0.48f}, {SBF_SCHEME_POSITION_BASED, 1e9f, 0.45f},
    {SBF_SCHEME_AUTOMATIC, 1e7f, 0.3f}, {SBF_SCHEME_AUTOMATIC, 1e7f, 0.45f},
    {SBF_SCHEME_AUTOMATIC, 1e12f, 0.499f}};
enum { FALLS = 7 };

/* Undamped, so that the scheme's own energy errors show. The energy of explicit steps varies near the
 * limit. */
START_TEST(falling_bodies_gain_no_energy)
{
  scene s = make(falls[_i].young_pa, falls[_i].poisson, falls[_i].scheme);
  scene_start(&s);
  double begin = 0;
  for (int i = 0; i < 120; i++) {
    scene_ticks(&s, 1);
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    double energy = health.kinetic_j + health.elastic_j + health.potential_j;
    if (i == 0) begin = energy;
    ck_assert(health.finite);
    ck_assert_double_le(energy, 1.02 * begin);
  }
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert_uint_eq(health.recoveries, 0);
  ck_assert_float_eq_tol(health.volume_ratio, 1, 0.05f);
  scene_free(&s);
}
END_TEST

/* ---- Softening ---- */

START_TEST(softening_stops_at_the_budget)
{
  static const float moduli[] = {1e7f, 1e10f, 1e12f};
  scene s = make(moduli[_i], 0.48f, SBF_SCHEME_AUTOMATIC);
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  uint32_t substeps = sbr_model_get_substeps(s.model);
  ck_assert_ptr_eq(island->scheme, &sbri_symplectic);
  ck_assert_uint_le(substeps, SBRI_MAX_SUBSTEPS);
  if (_i == 0) {
    ck_assert_float_eq(island->stability.softened_bulk, 1);
    ck_assert_float_eq(island->stability.softened_shear, 1);
  } else {
    ck_assert_uint_ge(substeps, 96 * SBRI_MAX_SUBSTEPS / 100);
    ck_assert_float_lt(island->stability.softened_bulk, 1);
  }
  if (_i == 1) ck_assert_float_gt(island->stability.softened_shear, 0.2f); /* the bulk modulus is first */
  scene_free(&s);
}
END_TEST

/* A corner is moved to within a ten thousandth of a cell of its neighbour: only its elements are softened. */
START_TEST(a_sliver_does_not_soften_its_neighbours)
{
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.4f, 0.4f}, 4, 4, 4, 1000, 1e8f, 0.4f);
  uint32_t corner = lattice_box_point(&box, 0, 0, 0);
  box.positions[corner] = (sbf_vec3){0.09999f, 1.09999f, 0.09999f};
  scene s = scene_begin();
  scene_lattice(&s, 0, &box);
  scene_start(&s);
  const sbri_body *body = &s.model->bodies[0];
  uint32_t softened = 0;
  for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
    const uint32_t *at = box.tetrahedra[t].at;
    bool sliver = at[0] == corner || at[1] == corner || at[2] == corner || at[3] == corner;
    softened += body->elements.moduli[t] < 0.99f * box.young_modulus[t];
    if (!sliver) ck_assert_float_eq(body->elements.moduli[t], box.young_modulus[t]);
  }
  ck_assert_uint_gt(softened, 0);
  ck_assert_float_lt(s.model->islands[0].stability.softened_shear, 1);
  scene_free(&s);
  lattice_box_free(&box);
}
END_TEST

/* Requests are fulfilled or refused. */
START_TEST(requested_schemes_keep_the_moduli)
{
  scene s = make(1e12f, 0.3f, SBF_SCHEME_SYMPLECTIC);
  sbf_diagnostic error;
  ck_assert_int_ne(sbr_model_create(s.asset, &s.model_options, &s.model, &error), SBF_OK);
  ck_assert_int_eq(error.code, SBF_CODE_TOO_STIFF);
  scene_free(&s);
  s = make(1e12f, 0.3f, SBF_SCHEME_POSITION_BASED);
  s.model_options.substeps = 20;
  scene_start(&s);
  ck_assert_float_eq(s.model->bodies[0].elements.moduli[0], 1e12f);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("softening");
  TCase *c = tcase_create("softening");
  tcase_add_loop_test(c, falling_bodies_gain_no_energy, 0, FALLS);
  tcase_add_loop_test(c, softening_stops_at_the_budget, 0, 3);
  tcase_add_test(c, a_sliver_does_not_soften_its_neighbours);
  tcase_add_test(c, requested_schemes_keep_the_moduli);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
