/* Strain limits, yield and tear, in every scheme that follows the energy. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "event_log.h"
#include "harness.h"
#include "scenes.h"
#include "state/world.h"

static const sbf_scheme schemes[] = {
    SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_HEUN};
enum { SCHEME_COUNT = 4, EXPLICIT_EULER = 2 };

/* A mass of 1 kg on a spring of 1 m and 40 N/m: its static stretch is 0.245 m, and it falls by twice that. */
static scene hanging(int scheme, float stretch_damping) {
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {0, -1, 0}};
  const float masses[] = {0, 1}, stiffness = 40;
  const uint32_t pinned = 0;
  sbf_level *level = scene_points(&s, 0, positions, masses, 2);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &stiffness, 1);
  scene_pin(&s, level, -1, &pinned, 1);
  scene_body(&s, 0)->attributes.stiffness_damping = stretch_damping;
  s.model_options.scheme = schemes[scheme];
  s.model_options.substeps = 16;
  return s;
}

static sbf_spring_set *set_of(scene *s) {
  return (sbf_spring_set *)(uintptr_t)s->asset->soft_bodies.at[0].levels.at[0].springs.at;
}

static float lowest_of(scene *s, int ticks) {
  float lowest = 0;
  for (int i = 0; i < ticks; i++) {
    scene_ticks(s, 1);
    lowest = fminf(lowest, scene_point(s, 0, 1).y);
  }
  return lowest;
}

START_TEST(a_limit_is_a_wall)
{
  scene s = hanging(_i, 0);
  scene_body(&s, 0)->attributes.strain_max = 0.5f; /* the set's own counts */
  set_of(&s)->strain_max = 0.1f;
  scene_start(&s);
  ck_assert_float_eq_tol(lowest_of(&s, 300), -1.1f, 1e-5f);
  scene_free(&s);
  s = hanging(_i, 0);
  set_of(&s)->strain_min = -0.05f;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 9.81f, 0};
  scene_start(&s);
  scene_ticks(&s, 300);
  ck_assert_float_eq_tol(scene_point(&s, 0, 1).y, -0.95f, 1e-5f);
  scene_free(&s);
}
END_TEST

/* Springs within their limits move as without limits; springs at rest at a limit do not move. */
START_TEST(a_limit_changes_nothing_within_its_bound)
{
  uint64_t hashes[2];
  for (int k = 0; k < 2; k++) {
    scene s = hanging(_i, 0.02f);
    if (k) set_of(&s)->strain_max = 0.6f;
    scene_start(&s);
    scene_ticks(&s, 200);
    hashes[k] = sbr_world_get_state_hash(s.world);
    scene_free(&s);
  }
  ck_assert_uint_eq(hashes[0], hashes[1]);
}
END_TEST

START_TEST(a_limit_conserves_momentum)
{
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const float masses[] = {1, 3, 2}, stiffness[] = {10, 10, 10};
  const sbf_uint2 ends[] = {{{0, 1}}, {{1, 2}}, {{0, 2}}};
  const float rest[] = {1.4f, 1, 0.7f};
  sbf_level *level = scene_points(&s, 0, positions, masses, 3);
  scene_springs(&s, level, ends, stiffness, 3);
  set_of(&s)->rest_lengths = (sbf_f32_list){rest, 3};
  set_of(&s)->strain_max = 0.02f, set_of(&s)->strain_min = -0.02f;
  s.model_options.scheme = schemes[_i];
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  scene_ticks(&s, 120);
  sbf_vec3 p[3];
  ck_assert_uint_eq(scene_read(&s, 0, p, 3), 3);
  ck_assert_float_eq_tol((p[0].x + 3 * p[1].x + 2 * p[2].x) / 6, 0.5f, 3e-5f);
  ck_assert_float_eq_tol((p[0].y + 3 * p[1].y + 2 * p[2].y) / 6, 1.0f / 3, 3e-5f);
  ck_assert_float_le(sbr_character_get_body_health(s.world, s.character, 0).max_strain, 0.0201f);
  scene_free(&s);
}
END_TEST

/* Held out at the strain e, the rest length flows to l / (1 + y) at its rate. */
START_TEST(a_yielding_spring_flows)
{
  scene s = hanging(_i, 0);
  const sbf_vec3 positions[] = {{0, 0, 0}, {0, -1.3f, 0}, {0, -1.3f, 0}};
  const float masses[] = {0, 0, 1}, rest = 1, stiffness = 40;
  const uint32_t pinned[2] = {0, 1};
  sbf_level *level = scene_points(&s, 0, positions, masses, 3);
  scene_springs(&s, level, &(sbf_uint2){{0, 2}}, &stiffness, 1);
  level->springs.count = 1;
  set_of(&s)->rest_lengths = (sbf_f32_list){&rest, 1};
  set_of(&s)->yield_strain = 0.1f;
  scene_body(&s, 0)->attributes.yield_flow = 0.5f;
  scene_pin(&s, level, -1, pinned, 2);
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, -12, 0};
  scene_body(&s, 0)->attributes.mass_damping = 2;
  scene_start(&s);
  scene_ticks(&s, 600);
  /* The force of 12 N strains by 0.3 m, so that l = l0 + 0.3: it flows until 0.3 = 0.1 l0. */
  float l0 = sbri_rests(&s.world->characters[0])[s.model->islands[0].links.of_spring[0]];
  float length = -scene_point(&s, 0, 2).y;
  ck_assert_float_eq_tol(length - l0, 0.3f, 0.01f);
  /* l0' = r ((l0 + 0.3) / 1.1 - l0) = r (0.3 - 0.1 l0) / 1.1: towards 3 m at the rate r / 11 */
  ck_assert_float_eq_tol(l0, (float)(3 - 2 * exp(-0.5 * 10 / 11)), 0.02f);
  sbr_character_reset(s.world, s.character);
  ck_assert_float_eq(sbri_rests(&s.world->characters[0])[s.model->islands[0].links.of_spring[0]], 1);
  scene_free(&s);
}
END_TEST

