#include <math.h>

#include "harness.h"
#include "scenes.h"
#include "state/world.h"

static scene section(bool sag_free) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  scene_body(&s, 0)->attributes.sag_free = sag_free;
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  scene_body(&s, 0)->attributes.young_modulus = 2e4f;
  scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.4f, 0.8f}, 3);
  return s;
}

/* Greatest distance of a surface point from its rest place after two seconds. */
static double moved(scene *s) {
  scene_ticks(s, 120);
  static sbf_vec3 now[256];
  const sbf_vec3_list *rest = &s->asset->soft_bodies.at[0].surface.positions;
  scene_read(s, 0, now, 256);
  double worst = 0;
  for (uint32_t i = 0; i < rest->count; i++) {
    double x = now[i].x - rest->at[i].x, y = now[i].y - rest->at[i].y, z = now[i].z - rest->at[i].z;
    worst = fmax(worst, sqrt(x * x + y * y + z * z));
  }
  return worst;
}

START_TEST(preload_supports_the_weight)
{
  scene sagging = section(false), bearing = section(true);
  scene_start(&sagging);
  scene_start(&bearing);
  double sag = moved(&sagging);
  ck_assert_double_gt(sag, 5e-3);
  ck_assert_double_lt(moved(&bearing), 2e-3 * sag + 1e-5);
  scene_free(&sagging);
  scene_free(&bearing);
}
END_TEST

START_TEST(preload_balances_the_stated_gravity)
{
  scene s = section(true);
  s.model_options.has_gravity = s.world_definition.has_gravity = true;
  s.model_options.gravity = s.world_definition.gravity = (sbf_vec3){3, 0, -20};
  scene_start(&s);
  ck_assert_double_lt(moved(&s), 5e-4);
  scene_free(&s);
  s = section(true);
  s.world_definition.has_gravity = true; /* the preload assumes the asset's gravity */
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  ck_assert_double_gt(moved(&s), 3e-3);
  scene_free(&s);
}
END_TEST

START_TEST(goals_support_the_weight)
{
  scene s = scene_begin();
  scene_body(&s, 0)->attributes.sag_free = true;
  scene_body(&s, 0)->attributes.damping_ratio = 0.5f;
  const sbf_vec3 position = {0, 1, 0};
  const float mass = 2, weight = 0.5f;
  const uint32_t point = 0;
  sbf_level *level = scene_points(&s, 0, &position, &mass, 1);
  scene_pin(&s, level, -1, &point, 1);
  sbf_pin_set *set = (sbf_pin_set *)(uintptr_t)level->pins.at;
  set->weights = (sbf_f32_list){&weight, 1};
  set->stiffness = 100;
  scene_start(&s);
  scene_ticks(&s, 120);
  ck_assert_float_eq_tol(scene_point(&s, 0, 0).y, 1, 1e-5f);
  scene_free(&s);
}
END_TEST

START_TEST(stated_rest_lengths_are_unchanged)
{
  scene s = section(true);
  const sbf_spring_set_list *sets = &s.asset->soft_bodies.at[0].levels.at[0].springs;
  sbf_spring_set *set = (sbf_spring_set *)(uintptr_t)&sets->at[0];
  float *rest = sbf_asset_allocate(s.asset, set->ends.count, sizeof *rest);
  for (uint32_t i = 0; i < set->ends.count; i++) rest[i] = 0.123f;
  set->rest_lengths = (sbf_f32_list){rest, set->ends.count};
  scene_start(&s);
  uint32_t stated = 0;
  for (uint32_t i = 0; i < s.model->islands[0].springs.count; i++)
    stated += s.model->islands[0].springs.at[i].rest_length_m == 0.123f;
  ck_assert_uint_eq(stated, set->ends.count);
  scene_free(&s);
}
END_TEST

START_TEST(bodies_that_cannot_support_it_are_unchanged)
{
  scene s = section(true);
  s.model_options.free = true; /* no pins */
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  for (uint32_t i = 0; i < island->springs.count; i++) {
    const sbri_point *a = &island->rest[island->springs.at[i].a], *b = &island->rest[island->springs.at[i].b];
    float length =
        sqrtf((a->x - b->x) * (a->x - b->x) + (a->y - b->y) * (a->y - b->y) + (a->z - b->z) * (a->z - b->z));
    ck_assert_float_eq_tol(island->springs.at[i].rest_length_m, length, 1e-6f);
  }
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("preload");
  TCase *c = tcase_create("preload");
  tcase_add_test(c, preload_supports_the_weight);
  tcase_add_test(c, preload_balances_the_stated_gravity);
  tcase_add_test(c, goals_support_the_weight);
  tcase_add_test(c, stated_rest_lengths_are_unchanged);
  tcase_add_test(c, bodies_that_cannot_support_it_are_unchanged);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
