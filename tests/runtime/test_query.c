/* Rays, cast shapes and overlaps against closed forms. */
#include <math.h>

#include "collision_scenes.h"
#include "harness.h"
#include "rigid_scenes.h"
#include "sbrun/query.h"
#include "sbrun/terrain.h"

static const sbf_quat level = {0, 0, 0, 1};
static const double EXACT_M = 2e-5;

static sbr_shape *shapes[8];
static uint32_t shape_count;

static const sbr_shape *shape_of(sbr_shape_definition definition) {
  shapes[shape_count] = collision_shape(definition);
  return shapes[shape_count++];
}

static sbr_shape_definition capsule(float radius, float half_height) {
  sbr_shape_definition d = sbr_default_shape_definition();
  d.kind = SBR_SHAPE_CAPSULE, d.radius = radius, d.half_sizes.y = half_height;
  return d;
}

static sbr_shape_definition plane(void) {
  sbr_shape_definition d = sbr_default_shape_definition();
  d.kind = SBR_SHAPE_PLANE;
  return d;
}

/* A world of its own with its ground 100 m down. */
static sbr_world *begin_on(sbr_ground ground) {
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_world *world;
  definition.ground = ground;
  ck_assert_int_eq(sbr_world_create(&definition, &world, NULL), SBF_OK);
  return world;
}

static sbr_world *begin(void) {
  return begin_on(sbr_ground_flat(-100));
}

static void end(sbr_world *world) {
  sbr_world_destroy(world);
  while (shape_count > 0) sbr_shape_destroy(shapes[--shape_count]);
}

static sbr_collider_id put(
    sbr_world *world, const sbr_shape *shape, sbr_double3 position, sbf_quat rotation) {
  sbr_collider_definition d = sbr_default_collider_definition();
  sbr_collider_id id;
  d.shape = shape, d.position = position, d.rotation = rotation;
  ck_assert_int_eq(sbr_collider_create(world, &d, &id, NULL), SBF_OK);
  return id;
}

static double cast(
    const sbr_world *world, const sbr_shape *shape, sbr_double3 from, sbf_vec3 direction, sbr_hit *hit) {
  return sbr_world_cast_shape(world, shape, from, level, direction, 20, NULL, hit) ? hit->distance : -1;
}

/* A sphere of 0.3 m against a plane, a ball, a box (its face, an edge, a corner) and a capsule. */
START_TEST(a_sphere_hits_where_it_must)
{
  sbr_world *world = begin();
  const sbr_shape *ball = shape_of(collision_ball(0.3f));
  sbr_hit hit;
  sbr_collider_id floor = put(world, shape_of(plane()), (sbr_double3){0, -5, 0}, level);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, 1, 0}, (sbf_vec3){0, -2, 0}, &hit), 5.7, EXACT_M);
  ck_assert_uint_eq(hit.object.collider.value, floor.value);
  ck_assert_double_eq_tol(hit.position.y, -5, EXACT_M);
  ck_assert_float_eq_tol(hit.normal.y, 1, 1e-6f);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, 1, 0}, (sbf_vec3){1, -1, 0}, &hit), 5.7 * sqrt(2), 2 * EXACT_M);
  sbr_collider_destroy(world, floor);

  sbr_collider_id other = put(world, shape_of(collision_ball(0.5f)), (sbr_double3){4, 0, 0}, level);
  double off = 0.4, along = 4 - sqrt(0.64 - off * off);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, off, 0}, (sbf_vec3){1, 0, 0}, &hit), along, EXACT_M);
  ck_assert_float_eq_tol(hit.normal.y, 0.5f, 1e-4f);
  ck_assert_double_eq_tol(hit.position.y, 0.25, 1e-4);
  ck_assert_double_lt(cast(world, ball, (sbr_double3){0, 0.801, 0}, (sbf_vec3){1, 0, 0}, &hit), 0);
  sbr_collider_destroy(world, other);

  other = put(world, shape_of(collision_box(0.5f, 0.5f, 0.5f)), (sbr_double3){4, 0, 0}, level);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, 0.4, 0.1}, (sbf_vec3){1, 0, 0}, &hit), 3.2, EXACT_M);
  ck_assert_float_eq_tol(hit.normal.x, -1, 1e-5f);
  ck_assert_double_eq_tol(hit.position.y, 0.4, 1e-4);
  double edge = 3.5 - sqrt(0.09 - 0.04); /* 0.2 m above the edge */
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, 0.7, 0.1}, (sbf_vec3){1, 0, 0}, &hit), edge, EXACT_M);
  double corner = 3.5 - sqrt(0.09 - 0.03);
  const double a = 0.5 + sqrt(0.015);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, a, a}, (sbf_vec3){1, 0, 0}, &hit), corner, EXACT_M);
  sbr_collider_destroy(world, other);

  put(world, shape_of(capsule(0.5f, 1)), (sbr_double3){4, 0, 0}, level);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, 0.9, 0}, (sbf_vec3){1, 0, 0}, &hit), 3.2, EXACT_M);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, 1.4, 0}, (sbf_vec3){1, 0, 0}, &hit), along, EXACT_M);
  end(world);
}
END_TEST

