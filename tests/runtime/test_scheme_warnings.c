/* Warnings about schemes with a known error of the energy. */
#include <string.h>

#include "harness.h"
#include "sbfmt/codes.h"
#include "scenes.h"
#include "soft/solvers/scheme.h"
#include "state/world.h"

typedef struct heard {
  uint32_t count;
  char last[512];
} heard;

static void hear(void *user, const sbf_diagnostic *diagnostic) {
  heard *h = user;
  h->count++;
  ck_assert_int_eq(diagnostic->code, SBF_CODE_SCHEME_BIASED);
  ck_assert_int_eq(diagnostic->severity, SBF_SEVERITY_WARNING);
  strncpy(h->last, diagnostic->message, sizeof h->last - 1);
}

/* A pinned section of springs, or an unpinned bar of tetrahedra. */
static scene make(bool solid, float modulus, sbf_scheme scheme, uint32_t substeps) {
  scene s = scene_begin();
  if (solid) {
    lattice_box box =
        lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, 10, 2, 2, 1000, modulus, 0.3f);
    scene_lattice(&s, 0, &box);
    lattice_box_free(&box);
  } else {
    scene_bone(&s, (sbf_vec3){0, 1, 0});
    scene_body(&s, 0)->attributes.young_modulus = modulus;
    scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.3f, 0.6f}, 3);
  }
  s.model_options.scheme = scheme, s.model_options.substeps = substeps;
  scene_start(&s);
  return s;
}

typedef struct doubt_case {
  bool solid;
  float modulus;
  sbf_scheme scheme;
  uint32_t substeps;
  const char *reported; /* NULL: nothing */
} doubt_case;

static const doubt_case cases[] = {
    {false, 8e4f, SBF_SCHEME_AUTOMATIC, 0, NULL},
    {true, 1e6f, SBF_SCHEME_AUTOMATIC, 0, NULL},
    {true, 1e9f, SBF_SCHEME_AUTOMATIC, 0, NULL}, /* 377 substeps */
    {false, 8e4f, SBF_SCHEME_HEUN, 0, NULL},
    {false, 8e4f, SBF_SCHEME_SYMPLECTIC, 1, "may become unstable"},
    {false, 8e4f, SBF_SCHEME_POSITION_BASED, 0, NULL},
    {false, 8e4f, SBF_SCHEME_POSITION_BASED, 2, "times as far"},
    {false, 1e12f, SBF_SCHEME_AUTOMATIC, 0, "times as far"}, /* nothing else can step it */
    {true, 1e6f, SBF_SCHEME_POSITION_BASED, 0, NULL},
    {true, 1e6f, SBF_SCHEME_POSITION_BASED, 8, "by a tenth or more too much"},
    {true, 1e9f, SBF_SCHEME_POSITION_BASED, 0, NULL}, /* as many as are stable */
    {true, 1e9f, SBF_SCHEME_POSITION_BASED, 64, "several times too much"},
    {true, 1e12f, SBF_SCHEME_AUTOMATIC, 0, "of its bulk modulus"},
    {true, 1e6f, SBF_SCHEME_BLOCK_DESCENT, 0, "79 % slower"},
    {false, 8e4f, SBF_SCHEME_BLOCK_DESCENT, 0, "damping ratio of 0.14"},
};

START_TEST(known_errors_are_reported)
{
  const doubt_case *is = &cases[_i];
  scene s = make(is->solid, is->modulus, is->scheme, is->substeps);
  heard h = {0};
  ck_assert_uint_eq(sbr_model_report_scheme_bias(s.model, hear, &h), is->reported ? 1 : 0);
  ck_assert_uint_eq(h.count, is->reported ? 1 : 0);
  if (is->reported) ck_assert_msg(strstr(h.last, is->reported) != NULL, "%s", h.last);
  ck_assert_uint_eq(sbr_model_report_scheme_bias(s.model, NULL, NULL), h.count);
  ck_assert_uint_eq(sbr_model_report_scheme_bias(NULL, hear, &h), 0);
  scene_free(&s);
}
END_TEST

/* With the automatic scheme, bodies are stepped by a scheme that follows the energy, if there is one. */
START_TEST(a_stiff_body_is_stepped_explicitly)
{
  scene s = make(true, 1e9f, SBF_SCHEME_AUTOMATIC, 0);
  ck_assert_ptr_eq(s.model->islands[0].scheme, &sbri_symplectic);
  ck_assert_uint_gt(sbr_model_get_substeps(s.model), 256);
  scene_ticks(&s, 10);
  ck_assert_uint_eq(sbri_island_states(&s.world->characters[0])[0].recovery.ticks, 0);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("scheme_doubts");
  TCase *c = tcase_create("scheme_doubts");
  tcase_add_loop_test(c, known_errors_are_reported, 0, sizeof cases / sizeof *cases);
  tcase_add_test(c, a_stiff_body_is_stepped_explicitly);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
