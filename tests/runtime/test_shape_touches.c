/* Rigid bodies against the host's shapes. */
#include <math.h>

#include "collision_scenes.h"
#include "event_log.h"
#include "harness.h"
#include "rigid_scenes.h"
#include "sbrun/query.h"

static const double PI = 3.14159265358979323846;

static scene begin(void) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  s.character_definition.position.y = 1000;
  return s;
}

static sbr_shape_definition shape_kind(sbr_shape_kind kind) {
  sbr_shape_definition d = sbr_default_shape_definition();
  d.kind = kind;
  return d;
}

static double speed(const scene *s, uint32_t body) {
  sbf_vec3 v = rigid_state(s, body).velocity;
  return sqrt((double)(v.x * v.x + v.y * v.y + v.z * v.z));
}

static float host_floor(void *user, sbf_vec3 position, float reach, sbf_vec3 *normal) {
  (void)user, (void)reach;
  *normal = (sbf_vec3){0, 1, 0};
  return position.y;
}

/* A box dropped on the top (y = 0) of each kind of shape lies there, as high as it is. */
START_TEST(a_box_rests_on_any_shape)
{
  float heights[25] = {0};
  const sbf_vec3 points[8] = {
      {-2, -1, -2}, {2, -1, -2}, {-2, 0, -2}, {2, 0, -2}, {-2, -1, 2}, {2, -1, 2}, {-2, 0, 2}, {2, 0, 2}};
  static const uint32_t sides[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
      0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  const sbr_shape_kind kinds[6] = {
      SBR_SHAPE_PLANE, SBR_SHAPE_BOX, SBR_SHAPE_HULL, SBR_SHAPE_MESH, SBR_SHAPE_HEIGHT_FIELD, SBR_SHAPE_HOST};
  sbr_height_field field = {.heights_m = heights, .columns = 5, .rows = 5, .cell_m = 1, .x = -2, .z = -2};
  scene s = begin();
  rigid_box(&s, (sbf_vec3){0.2f, 0.4f, 0.1f}, (sbf_vec3){0.3f, 0.1f, 0.2f}, 1);
  scene_start(&s);
  sbr_shape_definition d = shape_kind(kinds[_i]);
  d.half_sizes = (sbf_vec3){2, 0.5f, 2};
  d.points = points, d.point_count = 8, d.triangles = sides, d.triangle_count = 12;
  d.heights = &field;
  d.host = (sbr_host_shape){.distance = host_floor, .low = {-9, -9, -9}, .high = {9, 9, 9}};
  sbr_shape *shape = collision_shape(d);
  collision_collider(&s, shape, (sbr_double3){0, d.kind == SBR_SHAPE_BOX ? -0.5 : 0, 0});
  scene_ticks(&s, 180);
  ck_assert_float_eq_tol(rigid_state(&s, 0).center.y, 0.05f, 1e-3f);
  ck_assert_double_le(speed(&s, 0), 1e-3);
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

START_TEST(bodies_stick_up_to_the_friction_angle)
{
  const double degrees[2] = {26.315, 26.815};
  for (int i = 0; i < 2; i++) {
    double a = degrees[i] * PI / 180;
    scene s = begin();
    rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.1f, 0.2f}, 1);
    rigid_body(&s, 0)->friction = 0.5f;
    sbf_vec3 *points = (sbf_vec3 *)(uintptr_t)rigid_body(&s, 0)->hull->positions.at;
    for (int k = 0; k < 8; k++) {
      double y = (double)points[k].y, z = (double)points[k].z;
      points[k].y = (float)(y * cos(a) + z * sin(a)), points[k].z = (float)(z * cos(a) - y * sin(a));
    }
    scene_start(&s);
    sbr_shape_definition of = shape_kind(SBR_SHAPE_BOX);
    of.half_sizes = (sbf_vec3){2, 1, 20};
    sbr_shape *shape = collision_shape(of);
    sbr_collider_definition d = sbr_default_collider_definition();
    sbr_collider_id id;
    d.shape = shape;
    d.position = (sbr_double3){0, -1.0501 * cos(a), 1.0501 * sin(a)};
    d.rotation = (sbf_quat){-(float)sin(a / 2), 0, 0, (float)cos(a / 2)};
    ck_assert(sbr_collider_create(s.world, &d, &id, NULL) == SBF_OK);
    scene_ticks(&s, 180);
    if (i == 0)
      ck_assert_double_le(speed(&s, 0), 1e-3);
    else
      ck_assert_double_ge(speed(&s, 0), 0.6 * 3 * 9.81 * (sin(a) - 0.5 * cos(a)));
    scene_free(&s);
    sbr_shape_destroy(shape);
  }
}
END_TEST

