/* Gas, medium, bending and fields: shapes against differences of their energies, bodies against closed forms.
 */
#include "soft/solvers/external_forces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "scenes.h"
#include "soft/solvers/surface_forces.h"
#include "state/world.h"

static const sbf_scheme schemes[] = {
    SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_HEUN};
enum { SCHEME_COUNT = 4, EXPLICIT_EULER = 2 };

static const sbf_vec3 fold[4] = {{0, 0, 0}, {1, 0.1f, 0}, {0.4f, 0.9f, 0.1f}, {0.6f, -0.8f, 0.3f}};

static float *number(sbf_vec3 *x, int i) {
  return i % 3 == 0 ? &x[i / 3].x : i % 3 == 1 ? &x[i / 3].y : &x[i / 3].z;
}

START_TEST(a_hinge_has_the_gradient_of_its_angle)
{
  sbf_vec3 x[4], gradients[4], sum = {0, 0, 0};
  memcpy(x, fold, sizeof x);
  sbri_hinge_shape shape = sbri_hinge_shape_of(x);
  sbri_compute_hinge_gradients(&shape, x, gradients);
  for (int i = 0; i < 12; i++) {
    const float step = 2e-3f;
    float kept = *number(x, i);
    *number(x, i) = kept + step;
    float high = sbri_hinge_shape_of(x).angle;
    *number(x, i) = kept - step;
    float low = sbri_hinge_shape_of(x).angle;
    *number(x, i) = kept;
    ck_assert_float_eq_tol(*number(gradients, i), (high - low) / (2 * step), 1e-3f);
  }
  for (int k = 0; k < 4; k++) sum = sbri_add(sum, gradients[k]);
  ck_assert_float_lt(sbri_length(sum), 1e-5f);
  const sbf_vec3 flat[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0}}, none[4] = {{0, 0, 0}};
  ck_assert_float_eq_tol(sbri_hinge_shape_of(flat).angle, 0, 1e-7f);
  shape = sbri_hinge_shape_of(none);
  sbri_compute_hinge_gradients(&shape, none, gradients);
  ck_assert_float_eq(gradients[0].x, 0);
}
END_TEST

/* A box with bent quads: the sum of the faces' gradients at a corner is the gradient of the volume. */
START_TEST(faces_have_the_gradient_of_the_volume)
{
  static const uint32_t quads[6][4] = {
      {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  sbf_vec3 x[8], gradients[8];
  for (int i = 0; i < 8; i++)
    x[i] = (sbf_vec3){(float)(i & 1) + 0.1f * (float)(i % 3), (float)(i >> 1 & 1) - 0.05f * (float)i,
        (float)(i >> 2) + 0.07f * (float)(i % 5)};
  memset(gradients, 0, sizeof gradients);
  for (int step = -1; step < 24; step++) {
    double volumes[2] = {0, 0};
    const float by = 1e-2f;
    for (int side = 0; side < 2; side++) {
      if (step >= 0) *number(x, step) += side ? by : -by;
      for (int f = 0; f < 6; f++) {
        sbf_vec3 c[4];
        for (int k = 0; k < 4; k++) c[k] = x[quads[f][k]];
        sbri_face_shape shape = sbri_face_shape_of(c);
        volumes[side] += sbri_face_volume(&shape, x[0]) / 6;
        for (int k = 0; k < 4 && step < 0 && side == 0; k++)
          gradients[quads[f][k]] = sbri_add(gradients[quads[f][k]], shape.gradients[k]);
      }
      if (step >= 0) *number(x, step) -= side ? by : -by;
    }
    if (step < 0)
      ck_assert_double_gt(volumes[0], 0.5);
    else
      ck_assert_float_eq_tol(*number(gradients, step), (float)((volumes[1] - volumes[0]) / (2 * by)), 2e-5f);
  }
  /* A triangle is a quad that repeats its first corner. */
  sbf_vec3 t[4] = {x[0], x[1], x[2], x[0]};
  sbri_face_shape shape = sbri_face_shape_of(t);
  sbf_vec3 third = sbri_scale(shape.area, 1.0f / 3);
  ck_assert_float_lt(sbri_length(sbri_sub(shape.gradients[1], third)), 1e-6f);
  ck_assert_float_lt(sbri_length(sbri_sub(sbri_add(shape.gradients[0], shape.gradients[3]), third)), 1e-6f);
}
END_TEST

/* A cube of springs along its edges with gas inside: at rest, the springs of stiffness k hold p times a
 * quarter of a side's area each: k (l - L) = p l^2 / 4 with p = p0 L^3 / l^3. */
static scene balloon(int scheme, float pressure) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0, 0});
  scene_section(&s, 0, (sbf_vec3){0, 0, 0}, (sbf_vec3){1, 1, 1}, 1);
  sbf_level *level = (sbf_level *)(uintptr_t)s.asset->soft_bodies.at[0].levels.at;
  static const float stiffness = 1000;
  level->pins.count = 0;
  level->springs.count = 1; /* the edges */
  ((sbf_spring_set *)(uintptr_t)level->springs.at)->stiffness = (sbf_f32_list){&stiffness, 1};
  level->positions.count = 8;
  sbf_attributes *is = &scene_body(&s, 0)->attributes;
  is->pressure_mode = SBF_PRESSURE_MODE_GAS;
  is->pressure = pressure;
  is->mass = 8;
  is->mass_damping = 3;
  s.model_options.scheme = schemes[scheme];
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  return s;
}