/* Boxes, capsules and hulls: turned by 45 degrees, an edge goes ahead. */
START_TEST(boxes_and_capsules_are_cast)
{
  sbr_world *world = begin();
  const float h = sqrtf(0.5f);
  const sbf_quat turned = {0, 0, sinf(0.3926991f), cosf(0.3926991f)};
  const sbr_shape *box = shape_of(collision_box(0.5f, 0.5f, 0.5f)), *pill = shape_of(capsule(0.25f, 0.5f));
  sbr_hit hit;
  put(world, box, (sbr_double3){4, 0, 0}, level);
  ck_assert_double_eq_tol(cast(world, box, (sbr_double3){0, 0.9, 0}, (sbf_vec3){1, 0, 0}, &hit), 3, EXACT_M);
  ck_assert_double_lt(cast(world, box, (sbr_double3){0, 1.001, 0}, (sbf_vec3){1, 0, 0}, &hit), 0);
  ck_assert(
      sbr_world_cast_shape(world, box, (sbr_double3){0, 0, 0}, turned, (sbf_vec3){1, 0, 0}, 20, NULL, &hit));
  ck_assert_double_eq_tol(hit.distance, 3.5 - (double)h, EXACT_M);
  ck_assert_double_eq_tol(
      cast(world, pill, (sbr_double3){4, 5, 0}, (sbf_vec3){0, -1, 0}, &hit), 3.75, EXACT_M);
  ck_assert_double_eq_tol(
      cast(world, pill, (sbr_double3){0, 0, 0}, (sbf_vec3){1, 0, 0}, &hit), 3.25, EXACT_M);
  /* A shape that overlaps at the start hits at once. One that moves away hits nothing. */
  ck_assert(cast(world, pill, (sbr_double3){3.6, 0, 0}, (sbf_vec3){-1, 0, 0}, &hit) == 0);
  ck_assert_float_eq_tol(hit.normal.x, 1, 1e-6f);
  ck_assert_double_lt(cast(world, pill, (sbr_double3){3, 0, 0}, (sbf_vec3){-1, 0, 0}, &hit), 0);
  const sbr_shape *floor = shape_of(plane());
  ck_assert(!sbr_world_cast_shape(
      world, floor, (sbr_double3){0, 0, 0}, level, (sbf_vec3){1, 0, 0}, 20, NULL, &hit));
  ck_assert(!sbr_world_cast_shape(
      world, box, (sbr_double3){(double)NAN, 0, 0}, level, (sbf_vec3){1, 0, 0}, 20, NULL, &hit));
  end(world);
}
END_TEST

/* A cube of triangles is solid behind them; a host's ball by its distance. */
static float ball_distance(void *user, sbf_vec3 x, float reach, sbf_vec3 *normal) {
  (void)user, (void)reach;
  float length = sqrtf(x.x * x.x + x.y * x.y + x.z * x.z);
  if (length > 0) *normal = (sbf_vec3){x.x / length, x.y / length, x.z / length};
  return length - 0.5f;
}

static bool count_objects(void *user, const sbr_object *object) {
  uint32_t *count = user;
  (void)object;
  (*count)++;
  return true;
}

static uint32_t overlaps(const sbr_world *world, const sbr_shape *shape, double x, double y, double z) {
  uint32_t count = 0;
  uint32_t reports =
      sbr_world_overlap_shape(world, shape, (sbr_double3){x, y, z}, level, NULL, count_objects, &count);
  ck_assert_uint_eq(reports, count);
  return count;
}

