/* Sections dropped from a metre, as in the thesis: they strike the ground at 4.4 m/s, keep their volume,
 * never go below it, and come to rest. */
#include <math.h>

#include "harness.h"
#include "scenes.h"

typedef struct drop_result {
  double min_volume, lowest_m, speed_m_s; /* the first two at any tick, the last at the end */
} drop_result;

static sbf_vec3 before[512], after[512];

/* A box of soft tissue with `cells` quads along each edge, free, for five seconds. */
static drop_result drop(sbf_scheme scheme, sbf_vec3 size, uint32_t cells) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  sbf_attributes_init(&scene_body(&s, 0)->attributes);
  scene_body(&s, 0)->attributes.pressure_mode = SBF_PRESSURE_MODE_VOLUME;
  scene_section(&s, 0, (sbf_vec3){0, 1 + 0.5f * size.y, 0}, size, cells);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position = (sbr_double3){0, 0, 0};
  s.character_definition.hold_pose = true;
  s.model_options = sbr_default_model_options();
  s.model_options.scheme = scheme;
  s.model_options.free = true;
  scene_start(&s);
  drop_result r = {1, 1, 0};
  uint32_t count = 0;
  for (int tick = 0; tick < 300; tick++) {
    scene_read(&s, 0, before, 512);
    scene_ticks(&s, 1);
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(health.finite);
    ck_assert_uint_eq(health.recoveries, 0);
    r.min_volume = fmin(r.min_volume, (double)health.volume_ratio);
    count = scene_read(&s, 0, after, 512);
    double origin = sbr_character_get_origin(s.world, s.character).y;
    for (uint32_t i = 0; i < count; i++) r.lowest_m = fmin(r.lowest_m, origin + (double)after[i].y);
  }
  for (uint32_t i = 0; i < count; i++) {
    double x = after[i].x - before[i].x, y = after[i].y - before[i].y, z = after[i].z - before[i].z;
    r.speed_m_s = fmax(r.speed_m_s, 60 * sqrt(x * x + y * y + z * z));
  }
  scene_free(&s);
  return r;
}

static const sbf_scheme schemes[] = {
    SBF_SCHEME_AUTOMATIC, SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN};

START_TEST(a_dropped_section_keeps_its_volume_above_the_ground)
{
  drop_result r = drop(schemes[_i], (sbf_vec3){0.2f, 0.3f, 0.4f}, 2);
  ck_assert_double_gt(r.min_volume, 0.95);
  ck_assert_double_gt(r.lowest_m, -1e-4);
  ck_assert_double_lt(r.speed_m_s, 0.02);
}
END_TEST

/* The slenderest of the thesis's lizard are about so. */
START_TEST(a_slender_section_does_so_too)
{
  drop_result r = drop(schemes[_i], (sbf_vec3){0.1f, 0.1f, 0.5f}, 2);
  ck_assert_double_gt(r.min_volume, 0.95);
  ck_assert_double_gt(r.lowest_m, -1e-4);
  ck_assert_double_lt(r.speed_m_s, 0.02);
}
END_TEST

START_TEST(a_finer_surface_changes_nothing_of_it)
{
  drop_result r = drop(schemes[_i], (sbf_vec3){0.2f, 0.3f, 0.4f}, 4);
  ck_assert_double_gt(r.min_volume, 0.95);
  ck_assert_double_gt(r.lowest_m, -1e-4);
  ck_assert_double_lt(r.speed_m_s, 0.02);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("drop");
  TCase *c = tcase_create("drop");
  int count = (int)(sizeof schemes / sizeof *schemes);
  tcase_add_loop_test(c, a_dropped_section_keeps_its_volume_above_the_ground, 0, count);
  tcase_add_loop_test(c, a_slender_section_does_so_too, 0, count);
  tcase_add_loop_test(c, a_finer_surface_changes_nothing_of_it, 0, count);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