START_TEST(a_gas_swells_a_body_until_its_springs_balance_it)
{
  scene s = balloon(_i, 500);
  if (_i == EXPLICIT_EULER) s.model_options.substeps = 256;
  scene_start(&s);
  ck_assert_uint_eq(sbr_model_report_unsupported(s.model, NULL, NULL), 0);
  scene_ticks(&s, 600);
  double l = 1.1;
  for (int i = 0; i < 100; i++) l = 1 + 500 / l / 4 / 1000; /* k (l - 1) = p0 / (4 l) */
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert_float_eq_tol(health.volume_ratio, (float)(l * l * l), _i == 1 ? 0.01f : 2e-3f);
  double elastic = 12 * 500 * (l - 1) * (l - 1) - 500 * log(l * l * l);
  ck_assert_double_eq_tol(health.elastic_j, elastic, _i == 1 ? 0.5 : 0.1);
  scene_free(&s);
}
END_TEST

/* A bag of gas squashed to a thirtieth of its volume is a thousand times as stiff as at rest: its energy
 * becomes motion, and no more than there was. */
START_TEST(a_squashed_gas_is_stepped_as_finely_as_it_needs)
{
  scene s = balloon(0, 800);
  scene_body(&s, 0)->attributes.mass_damping = 0;
  scene_start(&s);
  sbri_point *at = sbri_positions(&s.world->characters[0]);
  for (int i = 0; i < 8; i++) at[i].y *= 0.03f;
  double before = sbr_character_get_body_health(s.world, s.character, 0).elastic_j;
  for (int i = 0; i < 120; i++) {
    scene_ticks(&s, 1);
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    double now = health.elastic_j + health.kinetic_j;
    ck_assert(health.finite);
    /* The pressure acts in the first tick. At the largest steps, energy varies by the motion in a step. */
    ck_assert_msg(now < (i == 0 ? 1.05 : 1.5) * before, "tick %d: %g of %g J", i, now, before);
    ck_assert(i > 0 || now > 0.95 * before);
  }
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, s.character, 0).recoveries, 0);
  scene_free(&s);
}
END_TEST

static void add_map(scene *s, sbf_weight_property property, const float *values, uint32_t count) {
  sbf_weight_map *map = sbf_asset_allocate(s->asset, 1, sizeof *map);
  float *kept = sbf_asset_allocate(s->asset, count, sizeof *kept);
  sbf_weight_map_init(map);
  map->property = property;
  map->values = (sbf_f32_list){memcpy(kept, values, count * sizeof *kept), count};
  scene_body(s, 0)->weight_maps = (sbf_weight_map_list){map, 1};
}

/* Half the pressure everywhere is a body of half the pressure; twice on one face, none on the one across,
 * pushes with twice the pressure on that face. */
