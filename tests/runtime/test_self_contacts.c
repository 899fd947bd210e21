/* A soft body against itself. */
#include <math.h>
#include <stdlib.h>

#include "collision_scenes.h"
#include "harness.h"
#include "math/vec3.h"

enum { LONG = 41, WIDE = 5, POINTS = LONG * WIDE };

/* A strip of 1 m by 0.1, folded to a U that lies on its side: two legs, 6 cm apart, the upper one shorter. */
static scene folded_strip_in_air(bool collides, float friction, float air_1_s) {
  scene s = scene_begin();
  sbf_vec3 at[POINTS];
  float masses[POINTS], stiffness[6 * POINTS];
  sbf_uint2 ends[6 * POINTS];
  uint32_t springs = 0, pinned[POINTS], pinned_count = 0;
  const float radius = 0.03f, step = 0.025f, pi = 3.14159265f;
  for (uint32_t i = 0; i < POINTS; i++) {
    float along = step * ((float)(i / WIDE) - 24), x = fabsf(along), arc = pi * radius / 2;
    float angle = x < arc ? along / radius : along < 0 ? -pi / 2 : pi / 2;
    at[i] = (sbf_vec3){
        radius * cosf(angle) - (x < arc ? 0 : x - arc), radius * sinf(angle), 0.025f * (float)(i % WIDE)};
    masses[i] = 0.0005f;
    if (i / WIDE <= 23) pinned[pinned_count++] = i; /* the lower leg */
    const uint32_t steps[6] = {1, WIDE, WIDE + 1, WIDE - 1, 2 * WIDE, 4 * WIDE};
    for (int k = 0; k < 6; k++) {
      uint32_t to = i + steps[k];
      if (to >= POINTS || (steps[k] % WIDE == 1 && i % WIDE == WIDE - 1) ||
          (steps[k] == WIDE - 1 && i % WIDE == 0))
        continue;
      ends[springs] = (sbf_uint2){{i, to}};
      stiffness[springs++] = k < 4 ? 100 : 0.2f;
    }
  }
  sbf_level *level = scene_points(&s, 0, at, masses, POINTS);
  scene_springs(&s, level, ends, stiffness, springs);
  scene_pin(&s, level, -1, pinned, pinned_count);
  collision_surface(&s, 0, at, WIDE, LONG);
  scene_body(&s, 0)->attributes.damping_ratio = 0.2f;
  scene_body(&s, 0)->attributes.mass_damping = air_1_s;
  scene_body(&s, 0)->attributes.friction = friction;
  scene_body(&s, 0)->collision.self = collides;
  scene_body(&s, 0)->collision.outer_thickness = 0.005f;
  scene_start(&s);
  return s;
}

static scene folded_strip(bool collides, float friction) {
  return folded_strip_in_air(collides, friction, 0);
}

/* Minimum height of the upper leg's points over the lower leg's at the same distance from the bend. */
static double min_gap(const scene *s) {
  sbf_vec3 at[POINTS];
  double min = 1e9;
  scene_read(s, 0, at, POINTS);
  for (int u = 28; u < LONG; u++)
    for (int w = 0; w < WIDE; w++)
      for (int k = 0; k + 1 < 21; k++) {
        sbf_vec3 p = at[u * WIDE + w], a = at[k * WIDE + w], b = at[(k + 1) * WIDE + w];
        float t = (p.x - a.x) / (b.x - a.x);
        if (!(t >= 0 && t <= 1)) continue;
        min = fmin(min, (double)(p.y - (a.y + t * (b.y - a.y))));
      }
  return min;
}

/* The upper leg, free at its end, falls onto the lower one and rests there. Without `self` it falls
 * through. */
START_TEST(a_folding_strip_rests_on_itself)
{
  double min[2] = {1e9, 1e9}, end[2];
  for (int contacts = 0; contacts < 2; contacts++) {
    scene s = folded_strip(contacts, 1);
    for (int i = 0; i < 40; i++) {
      scene_ticks(&s, 1);
      min[contacts] = fmin(min[contacts], min_gap(&s));
    }
    end[contacts] = min_gap(&s);
    ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
    ck_assert_uint_eq(sbr_model_report_unsupported(s.model, NULL, NULL), 0);
    scene_free(&s);
  }
  ck_assert_double_lt(min[0], -0.01);
  ck_assert_double_ge(min[1], 0.002);
  ck_assert_double_ge(end[1], 0.003);
}
END_TEST

/* It also rests there: no point of the leg jumps or creeps. (The rows of the fold continue to swing like
 * pendulums, because nothing damps them here.) */
