#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "scene_state.h"
#include "scenes.h"
#include "state/world.h"

static const double PI = 3.14159265358979323846;

static sbri_character *character_of(const scene *s) {
  return sbri_character_of(s->world, s->character);
}

/* 5 x 4 x 3 points of 0.1 kg, a decimetre apart, regions of 27, weightless unless told otherwise. */
static scene make_block(float w) {
  scene s = scene_begin();
  scene_regions(&s, 0, (sbf_vec3){0, 0, 0}, 0.1f, (const uint32_t[3]){5, 4, 3}, 1, w, 0.1f);
  scene_body(&s, 0)->attributes.gravity_scale = 0;
  return s;
}

/* Momentum, angular momentum about where the character's origin is at first, and energy. */
typedef struct kept {
  sbf_vec3 momentum, angular_velocity;
  double energy;
} kept;

static kept measure(const scene *s) {
  sbr_double3 o = sbr_character_get_origin(s->world, s->character);
  double off[3] = {o.x - s->character_definition.position.x, o.y, o.z - s->character_definition.position.z};
  const sbri_island *island = &s->model->islands[0];
  const sbri_point *x = sbri_positions(character_of(s));
  double p[3] = {0}, l[3] = {0};
  for (uint32_t i = 0; i < island->free_count; i++) {
    const float *v = scene_velocity(s, i);
    double m = island->masses[i], u[3] = {v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]};
    double r[3] = {off[0] + (double)x[i].x, off[1] + (double)x[i].y, off[2] + (double)x[i].z};
    for (int k = 0; k < 3; k++) {
      p[k] += m * u[k];
      l[k] += m * (r[(k + 1) % 3] * u[(k + 2) % 3] - r[(k + 2) % 3] * u[(k + 1) % 3]);
    }
  }
  sbr_body_health health = sbr_character_get_body_health(s->world, s->character, 0);
  return (kept){{(float)p[0], (float)p[1], (float)p[2]}, {(float)l[0], (float)l[1], (float)l[2]},
      health.kinetic_j + health.elastic_j};
}

START_TEST(momentum_angular_momentum_and_energy_are_conserved)
{
  scene s = make_block(60);
  s.model_options.substeps = 8;
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  for (uint32_t i = 0; i < island->free_count; i++) {
    if (!(island->masses[i] > 0)) continue;
    float *v = scene_velocity(&s, i);
    sbri_point r = island->rest[i];
    v[0] = 1 - 8 * r.y + 2 * r.z * (float)sin(9 * i), v[SBRI_BLOCK] = 8 * r.x - 3 * r.z;
    v[2 * SBRI_BLOCK] = 0.5f + 3 * r.y;
  }
  kept before = measure(&s);
  for (int i = 0; i < 10; i++) {
    scene_ticks(&s, 60);
    kept now = measure(&s);
    float size = fabsf(before.momentum.x) + fabsf(before.momentum.z);
    ck_assert_float_eq_tol(now.momentum.x, before.momentum.x, 5e-5f * size);
    ck_assert_float_eq_tol(now.momentum.z, before.momentum.z, 5e-5f * size);
    ck_assert_float_eq_tol(
        now.angular_velocity.z, before.angular_velocity.z, 3e-3f * fabsf(before.angular_velocity.z));
    ck_assert_double_eq_tol(now.energy, before.energy, 0.01 * before.energy);
  }
  scene_free(&s);
}
END_TEST

/* One region around all, breathing: every point swings about its place with w. */
START_TEST(one_region_oscillates_at_its_own_frequency)
{
  const float w = 40;
  scene s = scene_begin();
  scene_regions(&s, 0, (sbf_vec3){0, 0, 0}, 0.1f, (const uint32_t[3]){3, 3, 3}, 3, w, 0.1f);
  scene_body(&s, 0)->attributes.gravity_scale = 0;
  s.model_options.substeps = 50;
  s.world_definition.control_tick_s = 1.0 / 1000;
  scene_start(&s);
  ck_assert_double_eq_tol(s.model->islands[0].stability.fastest_rad_s, w, 1e-6);
  sbri_point *x = sbri_positions(character_of(&s));
  const sbri_point *rest = s.model->islands[0].rest;
  sbf_vec3 center = {0.1f, 0.1f, 0.1f};
  for (uint32_t i = 0; i < s.model->islands[0].slot_count; i++) {
    x[i].x += 0.1f * (rest[i].x - center.x);
    x[i].y += 0.1f * (rest[i].y - center.y);
    x[i].z += 0.1f * (rest[i].z - center.z);
  }
  uint32_t corner = scene_body(&s, 0)->levels.at[0].positions.count - 1;
  double before = 0, from = 0, first = 0, last = 0;
  uint32_t crossings = 0;
  for (int tick = 0; tick < 1000; tick++) {
    double off = (double)scene_point(&s, 0, corner).x - 0.2;
    if (tick > 0 && before < 0 && off >= 0) {
      from = (tick - 1 + before / (before - off)) / 1000;
      if (crossings++ == 0) first = from;
      last = from;
    }
    before = off;
    scene_ticks(&s, 1);
  }
  ck_assert_uint_ge(crossings, 5);
  ck_assert_double_eq_tol((last - first) / (crossings - 1), 2 * PI / (double)w, 1e-4);
  scene_free(&s);
}
END_TEST