START_TEST(maps_scale_the_pressure_face_by_face)
{
  float halves[8], sides[8], volumes[2];
  for (int i = 0; i < 8; i++) halves[i] = 0.5f;
  for (int n = 0; n < 2; n++) {
    scene s = balloon(0, n ? 600 : 300);
    if (n) add_map(&s, SBF_WEIGHT_PROPERTY_PRESSURE, halves, 8);
    scene_start(&s);
    scene_ticks(&s, 300);
    volumes[n] = sbr_character_get_body_health(s.world, s.character, 0).volume_ratio;
    scene_free(&s);
  }
  ck_assert_float_gt(volumes[0], 1.1f);
  ck_assert_float_eq_tol(volumes[1], volumes[0], 1e-5f);
  scene s = balloon(0, 50);
  for (int i = 0; i < 8; i++) sides[i] = s.asset->soft_bodies.at[0].surface.positions.at[i].x > 0 ? 2 : 0;
  add_map(&s, SBF_WEIGHT_PROPERTY_PRESSURE, sides, 8);
  scene_body(&s, 0)->attributes.mass_damping = 0;
  scene_start(&s);
  scene_ticks(&s, 1);
  float momentum = 0;
  const sbri_character *c = &s.world->characters[0];
  for (uint32_t i = 0; i < 8; i++) momentum += s.model->islands[0].masses[i] * sbri_velocities(c)[i];
  ck_assert_float_eq_tol(momentum, 2 * 50 / 60.0f, 0.02f);
  scene_free(&s);
}
END_TEST

/* It neither accelerates nor rotates by itself, though all its faces are bent. */
START_TEST(a_gas_conserves_momentum)
{
  scene s = balloon(0, 800);
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)s.asset->soft_bodies.at[0].surface.positions.at;
  sbf_vec3 *points = (sbf_vec3 *)(uintptr_t)s.asset->soft_bodies.at[0].levels.at[0].positions.at;
  for (int i = 0; i < 8; i++)
    at[i].x += 0.1f * (float)(i % 3), at[i].y -= 0.08f * (float)(i % 4), points[i] = at[i];
  static const float masses[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  ((sbf_level *)(uintptr_t)s.asset->soft_bodies.at[0].levels.at)->masses = (sbf_f32_list){masses, 8};
  scene_body(&s, 0)->attributes.mass_damping = 0;
  scene_start(&s);
  for (int i = 0; i < 100; i++) {
    scene_ticks(&s, 1);
    sbf_vec3 linear = {0, 0, 0}, angular = {0, 0, 0};
    float moving = 0;
    const sbri_character *c = &s.world->characters[0];
    for (int k = 0; k < 8; k++) { /* of 1 kg each */
      const sbri_point *p = &sbri_positions(c)[k];
      const float *of = sbri_velocities(c) + k;
      sbf_vec3 x = {p->x, p->y, p->z}, v = {of[0], of[SBRI_BLOCK], of[2 * SBRI_BLOCK]};
      linear = sbri_add(linear, v), angular = sbri_add(angular, sbri_cross(x, v));
      moving += sbri_length(v);
    }
    ck_assert_float_lt(sbri_length(linear), 1e-4f);
    ck_assert_float_lt(sbri_length(angular), 1e-4f);
    ck_assert(i != 10 || moving > 1);
  }
  scene_free(&s);
}
END_TEST

/* A fixed triangle and one that hangs on their shared edge, bent up at rest: its tip sinks until the hinge
 * supports its weight. */
