/* Bricks of preset materials on slopes, of coarse to fine cells, flat and on edge, and balls with a flat:
 * below the angle of friction they rest, above it they slide as Coulomb says. */
#include <math.h>

#include "harness.h"
#include "scenes.h"
#include "shapes.h"

/* Maximum speed at rest, m/s, and error of acceleration as a fraction of gravity. */
static const double max_speed_m_s = 1e-3, max_error = 1e-3;

/* As in spec/sbf.materials. */
typedef struct slope_material {
  const char *name;
  float density, young_pa, damping_ratio;
} slope_material;
static const slope_material rubber = {"rubber", 930, 1.2e6f, 0.05f}, fat = {"fat", 920, 4000, 0.3f},
                            muscle = {"muscle", 1060, 30000, 0.2f}, jelly = {"jelly", 1020, 3000, 0.06f};
static const float poisson_ratio = 0.48f;

typedef struct slope_brick {
  const slope_material *material;
  sbf_vec3 size;
  uint32_t cells[3];
  bool embedded; /* carries a surface whose vertices are the contact points */
  bool round;    /* the upper part is a ball */
} slope_brick;

static const slope_brick bricks[] = {
    {&rubber, {0.12f, 0.03f, 0.12f}, {4, 1, 4}, false, false},
    {&rubber, {0.12f, 0.03f, 0.12f}, {8, 2, 8}, true, false},
    {&muscle, {0.12f, 0.03f, 0.12f}, {8, 2, 8}, false, false},
    {&muscle, {0.12f, 0.03f, 0.12f}, {12, 3, 12}, true, false},
    {&fat, {0.12f, 0.03f, 0.12f}, {8, 2, 8}, true, false},
    {&fat, {0.12f, 0.03f, 0.12f}, {12, 3, 12}, false, false},
    {&jelly, {0.06f, 0.015f, 0.06f}, {8, 2, 8}, true, false},
    {&jelly, {0.06f, 0.015f, 0.06f}, {12, 3, 12}, false, false},
    {&muscle, {0.1f, 0.05f, 0.12f}, {6, 3, 6}, true, false},
    {&rubber, {0.03f, 0.02f, 0.12f}, {2, 2, 8}, false, false}, /* a slab on its edge */
    {&muscle, {0.1f, 0.04f, 0.1f}, {6, 3, 6}, false, true},
};
enum { BRICKS = sizeof bricks / sizeof bricks[0] };
static const double coefficients[] = {0.3, 0.6, 1};
static const double fractions[] = {0.5, 0.8, 0.95, 1.05, 1.3};

/* Rounds the sides of the box, whose middle is on the y axis, into a ball with a flat lower part. */
static void make_round(lattice_box *box, sbf_vec3 size) {
  for (uint32_t i = 0; i < box->point_count; i++) {
    sbf_vec3 *at = &box->positions[i];
    double x = 2 * (double)(at->x / size.x), z = 2 * (double)(at->z / size.z), y = (double)(at->y / size.y);
    double out = fmax(fabs(x), fabs(z)), length = sqrt(x * x + z * z);
    double circle = length > 0 ? out / length : 1, width = sqrt(1 - 0.6 * (y - 0.4) * (y - 0.4) / 0.36);
    at->x = (float)(0.5 * (double)size.x * x * circle * width);
    at->z = (float)(0.5 * (double)size.z * z * circle * width);
  }
}

static void add_surface(scene *s, sbf_vec3 size) {
  sbf_polygon_mesh mesh = shape_cube(s->asset, 6, 1, (sbf_vec3){0, 0.5f, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)mesh.positions.at;
  for (uint32_t i = 0; i < mesh.positions.count; i++)
    at[i] = (sbf_vec3){at[i].x * size.x, at[i].y * size.y, at[i].z * size.z};
  scene_body(s, 0)->surface = mesh;
}

/* Flat on the slope: gravity is tilted instead of the ground. */
static scene begin_brick(const slope_brick *brick, double friction, double angle) {
  scene s = scene_begin();
  const slope_material *is = brick->material;
  sbf_vec3 size = brick->size;
  lattice_box box = lattice_box_make((sbf_vec3){-0.5f * size.x, 0, -0.5f * size.z}, size, brick->cells[0],
      brick->cells[1], brick->cells[2], is->density, is->young_pa, poisson_ratio);
  if (brick->round) make_round(&box, size);
  sbf_level *level = scene_lattice(&s, 0, &box);
  if (brick->embedded) add_surface(&s, size), scene_embed(&s, level, &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = is->damping_ratio;
  scene_body(&s, 0)->attributes.friction = (float)friction;
  s.model_options = sbr_default_model_options();
  scene_start_on_slope(&s, angle);
  return s;
}

START_TEST(a_brick_follows_coulombs_law)
{
  const slope_brick *brick = &bricks[_i % BRICKS];
  double friction = coefficients[_i / BRICKS];
  for (int k = 0; k < 5; k++) {
    double angle = atan(fractions[k] * friction);
    scene s = begin_brick(brick, friction, angle);
    scene_ticks(&s, 90);
    double first = scene_middle_x(&s, 0);
    scene_ticks(&s, 30);
    double second = scene_middle_x(&s, 0);
    scene_ticks(&s, 30);
    double third = scene_middle_x(&s, 0), speed = 2 * (third - second),
           acceleration = 4 * (third - 2 * second + first);
    scene_free(&s);
    if (fractions[k] < 1)
      ck_assert_msg(fabs(speed) < max_speed_m_s, "%s (%d), friction %g, at %g of it: %g m/s",
          brick->material->name, _i % BRICKS, friction, fractions[k], speed);
    double right = SCENE_GRAVITY_M_S2 * (sin(angle) - friction * cos(angle)),
           error = (acceleration - right) / SCENE_GRAVITY_M_S2;
    if (fractions[k] > 1)
      ck_assert_msg(fabs(error) < max_error, "%s (%d), friction %g, at %g of it: wrong by %g g",
          brick->material->name, _i % BRICKS, friction, fractions[k], error);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("slope_matrix");
  TCase *c = tcase_create("slope_matrix");
  tcase_add_loop_test(c, a_brick_follows_coulombs_law, 0, BRICKS * 3);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