START_TEST(meshes_and_host_geometry)
{
  static const sbf_vec3 points[8] = {
      {-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}};
  static const uint32_t triangles[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7,
      3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  sbr_world *world = begin();
  const sbr_shape *ball = shape_of(collision_ball(0.25f));
  sbr_shape_definition d = sbr_default_shape_definition();
  d.kind = SBR_SHAPE_MESH;
  d.points = points, d.point_count = 8, d.triangles = triangles, d.triangle_count = 12;
  sbr_hit hit;
  put(world, shape_of(d), (sbr_double3){5, 0, 0}, level);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, 0.3, 0.2}, (sbf_vec3){1, 0, 0}, &hit), 3.75, EXACT_M);
  ck_assert_float_eq_tol(hit.normal.x, -1, 1e-5f);
  ck_assert_double_lt(
      cast(world, ball, (sbr_double3){5, 0, 0}, (sbf_vec3){1, 0, 0}, &hit), 0); /* from inside */
  ck_assert_uint_eq(overlaps(world, ball, 5, 0, 0), 1);
  ck_assert_uint_eq(overlaps(world, ball, 3.8, 0, 0), 1);
  ck_assert_uint_eq(overlaps(world, ball, 3.7, 0, 0), 0);
  d = sbr_default_shape_definition();
  d.kind = SBR_SHAPE_HOST;
  d.host =
      (sbr_host_shape){.distance = ball_distance, .low = {-0.5f, -0.5f, -0.5f}, .high = {0.5f, 0.5f, 0.5f}};
  put(world, shape_of(d), (sbr_double3){0, 5, 0}, level);
  ck_assert_double_eq_tol(cast(world, ball, (sbr_double3){0, 0, 0}, (sbf_vec3){0, 1, 0}, &hit), 4.25, 2e-4);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0.45, 0, 0}, (sbf_vec3){0, 1, 0}, &hit), 5 - 0.6, 5e-4);
  ck_assert_uint_eq(overlaps(world, ball, 0, 4.3, 0), 1);
  ck_assert_uint_eq(overlaps(world, ball, 0, 4.2, 0), 0);
  end(world);
}
END_TEST

/* Flat, sloping by 30 degrees, and with a block on it. */
START_TEST(the_ground_is_hit)
{
  const sbr_shape *ball = shape_of(collision_ball(0.3f)), *box = shape_of(collision_box(0.2f, 0.2f, 0.2f));
  sbr_world *world = begin_on(sbr_ground_flat(0.5));
  sbr_hit hit;
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){7, 3, 0}, (sbf_vec3){0, -1, 0}, &hit), 2.2, EXACT_M);
  ck_assert_uint_eq(hit.object.collider.value + hit.object.character.value, 0);
  ck_assert_uint_eq(overlaps(world, ball, 0, 0.7, 0), 1);
  ck_assert_uint_eq(overlaps(world, ball, 0, -7, 0), 1);
  ck_assert_uint_eq(overlaps(world, ball, 0, 0.81, 0), 0);
  sbr_world_destroy(world);

  world = begin_on(sbr_ground_slope(30));
  const double rise = tan(30 * acos(-1) / 180), away = 0.3 / cos(30 * acos(-1) / 180);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, 6, 4}, (sbf_vec3){0, -1, 0}, &hit), 6 - 4 * rise - away, 1e-4);
  ck_assert_float_eq_tol(hit.normal.y, cosf(0.5235988f), 1e-4f);
  ck_assert_double_eq_tol(
      cast(world, ball, (sbr_double3){0, 3, -4}, (sbf_vec3){0, 0, 1}, &hit), 4 + (3 - away) / rise, 1e-4);
  sbr_world_destroy(world);

  static const sbr_obstacle block = {SBR_OBSTACLE_BOX, {3, 0, 0}, {0.5f, 1, 0.5f}, 0};
  sbr_ground base = sbr_ground_flat(0);
  const sbr_obstacle_set set = {&base, &block, 1};
  world = begin_on(sbr_ground_with_obstacles(&set));
  ck_assert_double_eq_tol(cast(world, box, (sbr_double3){3, 4, 0.1}, (sbf_vec3){0, -1, 0}, &hit), 2.8, 1e-3);
  ck_assert_double_eq_tol(cast(world, box, (sbr_double3){0, 0.5, 0}, (sbf_vec3){1, 0, 0}, &hit), 2.3, 0.06);
  ck_assert_double_eq_tol(cast(world, box, (sbr_double3){0, 4, 0}, (sbf_vec3){0, -1, 0}, &hit), 3.8, 1e-3);
  end(world);
}
END_TEST

static bool accept_none(void *user, const sbr_object *object) {
  uint32_t *count = user;
  (void)object;
  (*count)++;
  return false;
}