START_TEST(a_sheet_bends_under_its_weight)
{
  scene s = scene_begin();
  sbf_vec3 positions[4] = {{0, 0, 0}, {0, 0, 1}, {-1, 0, 0.5f}, {1, 0.5f, 0.5f}};
  static const uint32_t sizes[2] = {3, 3}, corners[6] = {0, 2, 1, 0, 1, 3}, pinned[3] = {0, 1, 2};
  const sbf_uint2 ends[] = {{{0, 3}}, {{1, 3}}};
  const float stiffness[] = {4000, 4000}, masses[4] = {1, 1, 1, 1};
  sbf_level *level = scene_points(&s, 0, positions, masses, 4);
  scene_springs(&s, level, ends, stiffness, 2);
  scene_pin(&s, level, -1, pinned, 3);
  sbf_soft_body *body = scene_body(&s, 0);
  body->surface.positions = level->positions;
  body->surface.polygon_sizes = (sbf_u32_list){sizes, 2};
  body->surface.polygon_points = (sbf_u32_list){corners, 6};
  body->attributes.bending_stiffness = 20;
  body->attributes.mass_damping = 4;
  s.model_options.scheme = schemes[_i];
  if (_i == EXPLICIT_EULER) s.model_options.substeps = 512;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, -4, 0};
  scene_start(&s);
  ck_assert_uint_eq(s.model->bodies[0].elements.hinge_count, 1);
  ck_assert_uint_eq(sbr_model_report_unsupported(s.model, NULL, NULL), 0);
  scene_ticks(&s, 600);
  sbf_vec3 p = scene_point(&s, 0, 3);
  double areas = 0.5 + 0.5 * sqrt(1.25), k = 20 / areas, angle = atan2((double)p.y, (double)p.x);
  ck_assert_double_eq_tol(k * (atan2(0.5, 1) - angle), 4 * (double)p.x, 0.02);
  ck_assert_double_gt(atan2(0.5, 1) - angle, 0.15);
  scene_free(&s);
}
END_TEST

START_TEST(a_free_bending_sheet_conserves_momentum)
{
  scene s = scene_begin();
  sbf_vec3 positions[4] = {{0, 0, 0}, {1, 0, 0.2f}, {1, 0.3f, 1}, {0, 0, 1}}, moved[4];
  static const uint32_t sizes[2] = {3, 3}, corners[6] = {0, 2, 1, 0, 3, 2};
  const sbf_uint2 ends[] = {{{0, 1}}, {{1, 2}}, {{2, 3}}, {{3, 0}}, {{0, 2}}};
  const float stiffness[] = {500, 500, 500, 500, 500}, masses[4] = {1, 1, 1, 1};
  const float rest[] = {1.1f, 0.9f, 1, 1.2f, 1.3f};
  sbf_level *level = scene_points(&s, 0, positions, masses, 4);
  scene_springs(&s, level, ends, stiffness, 5);
  ((sbf_spring_set *)(uintptr_t)level->springs.at)->rest_lengths = (sbf_f32_list){rest, 5};
  sbf_soft_body *body = scene_body(&s, 0);
  body->surface.positions = level->positions;
  body->surface.polygon_sizes = (sbf_u32_list){sizes, 2};
  body->surface.polygon_points = (sbf_u32_list){corners, 6};
  body->attributes.bending_stiffness = 30;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  scene_ticks(&s, 300);
  scene_read(&s, 0, moved, 4);
  sbf_vec3 before = {0, 0, 0}, after = {0, 0, 0};
  for (int i = 0; i < 4; i++) before = sbri_add(before, positions[i]), after = sbri_add(after, moved[i]);
  ck_assert_float_lt(sbri_length(sbri_sub(before, after)), 1e-4f);
  scene_free(&s);
}
END_TEST

/* A flat plate falls until rho/2 v^2 A = m g. */
START_TEST(a_plate_falls_at_its_terminal_speed)
{
  scene s = scene_begin();
  sbf_vec3 positions[4] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  static const uint32_t sizes[1] = {4}, corners[4] = {0, 3, 2, 1};
  const sbf_uint2 ends[] = {{{0, 1}}, {{1, 2}}, {{2, 3}}, {{3, 0}}, {{0, 2}}, {{1, 3}}};
  const float stiffness[] = {500, 500, 500, 500, 500, 500}, masses[4] = {0.1f, 0.1f, 0.1f, 0.1f};
  sbf_level *level = scene_points(&s, 0, positions, masses, 4);
  scene_springs(&s, level, ends, stiffness, 6);
  sbf_soft_body *body = scene_body(&s, 0);
  body->surface.positions = level->positions;
  body->surface.polygon_sizes = (sbf_u32_list){sizes, 1};
  body->surface.polygon_points = (sbf_u32_list){corners, 4};
  s.asset->environment.media_density = 1.2f;
  s.asset->environment.wind = (sbf_vec3){0, 1, 0}; /* an updraught */
  s.model_options.scheme = schemes[_i];
  if (_i == EXPLICIT_EULER) body->attributes.stiffness_damping = 0.01f;
  scene_start(&s);
  ck_assert_uint_eq(sbr_model_report_unsupported(s.model, NULL, NULL), 0);
  scene_ticks(&s, 240);
  float y = scene_point(&s, 0, 0).y;
  scene_ticks(&s, 60);
  float speed = y - scene_point(&s, 0, 0).y;
  ck_assert_float_eq_tol(speed, sqrtf(0.4f * 9.81f * 2 / 1.2f) - 1, 0.01f);
  scene_free(&s);
}
END_TEST