START_TEST(without_a_rate_nothing_flows)
{
  scene s = hanging(0, 0);
  set_of(&s)->yield_strain = 0.01f;
  scene_start(&s);
  ck_assert_ptr_null(s.model->islands[0].links.flows);
  scene_ticks(&s, 10);
  scene_free(&s);
}
END_TEST

START_TEST(a_torn_spring_stops_and_is_reported)
{
  scene s = hanging(_i, 0);
  set_of(&s)->tear_strain = 0.3f;
  s.character_definition.position.x = 3;
  scene_start(&s);
  size_t size = sbr_world_get_snapshot_size(s.world);
  void *before = malloc(size);
  ck_assert_int_eq(sbr_world_save_snapshot(s.world, before, size), SBF_OK);
  sbr_tear_events events = {0};
  uint32_t torn_at = 0;
  for (uint32_t i = 1; i <= 60 && events.torn_count == 0; i++) {
    scene_ticks(&s, 1);
    events = sbr_world_get_tear_events(s.world);
    torn_at = i;
  }
  ck_assert_uint_eq(events.torn_count, 1);
  ck_assert_uint_eq(events.torn[0].soft_body, 0);
  ck_assert_uint_eq(events.torn[0].tick, torn_at);
  ck_assert_double_eq_tol(events.torn[0].position.x, 3, 1e-5);
  ck_assert_double_eq_tol(
      events.torn[0].position.y, 0 - 0.65, 0.02); /* its middle; the asset's origin is at 0 */
  /* 0.245 (1 - cos w t) = 0.3: w t = 1.797, and w = 6.32 */
  ck_assert_double_eq_tol(torn_at / 60.0, 1.797 / 6.3246, 0.03);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).torn, 1);
  scene_ticks(&s, 60);
  ck_assert_float_lt(scene_point(&s, 0, 1).y, -5); /* it falls */
  ck_assert_double_eq_tol(sbr_character_get_body_health(s.world, s.character, 0).elastic_j, 0, 1e-9);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, before, size), SBF_OK);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).torn, 0);
  scene_ticks(&s, torn_at + 60);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hash);
  sbr_character_reset(s.world, s.character);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).torn, 0);
  ck_assert_float_gt(lowest_of(&s, 10), -1.3f); /* it holds again, for a while */
  free(before);
  scene_free(&s);
}
END_TEST

/* Many in one tick: all are counted, sixteen are reported. */
START_TEST(events_of_tears_are_bounded)
{
  enum { POINTS = 40 };
  scene s = scene_begin();
  sbf_vec3 positions[2 * POINTS];
  float masses[2 * POINTS], stiffness[POINTS];
  sbf_uint2 ends[POINTS];
  uint32_t pinned[POINTS];
  for (uint32_t i = 0; i < POINTS; i++) {
    positions[i] = (sbf_vec3){(float)i, 0, 0}, positions[POINTS + i] = (sbf_vec3){(float)i, -1, 0};
    masses[i] = masses[POINTS + i] = 1, stiffness[i] = 10, pinned[i] = i;
    ends[i] = (sbf_uint2){{i, POINTS + i}};
  }
  sbf_level *level = scene_points(&s, 0, positions, masses, 2 * POINTS);
  scene_springs(&s, level, ends, stiffness, POINTS);
  scene_pin(&s, level, -1, pinned, POINTS);
  scene_body(&s, 0)->attributes.tear_strain = 0.2f;
  scene_start(&s);
  event_log log = {.torn_count = 0};
  scene_ticks_logged(&s, 60, &log);
  ck_assert_uint_eq(log.torn_count, SBRI_TEARS);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).torn, POINTS);
  scene_free(&s);
}
END_TEST

/* An element takes the mean of its points' factors. */
START_TEST(weight_maps_move_the_bounds)
{
  scene s = hanging(0, 0);
  static const float factors[2] = {3, 1};
  sbf_weight_map *map = sbf_asset_allocate(s.asset, 1, sizeof *map);
  sbf_weight_map_init(map);
  map->property = SBF_WEIGHT_PROPERTY_TEAR_STRAIN;
  map->values = (sbf_f32_list){factors, 2};
  scene_body(&s, 0)->weight_maps = (sbf_weight_map_list){map, 1};
  set_of(&s)->tear_strain = 0.15f; /* 0.3 with the map */
  scene_start(&s);
  uint32_t link = s.model->islands[0].links.of_spring[0];
  ck_assert_float_eq_tol(s.model->islands[0].links.flows[link / 8].tear[link % 8], 0.3f, 1e-6f);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("spring bounds");
  TCase *c = tcase_create("spring bounds");
  tcase_add_loop_test(c, a_limit_is_a_wall, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, a_limit_changes_nothing_within_its_bound, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, a_limit_conserves_momentum, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, a_yielding_spring_flows, 0, SCHEME_COUNT);
  tcase_add_test(c, without_a_rate_nothing_flows);
  tcase_add_loop_test(c, a_torn_spring_stops_and_is_reported, 0, SCHEME_COUNT);
  tcase_add_test(c, events_of_tears_are_bounded);
  tcase_add_test(c, weight_maps_move_the_bounds);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
