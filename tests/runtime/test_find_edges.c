/* Coarse bars, four faces round and with edges 10 cm long, touch where neither has a vertex. */
#include <math.h>

#include "collision_scenes.h"
#include "contact_scenes.h"
#include "harness.h"
#include "momentum.h"
#include "shapes.h"
#include "skin_depth.h"
#include "state/world.h"

enum { CELLS = 6, MAX = 64, PLACES = 24 };
static const float LENGTH = 0.6f, THICK = 0.06f;

typedef struct lies {
  sbf_vec3 center;
  float heading, roll; /* about Y, and before that about its own axis */
} lies;

static void put(sbf_vec3 *at, uint32_t count, const lies *to) {
  float c = cosf(to->heading), s = sinf(to->heading), d = cosf(to->roll), r = sinf(to->roll);
  for (uint32_t i = 0; i < count; i++) {
    sbf_vec3 x = {at[i].x, d * at[i].y - r * at[i].z, r * at[i].y + d * at[i].z};
    at[i] = sbri_add(to->center, sbri_vec3(c * x.x + s * x.z, x.y, c * x.z - s * x.x));
  }
}

static void add_bar(scene *s, uint32_t body, const lies *to, float young_pa, bool pinned) {
  lattice_box box = lattice_box_make((sbf_vec3){-0.5f * LENGTH, -0.5f * THICK, -0.5f * THICK},
      (sbf_vec3){LENGTH, THICK, THICK}, CELLS, 1, 1, 1000, young_pa, 0.3f);
  sbf_polygon_mesh bar = shape_bar(s->asset, CELLS, 1, LENGTH, THICK);
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)bar.positions.at;
  for (uint32_t i = 0; i < bar.positions.count; i++) at[i].x -= 0.5f * LENGTH;
  for (uint32_t i = 0; i < box.point_count; i++)
    if (pinned && fabsf(box.positions[i].x) > 0.49f * LENGTH) box.masses[i] = 0;
  put(at, bar.positions.count, to);
  put(box.positions, box.point_count, to);
  contact_scene_soft_box(s, body, &box, &bar);
  scene_body(s, body)->attributes.damping_ratio = 0.3f;
}

/* Positions of a body's vertices; those of the second character in the second character's frame. */
static void check(const scene *s, sbr_character_id who, uint32_t body, sbf_vec3 at[MAX]) {
  sbr_double3 o = sbr_character_get_origin(s->world, who),
              own = sbr_character_get_origin(s->world, s->character);
  uint32_t count = sbr_character_get_surface(s->world, who, body, at, MAX);
  for (uint32_t i = 0; i < count; i++)
    at[i] = sbri_add(at[i], sbri_vec3((float)(o.x - own.x), (float)(o.y - own.y), (float)(o.z - own.z)));
}

/* How deep edges of the one are in the other, m. */
static double deepest_edge(
    const sbf_polygon_mesh *one, const sbf_vec3 *at, const sbf_polygon_mesh *other, const sbf_vec3 *others) {
  double max = 0;
  const uint32_t *c = one->polygon_points.at;
  for (uint32_t p = 0; p < one->polygon_sizes.count; c += one->polygon_sizes.at[p++])
    for (uint32_t k = 0; k < one->polygon_sizes.at[p]; k++)
      for (int i = 0; i < PLACES; i++) {
        uint32_t to = (k + 1) % one->polygon_sizes.at[p];
        if (c[k] > c[to]) continue;
        sbf_vec3 x = sbri_lerp(at[c[k]], at[c[to]], (float)i / PLACES);
        max = fmax(max, skin_depth(other, others, x, UINT32_MAX));
      }
  return max;
}

static double deepest(
    const sbf_polygon_mesh *one, const sbf_vec3 *at, const sbf_polygon_mesh *other, const sbf_vec3 *others) {
  return fmax(deepest_edge(one, at, other, others), deepest_edge(other, others, one, at));
}

static double deepest_of_bars(const scene *s, sbr_character_id other, uint32_t body) {
  static sbf_vec3 a[MAX], b[MAX];
  const sbf_polygon_mesh *mesh = &s->asset->soft_bodies.at[0].surface;
  check(s, s->character, 0, a), check(s, other, body, b);
  return deepest(mesh, a, mesh, b);
}

/* ---- Dropped ---- */

