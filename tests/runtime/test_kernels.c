#include <stdio.h>
#include <string.h>

#include "harness.h"

#include "model/kernels.h"
#include "model/runtime_model.h"
#include "scenes.h"

enum { BODIES = 4, CELLS = 4, TICKS = 150 };

/* Each falls onto the ground, slides and swings: a section pinned to a bone, one with damped springs, one
 * without pins, and tetrahedra pinned at one end with their own damping. Together they cover every branch of
 * the kernel. */
static scene make_scene(void) {
  scene s = scene_begin();
  scene_bodies(&s, BODIES);
  scene_bone(&s, (sbf_vec3){0, 0.1f, 0});
  for (uint32_t b = 0; b + 1 < BODIES; b++) {
    scene_section(&s, b, (sbf_vec3){0.5f * (float)b, 0.1f, 0}, (sbf_vec3){0.3f, 0.2f, 0.4f}, CELLS);
    scene_body(&s, b)->attributes.damping_ratio = 0.1f;
    scene_body(&s, b)->attributes.friction = 0.3f;
    scene_body(&s, b)->attributes.restitution = 0.4f;
  }
  scene_body(&s, 1)->attributes.stiffness_damping = 1e-4f;
  scene_body(&s, 2)->attributes.media_friction = 0.2f;
  s.asset->environment.wind = (sbf_vec3){1, 0, 2};
  s.world_definition.ground = sbr_ground_slope(10);
  s.character_definition.position = (sbr_double3){0, 0.2, 1};
  lattice_box box =
      lattice_box_make((sbf_vec3){1.5f, 0, 0}, (sbf_vec3){0.6f, 0.2f, 0.2f}, 6, 2, 2, 1000, 4e4f, 0.4f);
  lattice_box_hold(&box);
  scene_lattice(&s, BODIES - 1, &box);
  lattice_box_free(&box);
  scene_body(&s, BODIES - 1)->attributes.stiffness_damping = 1e-4f;
  return s;
}

static uint64_t hash_after(sbr_instructions instructions, bool pinned, sbf_scheme scheme) {
  scene s = make_scene();
  s.model_options.free = !pinned;
  s.model_options.scheme = scheme;
  s.model_options.instructions = instructions;
  scene_start(&s);
  ck_assert_int_eq(sbr_model_get_instructions(s.model), instructions);
  sbr_character_set_drive(s.world, s.character, 0.3f, 0, 0.5f);
  scene_ticks(&s, HARNESS_FEW(TICKS, 40));
  for (uint32_t b = 0; b < s.asset->soft_bodies.count; b++) {
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, b);
    ck_assert(health.finite);
    if (scheme == SBF_SCHEME_EXPLICIT_EULER) continue; /* this kernel does not step such a body */
    ck_assert_uint_eq(health.recoveries, 0);
    ck_assert_float_gt(health.max_strain, 1e-4f); /* they do move */
  }
  uint64_t hash = sbr_world_get_state_hash(s.world);
  scene_free(&s);
  return hash;
}

enum { WIDTHS = SBR_INSTRUCTIONS_WASM_SIMD128 };

START_TEST(every_lane_width_gives_the_same_bits)
{
  static const sbf_scheme schemes[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED,
      SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_HEUN, SBF_SCHEME_BLOCK_DESCENT};
  bool pinned = _i % 2 != 0;
  sbf_scheme scheme = schemes[_i / 2];
  uint64_t hash = hash_after(SBR_INSTRUCTIONS_SCALAR, pinned, scheme);
  for (int i = SBR_INSTRUCTIONS_SCALAR + 1; i <= WIDTHS; i++) {
    sbr_instructions instructions = (sbr_instructions)i;
    if (sbr_instructions_are_available(instructions))
      ck_assert_msg(
          hash_after(instructions, pinned, scheme) == hash, "%s", sbr_instructions_get_name(instructions));
    else if (_i == 0)
      harness_skip("this processor does not have %s", sbr_instructions_get_name(instructions));
  }
}
END_TEST

START_TEST(a_model_uses_the_widest_lanes)
{
  scene s = make_scene();
  scene_start(&s);
  ck_assert_ptr_eq(s.model->kernels, sbri_kernels_of(SBR_INSTRUCTIONS_AUTOMATIC));
  ck_assert_int_ne(sbr_model_get_instructions(s.model), SBR_INSTRUCTIONS_AUTOMATIC);
  ck_assert_uint_ge(s.model->kernels->lanes, sbri_kernels_plain.lanes);
  ck_assert_uint_eq(sbr_get_lane_count(), s.model->kernels->lanes);
  ck_assert_uint_eq(sbri_kernels_scalar.lanes, 1);
#if defined(__x86_64__) || defined(__aarch64__)
  ck_assert_uint_ge(sbri_kernels_plain.lanes, 4);
#endif
  scene_free(&s);
}
END_TEST

START_TEST(instructions_of_other_processors_are_refused)
{
  scene s = make_scene();
  sbf_diagnostic error;
  sbr_model *model = NULL;
  s.model_options.instructions = SBR_INSTRUCTIONS_WASM_SIMD128;
#if defined(__x86_64__) || defined(__aarch64__)
  ck_assert_int_eq(sbr_model_create(s.asset, &s.model_options, &model, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "wasm_simd128"));
#endif
  s.model_options.instructions = (sbr_instructions)(WIDTHS + 1);
  ck_assert_int_eq(sbr_model_create(s.asset, &s.model_options, &model, &error), SBF_FAILED);
  ck_assert_ptr_null(sbr_instructions_get_name(s.model_options.instructions));
  ck_assert_ptr_null(model);
  ck_assert_int_eq(sbr_model_get_instructions(NULL), SBR_INSTRUCTIONS_AUTOMATIC);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *s = suite_create("kernels");
  TCase *c = tcase_create("kernels");
  tcase_add_loop_test(c, every_lane_width_gives_the_same_bits, 0, 10);
  tcase_add_test(c, a_model_uses_the_widest_lanes);
  tcase_add_test(c, instructions_of_other_processors_are_refused);
  suite_add_tcase(s, c);
  return harness_run(s);
}
