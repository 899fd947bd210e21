#include <math.h>

#include "harness.h"
#include "scenes.h"

static const double tick = 1.0 / 60, pi = 3.14159265358979323846;

/* Eight points connected by springs: the corners of a cube of 0.2 m. It stands on the origin, aligned with a
 * slope of `degrees`. */
static scene cube(
    float friction, float restitution, sbr_ground ground, sbr_double3 position, double degrees) {
  float up_y = (float)cos(degrees * pi / 180), up_z = (float)-sin(degrees * pi / 180);
  scene s = scene_begin();
  sbf_soft_body *body = scene_body(&s, 0);
  body->attributes.friction = friction;
  body->attributes.restitution = restitution;
  body->attributes.damping_ratio = 0.1f;
  sbf_vec3 positions[8];
  float masses[8], stiffness[28];
  sbf_uint2 ends[28];
  uint32_t count = 0;
  for (uint32_t i = 0; i < 8; i++) {
    float up = (float)(i >> 1 & 1) * 0.2f, along = (float)(i >> 2) * 0.2f - 0.1f;
    positions[i] =
        (sbf_vec3){(float)(i & 1) * 0.2f - 0.1f, up * up_y - along * up_z, up * up_z + along * up_y};
    masses[i] = 0.5f;
    for (uint32_t k = 0; k < i; k++) {
      ends[count] = (sbf_uint2){{k, i}};
      stiffness[count++] = 4000;
    }
  }
  sbf_level *level = scene_points(&s, 0, positions, masses, 8);
  scene_springs(&s, level, ends, stiffness, count);
  s.world_definition.ground = ground;
  s.character_definition.position = position;
  return s;
}

static sbr_double3 center(const scene *s) {
  sbf_vec3 points[8];
  sbr_double3 origin = sbr_character_get_origin(s->world, s->character), sum = origin;
  ck_assert_uint_eq(scene_read(s, 0, points, 8), 8);
  for (int i = 0; i < 8; i++) {
    sum.x += points[i].x / 8.0;
    sum.y += points[i].y / 8.0;
    sum.z += points[i].z / 8.0;
  }
  return sum;
}

static double lowest(const scene *s) {
  sbf_vec3 points[8];
  double origin = sbr_character_get_origin(s->world, s->character).y, low = 1e9;
  scene_read(s, 0, points, 8);
  for (int i = 0; i < 8; i++) low = fmin(low, origin + (double)points[i].y);
  return low;
}

START_TEST(a_dropped_body_comes_to_rest_on_the_ground)
{
  scene s = cube(0.6f, 0, sbr_ground_flat(0.5), (sbr_double3){0, 0.4, 0}, 0);
  scene_start(&s);
  scene_ticks(&s, 240);
  double y = center(&s).y;
  ck_assert_double_ge(lowest(&s), 0.5 - 1e-4);
  ck_assert_double_eq_tol(y, 0.6, 0.01);
  double max = 0;
  for (int i = 0; i < 60; i++) {
    scene_ticks(&s, 1);
    max = fmax(max, fabs(center(&s).y - y));
  }
  ck_assert_double_lt(max, 1e-4); /* no jitter */
  scene_free(&s);
}
END_TEST

START_TEST(a_body_thrown_down_is_never_left_in_the_ground)
{
  scene s = cube(0.6f, 0, sbr_ground_flat(0), (sbr_double3){0, 20, 0}, 0);
  scene_start(&s);
  for (int i = 0; i < 360; i++) {
    scene_ticks(&s, 1);
    ck_assert_double_ge(lowest(&s), -1e-3);
  }
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  scene_free(&s);
}
END_TEST

/* How far the cube has slid after two seconds on a slope of the given angle. */
static double slid(double degrees, float friction) {
  scene s = cube(friction, 0, sbr_ground_slope(degrees), (sbr_double3){0, 0, 3}, degrees);
  scene_start(&s);
  scene_ticks(&s, 90);
  double before = center(&s).z;
  scene_ticks(&s, 60);
  double after = center(&s).z;
  scene_free(&s);
  return before - after;
}

START_TEST(bodies_stick_below_the_friction_angle_and_slide_above)
{
  const float friction = 0.5f; /* atan 0.5 = 26.57 degrees */
  ck_assert_double_lt(fabs(slid(25, friction)), 2e-3);
  ck_assert_double_gt(slid(28.5, friction), 0.05);
  ck_assert_double_gt(slid(10, 0), 0.5);
}
END_TEST

