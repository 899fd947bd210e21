/* Blocks on slopes: below the angle of friction they stay, above it they slide as Coulomb says. */
#include <math.h>

#include "harness.h"
#include "scenes.h"
#include "shapes.h"

enum block_kind { TETRAHEDRA, EMBEDDED, SPRINGS, KINDS };
static const float WIDE = 0.3f, HIGH = 0.1f;

static void add_surface(scene *s) {
  sbf_polygon_mesh mesh = shape_cube(s->asset, 6, 1, (sbf_vec3){0, 0.5f, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)mesh.positions.at;
  for (uint32_t i = 0; i < mesh.positions.count; i++)
    at[i] = (sbf_vec3){at[i].x * WIDE, at[i].y * HIGH, at[i].z * WIDE};
  scene_body(s, 0)->surface = mesh;
}

/* A block of 100 kPa at the default damping ratio, flat on a slope: gravity is tilted instead of the ground.
 */
static scene begin_block(enum block_kind kind, sbf_scheme scheme, float friction, double angle) {
  scene s = scene_begin();
  sbf_attributes defaults;
  if (kind == SPRINGS) {
    scene_bone(&s, (sbf_vec3){0, 0, 0});
    scene_section(&s, 0, (sbf_vec3){0, 0.5f * HIGH, 0}, (sbf_vec3){WIDE, HIGH, WIDE}, 3);
  } else {
    lattice_box box = lattice_box_make(
        (sbf_vec3){-0.5f * WIDE, 0, -0.5f * WIDE}, (sbf_vec3){WIDE, HIGH, WIDE}, 4, 2, 4, 1000, 1e5f, 0.45f);
    sbf_level *level = scene_lattice(&s, 0, &box);
    if (kind == EMBEDDED) add_surface(&s), scene_embed(&s, level, &box);
    lattice_box_free(&box);
  }
  sbf_attributes_init(&defaults);
  scene_body(&s, 0)->attributes.damping_ratio = defaults.damping_ratio;
  scene_body(&s, 0)->attributes.friction = friction;
  s.model_options = sbr_default_model_options();
  s.model_options.scheme = scheme;
  scene_start_on_slope(&s, angle);
  return s;
}

static const sbf_scheme schemes[] = {SBF_SCHEME_AUTOMATIC, SBF_SCHEME_POSITION_BASED};
static const float coefficients[] = {0.2f, 0.4f, 0.6f, 0.8f, 1, 1.2f};
enum { SCHEMES = 2, COEFFICIENTS = 6 };

typedef struct slope_case {
  enum block_kind kind;
  sbf_scheme scheme;
  float friction;
} slope_case;

static slope_case slope_case_of(int i) {
  return (slope_case){
      (enum block_kind)(i % KINDS), schemes[i / KINDS % SCHEMES], coefficients[i / KINDS / SCHEMES]};
}

/* m in three seconds, from 1.5 s on; and m/s^2 over two of these. */
typedef struct slid {
  double speed, acceleration;
} slid;

static slid slide(slope_case which, double fraction) {
  scene s = begin_block(which.kind, which.scheme, which.friction, atan(fraction * (double)which.friction));
  scene_ticks(&s, 90);
  double first = scene_middle_x(&s, 0);
  scene_ticks(&s, 60);
  double second = scene_middle_x(&s, 0);
  scene_ticks(&s, 60);
  double third = scene_middle_x(&s, 0);
  scene_free(&s);
  return (slid){0.5 * (third - first), third - 2 * second + first};
}

START_TEST(a_block_sticks_within_the_friction_cone)
{
  static const double fractions[] = {0.8, 0.95};
  slope_case which = slope_case_of(_i);
  for (int k = 0; k < 2; k++) {
    double speed = slide(which, fractions[k]).speed;
    ck_assert_msg(fabs(speed) < 1e-3, "kind %d, scheme %d, friction %g, at %g of it: %g m/s", (int)which.kind,
        (int)which.scheme, (double)which.friction, fractions[k], speed);
  }
}
END_TEST

START_TEST(a_block_slides_by_coulombs_law)
{
  static const double fractions[] = {1.05, 1.2};
  slope_case which = slope_case_of(_i);
  for (int k = 0; k < 2; k++) {
    double friction = (double)which.friction, angle = atan(fractions[k] * friction);
    double right = SCENE_GRAVITY_M_S2 * (sin(angle) - friction * cos(angle)),
           found = slide(which, fractions[k]).acceleration;
    ck_assert_msg(fabs(found - right) < 0.02 * right,
        "kind %d, scheme %d, friction %g, at %g of it: %g of %g m/s^2", (int)which.kind, (int)which.scheme,
        friction, fractions[k], found, right);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("slide_damping");
  TCase *c = tcase_create("slide_damping");
  tcase_add_loop_test(c, a_block_sticks_within_the_friction_cone, 0, KINDS * SCHEMES * COEFFICIENTS);
  tcase_add_loop_test(c, a_block_slides_by_coulombs_law, 0, KINDS * SCHEMES * COEFFICIENTS);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