START_TEST(fields_match_the_specification)
{
  const sbf_vec3 x = {2, 0, 0}, v = {0, 3, 0};
  sbf_force_field f;
  sbf_force_field_init(&f);
  f.strength = 6, f.falloff = 2, f.direction = (sbf_vec3){0, 0, 5}, f.position = (sbf_vec3){1, 0, 0};
  const struct {
    sbf_field_kind kind;
    sbf_vec3 expected;
  } cases[] = {{SBF_FIELD_KIND_UNIFORM, {0, 0, 1.5f}}, {SBF_FIELD_KIND_RADIAL, {1.5f, 0, 0}},
      {SBF_FIELD_KIND_VORTEX, {0, 1.5f, 0}}, {SBF_FIELD_KIND_DRAG, {0, -4.5f, 0}}};
  for (int i = 0; i < 4; i++) {
    f.kind = cases[i].kind;
    sbf_vec3 a = sbri_field_at(&f, x, v);
    ck_assert_float_lt(sbri_length(sbri_sub(a, cases[i].expected)), 1e-5f);
    f.radius = 0.5f;
    ck_assert_float_eq(sbri_length(sbri_field_at(&f, x, v)), 0);
    f.radius = 0;
  }
  f.kind = SBF_FIELD_KIND_RADIAL;
  ck_assert_float_eq(sbri_length(sbri_field_at(&f, f.position, v)), 0);
}
END_TEST

/* Uniform: falls that way. It stands in the anchor frame: turned with it. */
START_TEST(a_field_pulls_in_the_anchor_frame)
{
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {0.3f, 0, 0}};
  const float masses[] = {1, 2}, stiffness = 100;
  sbf_level *level = scene_points(&s, 0, positions, masses, 2);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &stiffness, 1);
  sbf_force_field *field = sbf_asset_allocate(s.asset, 1, sizeof *field);
  sbf_force_field_init(field);
  field->direction = (sbf_vec3){0, 0, 2}, field->strength = 3;
  s.asset->environment.fields = (sbf_force_field_list){field, 1};
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  s.character_definition.heading = 1.5707963f;
  s.model_options.scheme = schemes[_i];
  s.model_options.substeps = 32;
  scene_start(&s);
  sbf_vec3 before = scene_point(&s, 0, 0);
  scene_ticks(&s, 60);
  sbf_vec3 displacement = sbri_sub(scene_point(&s, 0, 0), before);
  ck_assert_float_eq_tol(displacement.x, 1.5f, 2e-3f); /* +Z turned left is +X */
  ck_assert_float_eq_tol(displacement.z, 0, 1e-4f);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("outer forces");
  TCase *c = tcase_create("outer forces");
  tcase_add_test(c, a_hinge_has_the_gradient_of_its_angle);
  tcase_add_test(c, faces_have_the_gradient_of_the_volume);
  tcase_add_loop_test(c, a_gas_swells_a_body_until_its_springs_balance_it, 0, SCHEME_COUNT);
  tcase_add_test(c, a_squashed_gas_is_stepped_as_finely_as_it_needs);
  tcase_add_test(c, maps_scale_the_pressure_face_by_face);
  tcase_add_test(c, a_gas_conserves_momentum);
  tcase_add_loop_test(c, a_sheet_bends_under_its_weight, 0, SCHEME_COUNT);
  tcase_add_test(c, a_free_bending_sheet_conserves_momentum);
  tcase_add_loop_test(c, a_plate_falls_at_its_terminal_speed, 0, SCHEME_COUNT);
  tcase_add_test(c, fields_match_the_specification);
  tcase_add_loop_test(c, a_field_pulls_in_the_anchor_frame, 0, SCHEME_COUNT);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