typedef struct drop {
  float height, heading, roll;
  double may; /* m deep */
} drop;
static const float square = 1.5708f, askew = 1.0472f, on_edge = 0.7854f;
static const drop drops[] = {
    {0.2f, square, 0, 0.005},
    {0.5f, square, 0, 0.005},
    {1, square, 0, 0.005},
    {0.2f, askew, 0, 0.005},
    {0.5f, askew, 0, 0.005},
    {1, askew, 0, 0.005},
    {0.2f, square, on_edge, 0.01},
    {0.5f, square, on_edge, 0.01},
    {1, square, on_edge, 0.01},
    {0.2f, askew, on_edge, 0.01},
    {0.5f, askew, on_edge, 0.01},
    {1, askew, on_edge, 0.01},
};

static float far_of(const drop *d) {
  return d->roll != 0 ? 1.4143f * THICK : THICK;
}

static int ticks_until_hit(float height) {
  return (int)(60 * sqrtf(2 * height / 9.81f)) - 1;
}

/* One bar is pinned at its ends. They are parts of one character. No edge penetrates deeper than
 * `inner_thickness`, 1 cm, and contacts add no energy. */
START_TEST(falling_crossed_bars_do_not_pass_through)
{
  const drop *d = &drops[_i];
  scene s = contact_scene_begin((sbf_vec3){0, -9.81f, 0});
  scene_bodies(&s, 2);
  add_bar(&s, 0, &(lies){{0, 0, 0}, 0, d->roll}, 1e6f, true);
  add_bar(&s, 1, &(lies){{0.01f, d->height + far_of(d), 0.012f}, d->heading, d->roll}, 1e6f, false);
  contact_scene_start(&s);
  scene_ticks(&s, 1);
  double first = scene_energy_of(&s), max = 0;
  scene_ticks(&s, ticks_until_hit(d->height));
  for (int i = 0; i < 60; i++) {
    scene_ticks(&s, 1);
    ck_assert_double_le(scene_energy_of(&s), first);
    max = fmax(max, deepest_of_bars(&s, s.character, 1));
  }
  ck_assert_double_le(max, d->may);
  scene_free(&s);
}
END_TEST

/* For a second, neither penetrates the other by more than 2 mm. */
static void check_over_beam(scene *s, const sbf_polygon_mesh *hull, const sbf_vec3 *beam) {
  static sbf_vec3 at[MAX];
  double max = 0;
  for (int i = 0; i < 60; i++) {
    scene_ticks(s, 1);
    check(s, s->character, 0, at);
    max = fmax(max, deepest(&s->asset->soft_bodies.at[0].surface, at, hull, beam));
  }
  ck_assert_double_le(max, 0.002);
}

/* A kinematic rigid beam lies on its edge under one. */
START_TEST(bars_that_fall_across_a_rigid_edge_do_not_pass_through)
{
  static sbf_vec3 beam[8];
  const drop *d = &drops[_i];
  scene s = contact_scene_begin((sbf_vec3){0, -9.81f, 0});
  scene_bodies(&s, 1);
  add_bar(&s, 0, &(lies){{0.01f, d->height + 1.2072f * THICK, 0.012f}, d->heading, d->roll}, 1e6f, false);
  uint32_t number = rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){1, THICK, THICK}, 4);
  const sbf_polygon_mesh *hull = rigid_body(&s, number)->hull;
  rigid_body(&s, number)->motion = SBF_BODY_MOTION_KINEMATIC;
  put((sbf_vec3 *)(uintptr_t)hull->positions.at, hull->positions.count, &(lies){{0, 0, 0}, 0, on_edge});
  for (uint32_t i = 0; i < 8; i++) beam[i] = hull->positions.at[i];
  contact_scene_start(&s);
  scene_ticks(&s, ticks_until_hit(d->height));
  check_over_beam(&s, hull, beam);
  scene_free(&s);
}
END_TEST