/* 1.67 m a tick at a board of a centimetre: it does not come through. */
START_TEST(a_bullet_stops_at_a_thin_board)
{
  scene s = begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.02f, 0.02f, 0.02f}, 0.1f);
  scene_start(&s);
  sbr_shape_definition of = shape_kind(SBR_SHAPE_BOX);
  of.half_sizes = (sbf_vec3){1, 1, 0.005f};
  sbr_shape *shape = collision_shape(of);
  collision_collider(&s, shape, (sbr_double3){0, 0, 5});
  sbr_character_apply_rigid_impulse(s.world, s.character, 0, (sbr_double3){0, 0, 0}, (sbf_vec3){0, 0, 10});
  for (int i = 0; i < 60; i++) {
    scene_ticks(&s, 1);
    ck_assert_float_le(rigid_state(&s, 0).center.z, 5);
  }
  ck_assert_float_ge(rigid_state(&s, 0).center.z, 4.9f);
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

/* A ball as a shape knocks a box away, at least at the ball's own speed. Rays and boxes find both. */
START_TEST(a_moving_ball_pushes)
{
  scene s = begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  scene_start(&s);
  sbr_shape *shape = collision_shape(shape_kind(SBR_SHAPE_SPHERE));
  sbr_collider_id id = collision_collider(&s, shape, (sbr_double3){-1, 0, 0});
  sbr_hit hit;
  sbr_query_filter second = sbr_default_query_filter();
  second.mask = 2;
  ck_assert(sbr_world_cast_ray(s.world, (sbr_double3){-3, 0, 0}, (sbf_vec3){2, 0, 0}, 10, NULL, &hit));
  ck_assert_uint_eq(hit.object.collider.value, id.value);
  ck_assert_double_eq_tol(hit.distance, 1.5, 1e-5);
  ck_assert(sbr_world_cast_ray(s.world, (sbr_double3){3, 0, 0}, (sbf_vec3){-1, 0, 0}, 10, NULL, &hit));
  ck_assert_int_eq(hit.object.rigid_body, 0);
  ck_assert_double_eq_tol(hit.position.x, 0.1, 1e-5);
  ck_assert(!sbr_world_cast_ray(s.world, (sbr_double3){3, 0, 0}, (sbf_vec3){-1, 0, 0}, 10, &second, &hit));
  ck_assert_uint_eq(
      sbr_world_overlap_aabb(s.world, (sbr_double3){-2, -1, -1}, (sbr_double3){1, 1, 1}, NULL, NULL, NULL),
      2);
  event_log log = {.begin_count = 0};
  for (int i = 1; i <= 60; i++) {
    sbr_collider_move(s.world, id, (sbr_double3){-1 + i / 60.0, 0, 0}, (sbf_quat){0, 0, 0, 1});
    scene_ticks_logged(&s, 1, &log);
    ck_assert_float_ge(rigid_state(&s, 0).center.x - (float)(-1 + i / 60.0), 0.6f - 2e-3f);
  }
  ck_assert_double_eq_tol((double)rigid_state(&s, 0).velocity.x, 1, 0.02);
  ck_assert_uint_ge(log.begin_count, 1);
  const sbr_contact_event *event = &log.begin[0];
  ck_assert_int_eq(event->a.rigid_body, 0);
  ck_assert_int_eq(event->a.soft_body, -1);
  ck_assert_uint_eq(event->b.collider.value, id.value);
  ck_assert_float_ge(event->normal.x, 0.999f);
  ck_assert_float_eq_tol(event->impulse, 1, 0.05f); /* 1 kg to 1 m/s */
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

static bool is_ground(const sbr_object *object) {
  return !object->character.value && !object->collider.value;
}

/* From above, slanted, and from below; the ground's height is known at both. */
START_TEST(rays_find_the_ground)
{
  static const sbr_obstacle block = {SBR_OBSTACLE_BOX, {2, 0, 0}, {0.5f, 1, 0.5f}, 0};
  sbr_ground base = sbr_ground_flat(0);
  const sbr_obstacle_set set = {&base, &block, 1};
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_world *world;
  sbr_hit hit;
  sbr_query_filter first = sbr_default_query_filter(), second = first;
  first.mask = 1, second.mask = 2;
  definition.ground = _i ? sbr_ground_with_obstacles(&set) : base;
  ck_assert_int_eq(sbr_world_create(&definition, &world, NULL), SBF_OK);
  ck_assert(sbr_world_cast_ray(world, (sbr_double3){0, 3, 0}, (sbf_vec3){0, -1, 0}, 10, &first, &hit));
  ck_assert(is_ground(&hit.object));
  ck_assert_double_eq_tol(hit.distance, 3, 1e-5);
  ck_assert_float_eq_tol(hit.normal.y, 1, 1e-6f);
  ck_assert(!sbr_world_cast_ray(world, (sbr_double3){0, 3, 0}, (sbf_vec3){0, -1, 0}, 2.9, &first, &hit));
  ck_assert(!sbr_world_cast_ray(world, (sbr_double3){0, 3, 0}, (sbf_vec3){0, -1, 0}, 10, &second, &hit));
  ck_assert(!sbr_world_cast_ray(world, (sbr_double3){0, -1, 0}, (sbf_vec3){0, 1, 0}, 10, &first, &hit));
  ck_assert_int_eq(
      sbr_world_cast_ray(world, (sbr_double3){0, 0.5, 0}, (sbf_vec3){1, 0, 0}, 10, &first, &hit), _i);
  if (_i) ck_assert_double_eq_tol(hit.distance, 1.5, 1e-5);
  sbr_world_destroy(world);
}
END_TEST

START_TEST(invalid_positions_are_refused)
{
  scene s = begin();
  scene_start(&s);
  sbr_shape *shape = collision_shape(shape_kind(SBR_SHAPE_SPHERE));
  sbr_collider_definition d = sbr_default_collider_definition();
  sbr_collider_id id;
  sbf_diagnostic error;
  sbr_hit hit;
  d.shape = shape;
  d.position.z = (double)NAN;
  ck_assert_int_eq(sbr_collider_create(s.world, &d, &id, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "finite"));
  d.position.z = 0, d.rotation.x = INFINITY;
  ck_assert_int_eq(sbr_collider_create(s.world, &d, &id, &error), SBF_FAILED);
  id = collision_collider(&s, shape, (sbr_double3){-1, 0, 0});
  sbr_collider_move(s.world, id, (sbr_double3){(double)NAN, 0, 0}, (sbf_quat){0, 0, 0, 1});
  sbr_collider_set_transform(s.world, id, (sbr_double3){0, 0, 0}, (sbf_quat){0, NAN, 0, 1});
  scene_ticks(&s, 2);
  ck_assert(sbr_world_cast_ray(s.world, (sbr_double3){-3, 0, 0}, (sbf_vec3){1, 0, 0}, 10, NULL, &hit));
  ck_assert_double_eq_tol(hit.distance, 1.5, 1e-5);
  ck_assert(!sbr_world_cast_ray(s.world, (sbr_double3){-3, 0, 0}, (sbf_vec3){NAN, 0, 0}, 10, NULL, &hit));
  ck_assert(
      !sbr_world_cast_ray(s.world, (sbr_double3){-3, (double)NAN, 0}, (sbf_vec3){1, 0, 0}, 10, NULL, &hit));
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("shape_touches");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, a_box_rests_on_any_shape, 0, 6);
  tcase_add_test(tests, bodies_stick_up_to_the_friction_angle);
  tcase_add_test(tests, a_bullet_stops_at_a_thin_board);
  tcase_add_test(tests, a_moving_ball_pushes);
  tcase_add_loop_test(tests, rays_find_the_ground, 0, 2);
  tcase_add_test(tests, invalid_positions_are_refused);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
