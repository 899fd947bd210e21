#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "random.h"
#include "scenes.h"
#include "soft/solvers/descent_table.h"
#include "state/world.h"

static const double PI = 3.14159265358979323846;

/* A beam of tetrahedra held at x = 0, as in tests/mechanics/test_static_solve.c. */
static scene make_beam(float young, sbf_scheme scheme, uint32_t substeps) {
  scene s = scene_begin();
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, 10, 2, 2, 1000, young, 0.4f);
  lattice_box_hold(&box);
  scene_lattice(&s, 0, &box);
  lattice_box_free(&box);
  s.model_options.scheme = scheme;
  s.model_options.substeps = substeps;
  scene_start(&s);
  return s;
}

/* Its static shape, found by long damped steps of the symplectic scheme. */
static float hangs_at(float young) {
  scene s = scene_begin();
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, 10, 2, 2, 1000, young, 0.4f);
  lattice_box_hold(&box);
  scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->attributes.damping_ratio = 1;
  s.model_options.scheme = SBF_SCHEME_SYMPLECTIC;
  scene_start(&s);
  scene_ticks(&s, 240);
  float y = scene_point(&s, 0, lattice_box_point(&box, 10, 1, 1)).y;
  lattice_box_free(&box);
  scene_free(&s);
  return y;
}

START_TEST(it_hangs_at_the_minimum_of_energy)
{
  float expected = hangs_at(1e6f);
  scene s = make_beam(1e6f, SBF_SCHEME_BLOCK_DESCENT, 10);
  scene_ticks(&s, 180);
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, 10, 2, 2, 1000, 1e6f, 0.4f);
  float found = scene_point(&s, 0, lattice_box_point(&box, 10, 1, 1)).y;
  lattice_box_free(&box);
  ck_assert_float_lt(expected, -0.1f);
  ck_assert_float_eq_tol(found, expected, 5e-4f);
  scene_free(&s);
}
END_TEST

/* One mass on a spring, moving along it. Implicit Euler damps it at the ratio w h / 2 and lengthens its
 * period. */
START_TEST(it_damps_as_implicit_euler_does)
{
  const float k = 400; /* w = 20 */
  const sbf_vec3 at[2] = {{0, 0, 0}, {1, 0, 0}};
  const float masses[2] = {1, 1};
  const sbf_uint2 ends = {{0, 1}};
  const uint32_t pinned = 0;
  scene s = scene_begin();
  sbf_level *level = scene_points(&s, 0, at, masses, 2);
  scene_springs(&s, level, &ends, &k, 1);
  scene_pin(&s, level, -1, &pinned, 1);
  scene_body(&s, 0)->attributes.gravity_scale = 0;
  s.model_options.scheme = SBF_SCHEME_BLOCK_DESCENT;
  s.model_options.substeps = 4;
  scene_start(&s);
  sbri_positions(sbri_character_of(s.world, s.character))[s.model->bodies[0].slots.from_point[1]].x = 1.1f;
  double peak[4] = {0}, before = 0.1, older = 0.1;
  int peaks = 0;
  for (int i = 0; i < 200 && peaks < 4; i++) {
    scene_ticks(&s, 1);
    double off = (double)scene_point(&s, 0, 1).x - 1;
    if (before > older && before > off && before > 0) peak[peaks++] = before;
    older = before, before = off;
  }
  ck_assert_int_eq(peaks, 4);
  double w = 20, h = 1.0 / 240, decrement = log(peak[0] / peak[3]) / 3;
  ck_assert_double_eq_tol(decrement / (2 * PI), 0.5 * w * h, 0.08 * 0.5 * w * h);
  scene_free(&s);
}
END_TEST

/* Too stiff for any explicit step, then scrambled, then inverted. */
START_TEST(any_stiffness_is_stable)
{
  scene s = make_beam(1e8f, SBF_SCHEME_BLOCK_DESCENT, 3);
  sbri_point *x = sbri_positions(sbri_character_of(s.world, s.character));
  uint32_t state = 5;
  for (uint32_t i = 0; _i == 1 && i < s.model->islands[0].free_count; i++) {
    random_next(&state);
    x[i].x += 0.4f * ((float)(state >> 8) / 16777216 - 0.5f);
    x[i].y += 0.4f * ((float)(state * 7 >> 8) / 16777216 - 0.5f);
  }
  double max = 0;
  for (int i = 0; i < 120; i++) {
    scene_ticks(&s, 1);
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(health.finite);
    if (i > 60) max = fmax(max, health.kinetic_j);
  }
  ck_assert_double_lt(max, 5);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  if (_i == 0) ck_assert(!health.inverted);
  scene_free(&s);
}
END_TEST