START_TEST(a_bent_strip_rests)
{
  const float frictions[3] = {1, 0.3f, 0.1f};
  enum { FIRST = 30 * WIDE };
  scene s = folded_strip(true, frictions[_i]);
  static sbf_vec3 begin[POINTS], before[POINTS], now[POINTS];
  scene_ticks(&s, 240);
  scene_read(&s, 0, begin, POINTS);
  for (int i = 0; i < 120; i++) {
    scene_read(&s, 0, before, POINTS);
    scene_ticks(&s, 1);
    scene_read(&s, 0, now, POINTS);
    for (int k = FIRST; k < POINTS; k++)
      ck_assert_float_le(60 * sbri_length(sbri_sub(now[k], before[k])), 1e-3f);
  }
  for (int k = FIRST; k < POINTS; k++) ck_assert_float_le(sbri_length(sbri_sub(now[k], begin[k])), 1e-4f);
  ck_assert_double_ge(min_gap(&s), 0.0049);
  scene_free(&s);
}
END_TEST

/* With damping of 1/s by the air, the rows of the fold come to rest as well: contacts add no energy. (At
 * friction 1 one row swung at 0.3 m/s permanently.) */
START_TEST(a_sharp_fold_comes_to_rest)
{
  const float frictions[3] = {1, 0.3f, 0.1f};
  scene s = folded_strip_in_air(true, frictions[_i], 1);
  static sbf_vec3 before[POINTS], now[POINTS];
  scene_ticks(&s, 720);
  for (int i = 0; i < 60; i++) {
    scene_read(&s, 0, before, POINTS);
    scene_ticks(&s, 1);
    scene_read(&s, 0, now, POINTS);
    for (int k = 0; k < POINTS; k++) ck_assert_float_le(60 * sbri_length(sbri_sub(now[k], before[k])), 1e-3f);
  }
  scene_free(&s);
}
END_TEST

static sbf_vec3 momentum(const scene *s, sbf_vec3 *before, uint32_t count) {
  sbf_vec3 now[POINTS], sum = {0, 0, 0};
  scene_read(s, 0, now, count);
  for (uint32_t i = 0; i < count; i++) {
    sum.x += (now[i].x - before[i].x) * 60, sum.y += (now[i].y - before[i].y) * 60;
    sum.z += (now[i].z - before[i].z) * 60;
    before[i] = now[i];
  }
  return sum;
}

/* In the air, without weight: self-contacts do not move the body as a whole. */
START_TEST(momentum_is_conserved)
{
  scene s = folded_strip(true, 1);
  scene_free(&s);
  s = scene_begin();
  /* A point between two springs that throw it at a triangle. */
  const sbf_vec3 at[4] = {{0, 0, 0}, {0.2f, 0, 0}, {0, 0, 0.2f}, {0.05f, 0.05f, 0.05f}};
  const float masses[4] = {1, 1, 1, 1}, stiffness[6] = {100, 100, 100, 100, 100, 100};
  const sbf_uint2 ends[6] = {{{0, 1}}, {{0, 2}}, {{1, 2}}, {{0, 3}}, {{1, 3}}, {{2, 3}}};
  sbf_level *level = scene_points(&s, 0, at, masses, 4);
  scene_springs(&s, level, ends, stiffness, 6);
  float *rests = sbf_asset_allocate(s.asset, 6, sizeof *rests);
  ck_assert_ptr_nonnull(rests);
  const float lengths[6] = {0.2f, 0.2f, 0.2828f, 0.01f, 0.05f, 0.05f};
  for (int i = 0; i < 6; i++) rests[i] = lengths[i];
  ((sbf_spring_set *)(uintptr_t)level->springs.at)->rest_lengths = (sbf_f32_list){rests, 6};
  static const uint32_t one_size[1] = {3}, one_face[3] = {0, 2, 1};
  sbf_polygon_mesh *mesh = &scene_body(&s, 0)->surface;
  mesh->positions = (sbf_vec3_list){at, 4};
  mesh->polygon_sizes = (sbf_u32_list){one_size, 1};
  mesh->polygon_points = (sbf_u32_list){one_face, 3};
  scene_body(&s, 0)->collision.self = true;
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  sbf_vec3 before[4];
  scene_read(&s, 0, before, 4);
  for (int i = 0; i < 120; i++) {
    scene_ticks(&s, 1);
    sbf_vec3 p = momentum(&s, before, 4);
    ck_assert_float_le(fabsf(p.x) + fabsf(p.y) + fabsf(p.z), 1e-3f);
    sbf_vec3 face = scene_point(&s, 0, 0), up = scene_point(&s, 0, 3);
    ck_assert_float_ge(up.y - face.y, -0.02f);
  }
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("self_touch");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_folding_strip_rests_on_itself);
  tcase_add_loop_test(tests, a_bent_strip_rests, 0, 3);
  tcase_add_loop_test(tests, a_sharp_fold_comes_to_rest, 0, 3);
  tcase_add_test(tests, momentum_is_conserved);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