/* On a slope of 20 degrees, uniform friction of tan 20 = 0.36 suffices. Here only the lower half has
 * friction, 1.2 or 0.12. */
START_TEST(a_weight_map_scales_friction)
{
  for (int pinned = 0; pinned < 2; pinned++) {
    scene s = cube(0.6f, 0, sbr_ground_slope(20), (sbr_double3){0, 0, 3}, 20);
    sbf_weight_map *map = sbf_asset_allocate(s.asset, 1, sizeof *map);
    float *values = sbf_asset_allocate(s.asset, 8, sizeof *values);
    sbf_weight_map_init(map);
    map->property = SBF_WEIGHT_PROPERTY_FRICTION;
    for (int i = 0; i < 8; i++) values[i] = i & 4 ? 0 : pinned ? 2 : 0.2f;
    map->values = (sbf_f32_list){values, 8};
    scene_body(&s, 0)->weight_maps = (sbf_weight_map_list){map, 1};
    scene_start(&s);
    scene_ticks(&s, 90);
    double before = center(&s).z;
    scene_ticks(&s, 60);
    if (pinned)
      ck_assert_double_lt(before - center(&s).z, 0.02);
    else
      ck_assert_double_gt(before - center(&s).z, 0.5);
    scene_free(&s);
  }
}
END_TEST

START_TEST(sliding_slows_by_coulombs_law)
{
  /* Down 40 degrees without friction it gains g sin; with it g (sin - mu cos). */
  double angle = 40 * pi / 180;
  for (int k = 0; k < 2; k++) {
    double mu = k ? 0.3 : 0, a = 9.81 * (sin(angle) - mu * cos(angle));
    scene s = cube((float)mu, 0, sbr_ground_slope(40), (sbr_double3){0, 0, 60}, 40);
    scene_start(&s);
    scene_ticks(&s, 60);
    double z0 = center(&s).z;
    scene_ticks(&s, 30);
    double z1 = center(&s).z;
    scene_ticks(&s, 30);
    double z2 = center(&s).z, t = 30 * tick;
    ck_assert_double_eq_tol((2 * z1 - z0 - z2) / (t * t), a * cos(angle), 0.03 * a);
    scene_free(&s);
  }
}
END_TEST

START_TEST(restitution_returns_its_fraction_of_speed)
{
  scene s = scene_begin();
  scene_body(&s, 0)->attributes.restitution = 0.5f;
  const sbf_vec3 position = {0, 0, 0};
  const float mass = 1;
  scene_points(&s, 0, &position, &mass, 1);
  s.model_options.substeps = 16;
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 1;
  scene_start(&s);
  double highest = 0, before = 1;
  bool fallen = false;
  for (int i = 0; i < 60; i++) {
    scene_ticks(&s, 1);
    sbr_double3 origin = sbr_character_get_origin(s.world, s.character);
    double y = origin.y + (double)scene_point(&s, 0, 0).y;
    fallen = fallen || y > before;
    if (fallen) highest = fmax(highest, y);
    before = y;
    ck_assert_double_ge(y, -1e-3);
  }
  ck_assert_double_eq_tol(highest, 0.25, 0.02);
  scene_free(&s);
}
END_TEST

START_TEST(bodies_in_the_ground_are_pushed_up_slowly)
{
  scene s = cube(0.6f, 0, sbr_ground_flat(0), (sbr_double3){0, -0.1, 0}, 0);
  scene_start(&s);
  double fastest = 0, before = center(&s).y;
  for (int i = 0; i < 180; i++) {
    scene_ticks(&s, 1);
    double y = center(&s).y;
    fastest = fmax(fastest, (y - before) / tick);
    before = y;
  }
  ck_assert_double_lt(fastest, 4); /* at once it would be 6 */
  ck_assert_double_ge(lowest(&s), -1e-3);
  ck_assert_double_eq_tol(center(&s).y, 0.1, 0.01);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("contact");
  TCase *c = tcase_create("contact");
  tcase_add_test(c, a_dropped_body_comes_to_rest_on_the_ground);
  tcase_add_test(c, a_body_thrown_down_is_never_left_in_the_ground);
  tcase_add_test(c, bodies_stick_below_the_friction_angle_and_slide_above);
  tcase_add_test(c, a_weight_map_scales_friction);
  tcase_add_test(c, sliding_slows_by_coulombs_law);
  tcase_add_test(c, restitution_returns_its_fraction_of_speed);
  tcase_add_test(c, bodies_in_the_ground_are_pushed_up_slowly);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