/* Layers both ways, the callback, and a filter that was never initialised. */
START_TEST(filters_apply)
{
  sbr_world *world = begin_on(sbr_ground_flat(0));
  const sbr_shape *ball = shape_of(collision_ball(0.5f));
  sbr_collider_definition d = sbr_default_collider_definition();
  sbr_collider_id id;
  d.shape = ball, d.layer = 4, d.mask = 8, d.position.y = 3;
  ck_assert_int_eq(sbr_collider_create(world, &d, &id, NULL), SBF_OK);
  sbr_hit hit;
  const sbr_double3 from = {0, 10, 0};
  const sbf_vec3 down = {0, -1, 0};
  for (uint32_t kind = 0; kind < 2; kind++)
    for (uint32_t layer = 4; layer <= 8; layer += 4)
      for (uint32_t mask = 1; mask <= 5; mask += 4) {
        sbr_query_filter filter = sbr_default_query_filter();
        filter.layer = layer, filter.mask = mask;
        bool found = kind ? sbr_world_cast_shape(world, ball, from, level, down, 20, &filter, &hit)
                          : sbr_world_cast_ray(world, from, down, 20, &filter, &hit);
        ck_assert(found);
        ck_assert_int_eq(hit.object.collider.value == id.value, layer == 8 && mask == 5);
      }
  uint32_t calls = 0;
  sbr_query_filter filter = sbr_default_query_filter(), zero = {.mask = 1};
  filter.accept = accept_none, filter.user = &calls;
  ck_assert(!sbr_world_cast_ray(world, from, down, 20, &filter, &hit));
  ck_assert(!sbr_world_cast_shape(world, ball, from, level, down, 20, &filter, &hit));
  ck_assert_uint_eq(calls, 4); /* the ground and the ball, twice */
  ck_assert_uint_eq(
      sbr_world_overlap_shape(world, ball, (sbr_double3){0, 3, 0}, level, &filter, NULL, NULL), 0);
  ck_assert(!sbr_world_cast_ray(world, from, down, 20, &zero, &hit));
  ck_assert_uint_eq(
      sbr_world_overlap_aabb(world, (sbr_double3){-9, -9, -9}, (sbr_double3){9, 9, 9}, &zero, NULL, NULL), 0);
  end(world);
}
END_TEST

static bool stop(void *user, const sbr_object *object) {
  (void)user, (void)object;
  return false;
}

/* Three rows of colliders, the ground, a rigid box and a sheet. */
START_TEST(overlaps_are_counted)
{
  scene s = rigid_begin();
  s.world_definition.ground = sbr_ground_flat(-1);
  s.character_definition.position.y = 1;
  scene_bodies(&s, 1);
  collision_sheet(&s, 0, (sbf_vec3){0, 0.5f, 0}, 0.6f, 4, true);
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  scene_start(&s);
  const sbr_shape *ball = shape_of(collision_ball(0.1f)), *large = shape_of(collision_ball(0.35f));
  for (int i = 0; i < 9; i++) collision_collider(&s, ball, (sbr_double3){2 + i % 3, i / 3, 0});
  uint32_t count = 0;
  const sbr_double3 low = {1.5, -0.5, -0.5}, high = {3.5, 1.5, 0.5}, all = {9, 9, 9}, none = {-9, -9, -9};
  ck_assert_uint_eq(sbr_world_overlap_aabb(s.world, low, high, NULL, count_objects, &count), 4);
  ck_assert_uint_eq(count, 4);
  ck_assert_uint_eq(sbr_world_overlap_aabb(s.world, none, all, NULL, NULL, NULL), 12);
  ck_assert_uint_eq(sbr_world_overlap_aabb(s.world, none, all, NULL, stop, NULL), 1);
  ck_assert_uint_eq(sbr_world_overlap_aabb(s.world, all, none, NULL, NULL, NULL), 0);
  ck_assert_uint_eq(overlaps(s.world, large, 2.5, 0, 0), 0);
  ck_assert_uint_eq(overlaps(s.world, large, 2.44, 0, 0), 1);
  ck_assert_uint_eq(overlaps(s.world, large, 0, 0.3, 0), 2); /* box and sheet */
  ck_assert_uint_eq(overlaps(s.world, ball, 0, 0.3, 0), 0);
  ck_assert_uint_eq(overlaps(s.world, ball, 0.2, 0.45, 0), 1);
  sbr_hit hit;
  ck_assert_double_eq_tol(
      cast(s.world, ball, (sbr_double3){0.21, 3, 0}, (sbf_vec3){0, -1, 0}, &hit), 2.4, 1e-4);
  ck_assert_int_eq(hit.object.soft_body, 0);
  ck_assert_double_eq_tol(cast(s.world, ball, (sbr_double3){-3, 0, 0}, (sbf_vec3){1, 0, 0}, &hit), 2.8, 1e-4);
  ck_assert_int_eq(hit.object.rigid_body, 0);
  ck_assert_uint_eq(hit.object.character.value, s.character.value);
  scene_free(&s);
  while (shape_count > 0) sbr_shape_destroy(shapes[--shape_count]);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("query");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_sphere_hits_where_it_must);
  tcase_add_test(tests, boxes_and_capsules_are_cast);
  tcase_add_test(tests, meshes_and_host_geometry);
  tcase_add_test(tests, the_ground_is_hit);
  tcase_add_test(tests, filters_apply);
  tcase_add_test(tests, overlaps_are_counted);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
