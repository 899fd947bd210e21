/* Soft bodies against the host's shapes. */
#include <math.h>

#include "collision_scenes.h"
#include "harness.h"

static const double PI = 3.14159265358979323846;

static scene begin(void) {
  scene s = scene_begin();
  s.character_definition.position = (sbr_double3){0, 1000, 0}; /* of ground at -1000: the world's origin */
  return s;
}

enum { CELLS = 24, POINTS = (CELLS + 1) * (CELLS + 1) };

static double min_distance(const scene *s, sbf_vec3 center) {
  sbf_vec3 at[POINTS];
  double min = 1e9;
  uint32_t count = scene_read(s, 0, at, POINTS);
  for (uint32_t i = 0; i < count; i++) {
    double x = (double)(at[i].x - center.x), y = (double)(at[i].y - center.y),
           z = (double)(at[i].z - center.z);
    min = fmin(min, sqrt(x * x + y * y + z * z));
  }
  return min;
}

/* No point is inside the ball at any tick; the sheet hangs on it. */
START_TEST(cloth_rests_on_a_ball)
{
  scene s = begin();
  collision_sheet(&s, 0, (sbf_vec3){0, 0.4f, 0}, 1, CELLS, false);
  scene_body(&s, 0)->attributes.damping_ratio = 0.05f;
  scene_start(&s);
  sbr_shape *shape = collision_shape(collision_ball(0.3f));
  collision_collider(&s, shape, (sbr_double3){0, 0, 0});
  for (int i = 0; i < 180; i++) {
    scene_ticks(&s, 1);
    ck_assert_double_ge(min_distance(&s, (sbf_vec3){0, 0, 0}), 0.3 - 1e-4);
  }
  sbf_vec3 middle = scene_point(&s, 0, POINTS / 2);
  ck_assert_double_ge((double)middle.y, 0.25);
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

/* Also for coarser and thicker cloth, in the middle and beside it, from up to 10 m. Springs may push a point
 * under the ball faster in a tick than before. (Points used to be up to 42 mm inside.) */
START_TEST(no_point_enters_a_ball)
{
  static const uint32_t cells[3] = {6, 12, CELLS};
  static const float thicknesses[3] = {0, 0.002f, 0.02f}, heights[3] = {0.1f, 2, 10};
  sbr_shape *shape = collision_shape(collision_ball(0.3f));
  for (int i = 0; i < 18; i++) {
    scene s = begin();
    float thick = thicknesses[i / 3 % 3], height = heights[i % 3], aside = i / 9 ? 1 : 0;
    collision_sheet(
        &s, 0, (sbf_vec3){0.13f * aside, 0.3f + thick + height, 0.07f * aside}, 1, cells[_i], false);
    scene_body(&s, 0)->attributes.damping_ratio = 0.05f;
    scene_body(&s, 0)->collision.outer_thickness = thick;
    scene_start(&s);
    collision_collider(&s, shape, (sbr_double3){0, 0, 0});
    uint32_t falls = (uint32_t)(60 * sqrtf(2 * height / 9.81f));
    scene_ticks(&s, falls - 6);
    for (int tick = 0; tick < 40; tick++) {
      scene_ticks(&s, 1);
      double min = min_distance(&s, (sbf_vec3){0, 0, 0});
      ck_assert_msg(min >= 0.3 + (double)thick - 1e-4, "%u cells, %g m thick, from %g m: %g m off", cells[_i],
          (double)thick, (double)height, min);
    }
    scene_free(&s);
  }
  sbr_shape_destroy(shape);
}
END_TEST

/* A ball of 5 cm at 100 m/s, 1.67 m a tick, hits a sheet of 4 cm cells fixed at its rim. The sheet moves with
 * it, and the ball passes no point of it. */
START_TEST(a_fast_ball_carries_a_sheet_along)
{
  scene s = begin();
  collision_sheet(&s, 0, (sbf_vec3){0, 0, 0}, 1, CELLS, true);
  scene_body(&s, 0)->attributes.damping_ratio = 0.05f;
  scene_start(&s);
  sbr_shape *shape = collision_shape(collision_ball(0.05f));
  sbr_collider_id id = collision_collider(&s, shape, (sbr_double3){0, 1, 0});
  scene_ticks(&s, 2);
  double y = 1;
  bool reached = false;
  for (int i = 0; i < 1; i++) {
    y -= 100.0 / 60;
    sbr_collider_move(s.world, id, (sbr_double3){0, y, 0}, (sbf_quat){0, 0, 0, 1});
    scene_ticks(&s, 1);
    sbf_vec3 middle = scene_point(&s, 0, POINTS / 2);
    reached = reached || (double)middle.y < -0.2;
    ck_assert_double_le((double)middle.y, y - 0.05 + 1e-3); /* before it */
  }
  ck_assert(reached);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

/* Four points, 0.2 m apart, connected by springs: a plate that cannot tip on a slope. */
static scene plate_on(double degrees, float friction, sbr_shape **shape) {
  scene s = begin();
  float a = (float)(degrees * PI / 180);
  sbf_vec3 at[4];
  float masses[4] = {1, 1, 1, 1}, stiffness[6];
  sbf_uint2 ends[6];
  uint32_t count = 0;
  for (uint32_t i = 0; i < 4; i++) {
    float x = (float)(i % 2) * 0.2f, z = (float)(i / 2) * 0.2f;
    at[i] = (sbf_vec3){x, z * sinf(a), z * cosf(a)};
    for (uint32_t k = 0; k < i; k++) {
      ends[count] = (sbf_uint2){{k, i}};
      stiffness[count++] = 40000;
    }
  }
  sbf_level *level = scene_points(&s, 0, at, masses, 4);
  scene_springs(&s, level, ends, stiffness, count);
  scene_body(&s, 0)->attributes.friction = friction;
  scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  scene_body(&s, 0)->collision.particle_radius = 0.01f;
  scene_start(&s);
  *shape = collision_shape(collision_box(5, 1, 5));
  sbr_collider_definition d = sbr_default_collider_definition();
  d.shape = *shape;
  d.position = (sbr_double3){0, -1.0101 * cos((double)a), 1.0101 * sin((double)a)};
  d.rotation = (sbf_quat){-sinf(a / 2), 0, 0, cosf(a / 2)};
  sbr_collider_id id;
  ck_assert(sbr_collider_create(s.world, &d, &id, NULL) == SBF_OK);
  return s;
}

/* atan 0.5 = 26.565 degrees, a quarter of a degree either way. */
START_TEST(bodies_stick_up_to_the_friction_angle)
{
  const double degrees[2] = {26.315, 26.815};
  for (int i = 0; i < 2; i++) {
    sbr_shape *shape;
    scene s = plate_on(degrees[i], 0.5f, &shape);
    scene_ticks(&s, 60);
    double before = (double)scene_point(&s, 0, 0).z;
    scene_ticks(&s, 120);
    double moved = fabs((double)scene_point(&s, 0, 0).z - before), a = degrees[i] * PI / 180;
    double free = 9.81 * (sin(a) - 0.5 * cos(a)) * cos(a);
    if (i == 0)
      ck_assert_double_le(moved, 1e-4);
    else
      ck_assert_double_ge(moved, 0.6 * free * (2 * 1 + 0.5 * 2 * 2));
    scene_free(&s);
    sbr_shape_destroy(shape);
  }
}
END_TEST

/* A point dropped by a metre rises by e^2 of it. */
START_TEST(bounces_rise_by_the_restitution)
{
  const float e[3] = {0, 0.5f, 0.8f};
  for (int i = 0; i < 3; i++) {
    scene s = begin();
    const sbf_vec3 at = {0, 1.01f, 0};
    const float mass = 1;
    scene_points(&s, 0, &at, &mass, 1);
    s.model_options.substeps = 16;
    scene_start(&s);
    sbr_shape *shape = collision_shape(collision_box(1, 0.5f, 1));
    sbr_collider_definition d = sbr_default_collider_definition();
    d.shape = shape, d.position.y = -0.5, d.restitution = e[i];
    sbr_collider_id id;
    ck_assert(sbr_collider_create(s.world, &d, &id, NULL) == SBF_OK);
    scene_ticks(&s, 28); /* down after 0.4515 s */
    double top = 0;
    for (int k = 0; k < 50; k++) {
      scene_ticks(&s, 1);
      top = fmax(top, (double)scene_point(&s, 0, 0).y - 0.01);
    }
    ck_assert_double_eq_tol(top, (double)(e[i] * e[i]), 0.02);
    scene_free(&s);
    sbr_shape_destroy(shape);
  }
}
END_TEST

/* A body on a board moves with it; one without contact does not. */
START_TEST(a_moving_board_carries_and_a_filter_disables_contact)
{
  for (int contacts = 0; contacts < 2; contacts++) {
    scene s = begin();
    const sbf_vec3 at = {0, 0.011f, 0};
    const float mass = 1;
    scene_points(&s, 0, &at, &mass, 1);
    scene_body(&s, 0)->attributes.friction = 1;
    scene_body(&s, 0)->collision.layer = 4;
    scene_body(&s, 0)->collision.mask = contacts ? 3 : 2;
    scene_start(&s);
    sbr_shape *shape = collision_shape(collision_box(1, 0.5f, 1));
    sbr_collider_id id = collision_collider(&s, shape, (sbr_double3){0, -0.5, 0});
    for (int i = 1; i <= 60; i++) {
      sbr_collider_move(s.world, id, (sbr_double3){0.01 * i, -0.5 + 0.005 * i, 0}, (sbf_quat){0, 0, 0, 1});
      scene_ticks(&s, 1);
    }
    sbf_vec3 end = scene_point(&s, 0, 0);
    if (contacts) {
      ck_assert_float_eq_tol(end.x, 0.6f, 0.02f);
      ck_assert_float_eq_tol(end.y, 0.31f, 0.002f);
    } else {
      ck_assert_float_lt(end.y, -3);
    }
    scene_free(&s);
    sbr_shape_destroy(shape);
  }
}
END_TEST

/* A point that starts inside moves out slowly. */
START_TEST(points_inside_shapes_move_outside)
{
  scene s = begin();
  const sbf_vec3 at = {0, -0.05f, 0};
  const float mass = 1;
  scene_points(&s, 0, &at, &mass, 1);
  scene_start(&s);
  sbr_shape *shape = collision_shape(collision_box(1, 0.5f, 1));
  collision_collider(&s, shape, (sbr_double3){0, -0.5, 0});
  float before = -0.05f, fastest = 0;
  for (int i = 0; i < 60; i++) {
    scene_ticks(&s, 1);
    float y = scene_point(&s, 0, 0).y;
    fastest = fmaxf(fastest, (y - before) * 60);
    before = y;
  }
  ck_assert_float_ge(before, 0.01f - 1e-3f);
  ck_assert_float_le(fastest, 2.5f);
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

/* It sleeps on a shape and wakes when the shape is removed. */
START_TEST(a_sleeping_body_wakes_when_its_support_is_removed)
{
  scene s = begin();
  const sbf_vec3 at = {0, 0.011f, 0};
  const float mass = 1;
  scene_points(&s, 0, &at, &mass, 1);
  s.world_definition.sleep_after_s = 0.2;
  scene_body(&s, 0)->attributes.media_friction = 1;
  scene_start(&s);
  sbr_shape *shape = collision_shape(collision_box(1, 0.5f, 1));
  sbr_collider_id id = collision_collider(&s, shape, (sbr_double3){0, -0.5, 0});
  scene_ticks(&s, 60);
  float y = scene_point(&s, 0, 0).y;
  int mine;
  ck_assert(sbr_collider_is_valid(s.world, id));
  sbr_collider_set_user_data(s.world, id, &mine);
  ck_assert_ptr_eq(sbr_collider_get_user_data(s.world, id), &mine);
  sbr_collider_destroy(s.world, id);
  ck_assert(!sbr_collider_is_valid(s.world, id));
  ck_assert_ptr_null(sbr_collider_get_user_data(s.world, id));
  scene_ticks(&s, 30);
  ck_assert_float_eq_tol(y, 0.01f, 1e-3f);
  ck_assert_float_lt(scene_point(&s, 0, 0).y, -0.5f);
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("shape_touch");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, cloth_rests_on_a_ball);
  tcase_add_loop_test(tests, no_point_enters_a_ball, 0, 3);
  tcase_add_test(tests, a_fast_ball_carries_a_sheet_along);
  tcase_add_test(tests, bodies_stick_up_to_the_friction_angle);
  tcase_add_test(tests, bounces_rise_by_the_restitution);
  tcase_add_test(tests, a_moving_board_carries_and_a_filter_disables_contact);
  tcase_add_test(tests, points_inside_shapes_move_outside);
  tcase_add_test(tests, a_sleeping_body_wakes_when_its_support_is_removed);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