/* The same beam as a box, a hull and a mesh of the host. */
START_TEST(bars_that_fall_across_a_collider_do_not_pass_through)
{
  static const uint32_t sides[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
      0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  static sbf_vec3 beam[8];
  const drop *d = &drops[_i % 12];
  scene s = rigid_begin(), of_beam = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  scene_bodies(&s, 1);
  add_bar(&s, 0, &(lies){{0.01f, d->height + 1.2072f * THICK, 0.012f}, d->heading, d->roll}, 1e6f, false);
  scene_start(&s);
  uint32_t number = rigid_box(&of_beam, (sbf_vec3){0, 0, 0}, (sbf_vec3){1, THICK, THICK}, 4);
  const sbf_polygon_mesh *hull = rigid_body(&of_beam, number)->hull;
  put((sbf_vec3 *)(uintptr_t)hull->positions.at, hull->positions.count, &(lies){{0, 0, 0}, 0, on_edge});
  for (uint32_t i = 0; i < 8; i++) beam[i] = hull->positions.at[i];
  sbr_shape_definition form = collision_box(0.5f, 0.5f * THICK, 0.5f * THICK);
  if (_i >= 12)
    form.kind = _i < 24 ? SBR_SHAPE_HULL : SBR_SHAPE_MESH, form.points = beam, form.point_count = 8;
  if (_i >= 24) form.triangles = sides, form.triangle_count = 12;
  sbr_shape *shape = collision_shape(form);
  sbr_collider_definition c = sbr_default_collider_definition();
  sbr_collider_id id;
  c.shape = shape;
  if (_i < 12) c.rotation = (sbf_quat){sinf(0.5f * on_edge), 0, 0, cosf(0.5f * on_edge)};
  ck_assert(sbr_collider_create(s.world, &c, &id, NULL) == SBF_OK);
  scene_ticks(&s, ticks_until_hit(d->height));
  check_over_beam(&s, hull, beam);
  scene_free(&s);
  scene_free(&of_beam);
  sbr_shape_destroy(shape);
}
END_TEST

/* A host's box, narrower than the bar's edges are long, lies between its vertices: the bar comes to rest on
 * it. */
START_TEST(a_bar_rests_across_a_narrow_box)
{
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  scene_bodies(&s, 1);
  add_bar(&s, 0, &(lies){{0.05f, 0.05f + 0.51f * THICK, 0}, 0, 0}, 1e6f, false);
  scene_start(&s);
  sbr_shape *shape = collision_shape(collision_box(0.04f, 0.05f, 0.1f));
  collision_collider(&s, shape, (sbr_double3){0.1, 0, 0});
  collision_collider(&s, shape, (sbr_double3){0, 0, 0});
  scene_ticks(&s, 240);
  ck_assert_double_le(contact_scene_fastest(&s, s.character), 1e-3);
  static sbf_vec3 at[MAX];
  check(&s, s.character, 0, at);
  for (uint32_t i = 0; i < scene_body(&s, 0)->surface.positions.count; i++)
    ck_assert_float_ge(at[i].y, 0.03f); /* its ends hang */
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

/* ---- Thrown ---- */

/* Two characters in the air: momentum is conserved, angular momentum within 2e-4 of its initial value,
 * because contact points slide within a tick. */
START_TEST(thrown_bars_conserve_momentum)
{
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  scene_bodies(&s, 1);
  add_bar(&s, 0, &(lies){{0, 0, 0}, 0, on_edge}, 1e6f, false);
  contact_scene_start(&s);
  sbr_character_definition d = s.character_definition;
  sbr_character_id other;
  d.position.x += 0.01, d.position.y += 0.15, d.position.z += 0.012, d.heading = askew;
  ck_assert(sbr_character_create(s.world, s.model, &d, &other, NULL) == SBF_OK);
  sbri_character *c = sbri_character_of(s.world, other);
  for (uint32_t slot = 0; slot < c->model->islands[0].free_count; slot++)
    sbri_velocities(c)[3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + SBRI_BLOCK + slot % SBRI_BLOCK] = -3;
  scene_momentum was = scene_momentum_of(&s);
  double max = 0;
  for (int i = 0; i < 40; i++) {
    scene_ticks(&s, 1);
    max = fmax(max, deepest_of_bars(&s, other, 0));
  }
  scene_momentum is = scene_momentum_of(&s);
  for (int k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(was.linear[k], is.linear[k], 1e-5 * 1.5 * was.mass);
    ck_assert_double_eq_tol(was.angular[k], is.angular[k], 2e-4 * 1.5 * was.mass * (double)LENGTH);
  }
  ck_assert_double_le(max, 0.01);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("find_edges");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, falling_crossed_bars_do_not_pass_through, 0, sizeof drops / sizeof *drops);
  tcase_add_loop_test(
      tests, bars_that_fall_across_a_rigid_edge_do_not_pass_through, 0, sizeof drops / sizeof *drops);
  tcase_add_loop_test(tests, bars_that_fall_across_a_collider_do_not_pass_through, 0, 36);
  tcase_add_test(tests, a_bar_rests_across_a_narrow_box);
  tcase_add_test(tests, thrown_bars_conserve_momentum);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
