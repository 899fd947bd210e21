#include <math.h>

#include "harness.h"
#include "rigid_scenes.h"

static const double PI = 3.14159265358979323846;

static sbr_double3 center(const scene *s, uint32_t body) {
  sbr_double3 o = sbr_character_get_origin(s->world, s->character);
  sbf_vec3 c = rigid_state(s, body).center;
  return (sbr_double3){o.x + (double)c.x, o.y + (double)c.y, o.z + (double)c.z};
}

static scene begin(sbr_ground ground) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  s.world_definition.ground = ground;
  s.character_definition.position.y = 0;
  return s;
}

/* A box that lies on a slope, 3 m up it. */
static scene on_slope(double degrees, float friction) {
  scene s = begin(sbr_ground_slope(degrees));
  float a = (float)(degrees * PI / 180);
  sbf_vec3 at = {0, 3 * tanf(a) + 0.0501f / cosf(a), 3};
  uint32_t box = rigid_box(&s, at, (sbf_vec3){0.2f, 0.1f, 0.2f}, 1);
  rigid_body(&s, box)->friction = friction;
  sbf_vec3 *points = (sbf_vec3 *)(uintptr_t)rigid_body(&s, box)->hull->positions.at;
  for (int i = 0; i < 8; i++) {
    float y = points[i].y - at.y, z = points[i].z - at.z;
    points[i].y = at.y + y * cosf(a) + z * sinf(a);
    points[i].z = at.z + z * cosf(a) - y * sinf(a);
  }
  return s;
}

static double speed(const scene *s, uint32_t body) {
  sbf_vec3 v = rigid_state(s, body).velocity;
  return sqrt((double)(v.x * v.x + v.y * v.y + v.z * v.z));
}

/* atan 0.5 = 26.565 degrees, a quarter of a degree either way. */
START_TEST(bodies_stick_up_to_the_friction_angle)
{
  scene s = on_slope(26.315, 0.5f);
  scene_start(&s);
  scene_ticks(&s, 120);
  ck_assert_double_le(speed(&s, 0), 1e-3);
  scene_free(&s);
  s = on_slope(26.815, 0.5f);
  scene_start(&s);
  scene_ticks(&s, 180);
  double a = 26.815 * PI / 180;
  ck_assert_double_ge(speed(&s, 0), 0.6 * 3 * 9.81 * (sin(a) - 0.5 * cos(a)));
  scene_free(&s);
}
END_TEST

START_TEST(sliding_is_coulombs)
{
  scene s = on_slope(35, 0.3f);
  scene_start(&s);
  scene_ticks(&s, 60);
  double a = 35 * PI / 180, expected = 9.81 * (sin(a) - 0.3 * cos(a));
  ck_assert_double_eq_tol(speed(&s, 0) / expected, 1, 0.01);
  scene_free(&s);
}
END_TEST

/* h e^2. */
START_TEST(bounces_rise_by_the_restitution)
{
  const float e[3] = {0, 0.5f, 0.8f};
  for (int i = 0; i < 3; i++) {
    scene s = begin(sbr_ground_flat(0));
    rigid_box(&s, (sbf_vec3){0, 1.05f, 0}, (sbf_vec3){0.2f, 0.1f, 0.2f}, 1);
    rigid_body(&s, 0)->restitution = e[i];
    scene_start(&s);
    double top = 0;
    scene_ticks(&s, 28); /* down after 0.4515 s */
    for (int k = 0; k < 40; k++) {
      sbr_world_tick(s.world);
      top = fmax(top, center(&s, 0).y - 0.05);
    }
    ck_assert_double_eq_tol(top, (double)(e[i] * e[i]), 0.01);
    scene_free(&s);
  }
}
END_TEST

/* Lies where it fell, on flat ground, on a slope and on stairs. */
START_TEST(boxes_come_to_rest)
{
  for (int ground = 0; ground < 3; ground++) {
    scene s = begin(ground == 0   ? sbr_ground_flat(0)
                    : ground == 1 ? sbr_ground_slope(15)
                                  : sbr_ground_stairs(0.1, 0.3));
    rigid_box(&s, (sbf_vec3){0, 2, 1}, (sbf_vec3){0.3f, 0.1f, 0.2f}, 1);
    scene_start(&s);
    sbr_double3 at = center(&s, 0);
    at.x += 0.1;
    sbr_character_apply_rigid_impulse(s.world, s.character, 0, at, (sbf_vec3){0.3f, 0.1f, 0});
    scene_ticks(&s, 300);
    double fastest = 0;
    for (int i = 0; i < 60; i++) {
      sbr_world_tick(s.world);
      fastest = fmax(fastest, speed(&s, 0));
    }
    ck_assert_double_le(fastest, 1e-3);
    scene_free(&s);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("ground_touch");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, bodies_stick_up_to_the_friction_angle);
  tcase_add_test(tests, sliding_is_coulombs);
  tcase_add_test(tests, bounces_rise_by_the_restitution);
  tcase_add_test(tests, boxes_come_to_rest);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