/* Regions of three points an edge, s^2 = 2/3 step^2: E = rho w^2 s^2. A bar of them hangs rho g L^2 / 2 E
 * down. Its ends, where regions are cut off, and the points' size beside the length, are some per cent. */
START_TEST(a_hanging_bar_has_the_stiffness_of_its_modulus)
{
  const uint32_t counts[3] = {4, 41, 4};
  const float step = 0.05f, w = 300;
  scene s = scene_begin();
  sbf_level *level = scene_regions(&s, 0, (sbf_vec3){0, 0, 0}, step, counts, 1, w, 0.125f);
  uint32_t pinned[16];
  for (uint32_t i = 0; i < 16; i++) pinned[i] = i % 4 + 4 * (40 + 41 * (i / 4));
  scene_pin(&s, level, -1, pinned, 16);
  scene_body(&s, 0)->attributes.damping_ratio = 1;
  scene_start(&s);
  scene_ticks(&s, 900);
  double density = 0.125 / pow((double)step, 3),
         modulus = density * (double)(w * w) * 2 / 3 * pow((double)step, 2);
  double length = 40 * (double)step, expected = density * 9.81 * length * length / (2 * modulus);
  double sag = 0;
  for (uint32_t i = 0; i < 4; i++) sag -= (double)scene_point(&s, 0, i).y / 4;
  ck_assert_double_gt(expected, 5 * 0.0005); /* large enough for single precision */
  ck_assert_double_eq_tol(sag, expected, 0.08 * expected);
  scene_free(&s);
}
END_TEST

START_TEST(flat_and_mirrored_starts_recover)
{
  scene s = make_block(60);
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  scene_start(&s);
  sbri_point *x = sbri_positions(character_of(&s));
  for (uint32_t i = 0; i < s.model->islands[0].slot_count; i++)
    if (_i == 0)
      x[i].y = 0.1f + 1e-4f * x[i].x;
    else
      x[i].x = -x[i].x;
  scene_ticks(&s, 600);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(health.finite);
  ck_assert_float_lt(health.max_strain, 0.02f);
  ck_assert_double_lt(health.elastic_j, 1e-3);
  scene_free(&s);
}
END_TEST

/* Two periods of the lowest mode decay by its damping ratio; the frequency is the model's. */
START_TEST(the_lowest_mode_is_damped_by_the_ratio)
{
  scene s = make_block(60);
  scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  scene_start(&s);
  double lowest = (double)s.model->bodies[0].damping.alpha_1_s / 0.2;
  ck_assert_double_gt(lowest, 3);
  ck_assert_double_lt(lowest, 60);
  /* Kinetic and elastic energy fall with exp(-2 z w t) once the lowest mode is left. */
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++) {
    sbri_point r = s.model->islands[0].rest[i];
    *(scene_velocity(&s, i) + SBRI_BLOCK) = 4 * (r.x - 0.2f) * (r.x - 0.2f);
  }
  uint32_t wait = (uint32_t)(60 * 12 / lowest), span = (uint32_t)(60 * 4 * PI / lowest);
  scene_ticks(&s, wait);
  kept early = measure(&s);
  double drift = 0; /* of the body as a whole, which is not damped */
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++)
    drift += (double)s.model->islands[0].masses[i];
  double whole = 0.5 * (double)early.momentum.y * (double)early.momentum.y / drift;
  scene_ticks(&s, span);
  kept late = measure(&s);
  double ratio = (late.energy - whole) / (early.energy - whole);
  double expected = exp(-2 * 0.1 * lowest * span / 60);
  ck_assert_double_gt(ratio, 0.4 * expected);
  ck_assert_double_lt(ratio, 2.5 * expected);
  scene_free(&s);
}
END_TEST