START_TEST(points_of_a_block_have_no_common_element)
{
  scene s = make_beam(1e6f, SBF_SCHEME_BLOCK_DESCENT, 0);
  const sbri_island *island = &s.model->islands[0];
  const sbri_descent *d = island->descent;
  uint32_t seen = 0, corners = 0;
  ck_assert_uint_ge(d->colour_count, 4);
  ck_assert_uint_le(d->colour_count, 16);
  for (uint32_t b = 0; b < d->block_count; b++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
      const sbri_descent_block *block = &d->blocks[b];
      if (!(block->masses[lane] > 0)) continue;
      seen++;
      for (uint32_t c = block->first_corner; c < block->corner_end; c++) {
        const sbri_tetrahedron_block *of = &d->corners[c];
        if (!(of->shear[lane] > 0)) continue;
        corners++;
        ck_assert_uint_eq(of->corners[0][lane], block->slots[lane]);
        for (uint32_t other = 0; other < SBRI_BLOCK; other++)
          for (int k = 1; k < 4 && other != lane && block->masses[other] > 0; k++)
            ck_assert_uint_ne(of->corners[k][lane], block->slots[other]);
      }
    }
  uint32_t heavy = 0;
  for (uint32_t i = 0; i < island->free_count; i++) heavy += island->masses[i] > 0;
  ck_assert_uint_eq(seen, heavy);
  ck_assert_uint_gt(corners, 3 * island->tetrahedra.count); /* all but those of held points */
  scene_free(&s);
}
END_TEST

START_TEST(every_lane_width_gives_the_same_bits)
{
  uint64_t hash = 0;
  for (int i = SBR_INSTRUCTIONS_SCALAR; i <= SBR_INSTRUCTIONS_WASM_SIMD128; i++) {
    if (!sbr_instructions_are_available((sbr_instructions)i)) continue;
    scene s = scene_begin();
    scene_bodies(&s, 2);
    scene_bone(&s, (sbf_vec3){0, 0.1f, 0});
    lattice_box box =
        lattice_box_make((sbf_vec3){1, 0, 0}, (sbf_vec3){0.6f, 0.2f, 0.2f}, 6, 2, 2, 1000, 1e5f, 0.4f);
    scene_lattice(&s, 0, &box);
    lattice_box_free(&box);
    scene_section(&s, 1, (sbf_vec3){0, 0.1f, 0}, (sbf_vec3){0.3f, 0.2f, 0.4f}, 3);
    for (uint32_t b = 0; b < 2; b++) {
      scene_body(&s, b)->attributes.friction = 0.4f;
      scene_body(&s, b)->attributes.damping_ratio = 0.1f;
    }
    s.world_definition.ground = sbr_ground_slope(10);
    s.character_definition.position = (sbr_double3){0, 0.2, 1};
    s.model_options.scheme = SBF_SCHEME_BLOCK_DESCENT;
    s.model_options.instructions = (sbr_instructions)i;
    scene_start(&s);
    sbr_character_set_drive(s.world, s.character, 0.3f, 0, 0.5f);
    scene_ticks(&s, 90);
    uint64_t found = sbr_world_get_state_hash(s.world);
    for (uint32_t b = 0; b < 2; b++) {
      sbr_body_health health = sbr_character_get_body_health(s.world, s.character, b);
      ck_assert(health.finite && !health.inverted);
      ck_assert_uint_eq(health.recoveries, 0);
    }
    if (!hash) hash = found;
    ck_assert_msg(found == hash, "%s", sbr_instructions_get_name((sbr_instructions)i));
    scene_free(&s);
  }
}
END_TEST

START_TEST(yielding_materials_are_refused)
{
  scene s = scene_begin();
  lattice_box box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 1, 1}, 1, 1, 1, 1000, 1e5f, 0.4f);
  scene_lattice(&s, 0, &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.tear_strain = 0.5f;
  s.model_options.scheme = SBF_SCHEME_BLOCK_DESCENT;
  sbf_diagnostic error;
  ck_assert_int_eq(sbr_model_create(s.asset, &s.model_options, &s.model, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "yield or tear"));
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *s = suite_create("block descent");
  TCase *c = tcase_create("block descent");
  tcase_add_test(c, it_hangs_at_the_minimum_of_energy);
  tcase_add_test(c, it_damps_as_implicit_euler_does);
  tcase_add_loop_test(c, any_stiffness_is_stable, 0, 2);
  tcase_add_test(c, points_of_a_block_have_no_common_element);
  tcase_add_test(c, every_lane_width_gives_the_same_bits);
  tcase_add_test(c, yielding_materials_are_refused);
  suite_add_tcase(s, c);
  return harness_run(s);
}