/* Regions' own damping takes energy, but does not slow rotation or flight of the body as a whole. */
START_TEST(damping_of_regions_does_not_slow_rigid_motion)
{
  scene s = make_block(60);
  scene_body(&s, 0)->attributes.stiffness_damping = 0.01f;
  s.model_options.substeps = 16;
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  for (uint32_t i = 0; i < island->free_count; i++) {
    if (!(island->masses[i] > 0)) continue;
    float *v = scene_velocity(&s, i);
    sbri_point r = island->rest[i];
    v[0] = 1 - 2 * r.y + 4 * (float)sin(5 * i), v[SBRI_BLOCK] = 2 * r.x;
  }
  kept before = measure(&s);
  scene_ticks(&s, 600);
  kept now = measure(&s);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert_double_lt(now.energy, 0.9 * before.energy);
  ck_assert_double_lt(health.elastic_j, 0.01 * before.energy); /* what turning stretches */
  ck_assert_float_eq_tol(now.momentum.x, before.momentum.x, 1e-4f * before.momentum.x);
  ck_assert_float_eq_tol(
      now.angular_velocity.z, before.angular_velocity.z, 5e-3f * fabsf(before.angular_velocity.z));
  scene_free(&s);
}
END_TEST

/* Pinned to a bone, walking, on ground, with every scheme that supports it: the same bits for every lane
 * count and after a snapshot. */
static scene make_walker(sbf_scheme scheme, sbr_instructions instructions) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0.3f, 0});
  sbf_level *level =
      scene_regions(&s, 0, (sbf_vec3){0, 0.02f, 0}, 0.1f, (const uint32_t[3]){5, 4, 3}, 1, 60, 0.1f);
  static const uint32_t pinned[3] = {17, 18, 38};
  scene_pin(&s, level, 0, pinned, 3);
  scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  scene_body(&s, 0)->attributes.stiffness_damping = 1e-3f;
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  s.model_options.scheme = scheme;
  s.model_options.instructions = instructions;
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 0.3f, 0, 0.8f);
  return s;
}

START_TEST(every_lane_width_and_a_snapshot_give_the_same_bits)
{
  static const sbf_scheme schemes[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_HEUN};
  uint64_t hash = 0;
  for (int i = SBR_INSTRUCTIONS_SCALAR; i <= SBR_INSTRUCTIONS_WASM_SIMD128; i++) {
    if (!sbr_instructions_are_available((sbr_instructions)i)) continue;
    scene s = make_walker(schemes[_i], (sbr_instructions)i);
    scene_ticks(&s, 60);
    size_t size = sbr_world_get_snapshot_size(s.world);
    void *bytes = malloc(size);
    ck_assert_int_eq(sbr_world_save_snapshot(s.world, bytes, size), SBF_OK);
    scene_ticks(&s, 60);
    uint64_t end = sbr_world_get_state_hash(s.world);
    ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_OK);
    scene_ticks(&s, 60);
    ck_assert_uint_eq(sbr_world_get_state_hash(s.world), end);
    if (!hash) hash = end;
    ck_assert_msg(end == hash, "%s", sbr_instructions_get_name((sbr_instructions)i));
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(health.finite);
    ck_assert_uint_eq(health.recoveries, 0);
    ck_assert_float_gt(health.max_strain, 1e-4f);
    ck_assert_float_lt(health.max_strain, 1.0f);
    free(bytes);
    scene_free(&s);
  }
}
END_TEST

START_TEST(position_based_steps_refuse_regions)
{
  scene s = make_block(60);
  sbf_diagnostic error;
  s.model_options.scheme = SBF_SCHEME_POSITION_BASED;
  ck_assert_int_eq(sbr_model_create(s.asset, &s.model_options, &s.model, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "matches shapes"));
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *s = suite_create("region forces");
  TCase *c = tcase_create("region forces");
  tcase_add_test(c, momentum_angular_momentum_and_energy_are_conserved);
  tcase_add_test(c, one_region_oscillates_at_its_own_frequency);
  tcase_add_test(c, a_hanging_bar_has_the_stiffness_of_its_modulus);
  tcase_add_loop_test(c, flat_and_mirrored_starts_recover, 0, 2);
  tcase_add_test(c, the_lowest_mode_is_damped_by_the_ratio);
  tcase_add_test(c, damping_of_regions_does_not_slow_rigid_motion);
  tcase_add_loop_test(c, every_lane_width_and_a_snapshot_give_the_same_bits, 0, 2);
  tcase_add_test(c, position_based_steps_refuse_regions);
  suite_add_tcase(s, c);
  return harness_run(s);
}
