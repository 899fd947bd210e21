/* Bodies of a host that soft tissue moves within the tick: they come to rest on it, and momentum is
 * conserved. */
#include "shapes/external_body.h"

#include <math.h>

#include "harness.h"
#include "host_bodies.h"
#include "momentum.h"
#include "sbrun/query.h"

static const double G = 9.81;

/* Bare points keep their radius as distance in contacts. */
static const float KEPT_M = 0.01f;

enum soft_kind { CUBE, MATTRESS }; /* 30 cm and 27 kg; 80 x 20 x 80 cm and 20 kg */

static void add_attached(scene *s, uint32_t body, enum soft_kind kind, float x, float young_pa) {
  lattice_box box = kind == MATTRESS ? lattice_box_make((sbf_vec3){x - 0.4f, 0, -0.4f},
                                           (sbf_vec3){0.8f, 0.2f, 0.8f}, 12, 3, 12, 160, young_pa, 0)
                                     : lattice_box_make((sbf_vec3){x - 0.15f, 0, -0.15f},
                                           (sbf_vec3){0.3f, 0.3f, 0.3f}, 6, 6, 6, 1000, young_pa, 0.3f);
  scene_lattice(s, body, &box);
  lattice_box_free(&box);
  scene_body(s, body)->attributes.damping_ratio = 0.3f;
  scene_body(s, body)->attributes.stiffness_damping = 0.01f;
}

static scene soft_scene_begin(void) {
  scene s = scene_begin();
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  return s;
}

static void end(scene *s, host_body *b) {
  scene_free(s);
  sbr_shape_destroy(b->shape);
}

/* Weightless: a ball of 0.1, 0.5, 1 and 27 kg strikes at 2 m/s, off the middle. */
START_TEST(momentum_is_conserved)
{
  const double masses[4] = {0.1, 0.5, 1, 27};
  double mass = masses[_i / 2];
  enum soft_kind kind = _i % 2 ? MATTRESS : CUBE;
  scene s = soft_scene_begin();
  add_attached(&s, 0, kind, 0, 20000);
  s.world_definition.ground = sbr_ground_flat(-1000);
  s.character_definition.position.y = 1000; /* above the ground */
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  host_body b = host_body_make(
      &s, collision_ball(0.1f), mass, NULL, 1, (sbr_double3){0.07, kind == MATTRESS ? 0.33 : 0.43, 0.02});
  b.weight = 0, b.velocity[0] = 0.5, b.velocity[1] = -2;
  for (int i = 0; i < 90; i++) {
    host_body_go(&s, &b, 1, -10);
    scene_momentum m = scene_momentum_of(&s);
    ck_assert_double_eq_tol(m.linear[0] + mass * b.velocity[0], mass * 0.5, 1e-4 * mass * 2);
    ck_assert_double_eq_tol(m.linear[1] + mass * b.velocity[1], mass * -2, 1e-4 * mass * 2);
    ck_assert_double_eq_tol(m.linear[2] + mass * b.velocity[2], 0, 1e-4 * mass * 2);
  }
  ck_assert_double_gt(b.velocity[1], mass > 20 ? -1.6 : -0.2); /* it has transferred its momentum */
  ck_assert_double_lt(b.velocity[1], 1);
  ck_assert_double_lt(host_body_speed(&b), sqrt(4.25));
  end(&s, &b);
}
END_TEST

/* Dropped from 10 cm: within five seconds it lies, as light as a thousandth of the cube or as heavy as that.
 */
START_TEST(dropped_bodies_come_to_rest)
{
  const double masses[6] = {0.027, 0.1, 0.5, 1, 5, 27};
  double mass = masses[_i / 2];
  enum soft_kind kind = _i % 2 ? MATTRESS : CUBE;
  scene s = soft_scene_begin();
  add_attached(&s, 0, kind, 0, mass < 2 ? 20000 : 100000);
  scene_start(&s);
  scene_ticks(&s, 60);
  double top = kind == MATTRESS ? 0.2 : 0.3;
  bool ball = mass < 2; /* heavy ones roll off */
  host_body b = host_body_make(&s, ball ? collision_ball(0.15f) : collision_box(0.125f, 0.05f, 0.125f), mass,
      NULL, 1, (sbr_double3){0.025, top + (ball ? 0.25 : 0.15), 0.025});
  host_body_go(&s, &b, 300, -10);
  ck_assert_double_lt(host_body_fastest(&s, &b, 60), 1e-3);
  ck_assert_double_gt(b.at[1], top - 0.08);
  end(&s, &b);
}
END_TEST

/* A plate of 100 kg over all of a mattress presses it in by m g h / (A E); of a character of twice the size,
 * of which lengths double and stiffness does, by a quarter of eight times that. */
START_TEST(weight_presses_as_it_should)
{
  float scale = _i ? 2 : 1;
  double mass = 100.0 * (double)(scale * scale * scale), height = 0.2 * (double)scale;
  scene s = soft_scene_begin();
  add_attached(&s, 0, MATTRESS, 0, 50000);
  s.character_definition.scale = scale;
  scene_start(&s);
  scene_ticks(&s, 120);
  host_body b = host_body_make(&s, collision_box(0.5f * scale, 0.05f * scale, 0.5f * scale), mass, NULL, 1,
      (sbr_double3){0, height + 0.05 * (double)scale, 0});
  host_body_go(&s, &b, 240, -10);
  double own = 0.5 * 160 * G * 0.04 / 50000; /* its sag under its own weight */
  double sinks = height - (b.at[1] - (0.05 + (double)KEPT_M) * (double)scale),
         wanted = (100 * G * 0.2 / (0.64 * 50000) + own) * (double)scale;
  ck_assert_double_eq_tol(sinks, wanted, 0.05 * wanted);
  ck_assert_double_lt(host_body_fastest(&s, &b, 60), 1e-3);
  end(&s, &b);
}
END_TEST

/* A light crate on the host's floor supports the cube. A free crate would move away. */
START_TEST(bodies_on_a_floor_carry_others)
{
  scene s = soft_scene_begin();
  add_attached(&s, 0, CUBE, 0, 50000);
  s.world_definition.ground = sbr_ground_flat(-1000);
  s.character_definition.position.y = 1000.25;
  scene_start(&s);
  host_body b = host_body_make(&s, collision_box(0.25f, 0.1f, 0.25f), 1, NULL, 1, (sbr_double3){0, 0.1, 0});
  float lowest = 1;
  for (int i = 0; i < 240; i++) {
    host_body_go(&s, &b, 1, 0.1);
    float bottom = scene_point(&s, 0, 150).y;
    lowest = bottom < lowest ? bottom : lowest;
  }
  ck_assert_float_gt(lowest, 0.2f);
  ck_assert_double_eq_tol(b.at[1], 0.1, 1e-3);
  ck_assert_float_eq_tol(scene_point(&s, 0, 150).y, 0.2f + KEPT_M, 0.002f);
  end(&s, &b);
}
END_TEST

/* A plank lies over two cubes, more on one than on the other; as one collider and as two. */
START_TEST(several_bodies_carry_it_together)
{
  const sbf_vec3 arms[HOST_BODY_PARTS] = {{-0.3f, 0, 0}, {0.3f, 0, 0}};
  scene s = soft_scene_begin();
  scene_bodies(&s, 2);
  add_attached(&s, 0, CUBE, -0.3f, 20000);
  add_attached(&s, 1, CUBE, 0.3f, 20000);
  scene_start(&s);
  scene_ticks(&s, 60);
  host_body b =
      _i ? host_body_make(&s, collision_box(0.3f, 0.05f, 0.1f), 0.5, arms, 2, (sbr_double3){0.1, 0.36, 0})
         : host_body_make(&s, collision_box(0.6f, 0.05f, 0.1f), 0.5, NULL, 1, (sbr_double3){0.1, 0.36, 0});
  for (int k = 0; k < 3; k++) b.inertia[k] = k ? 0.06 : 0.002;
  host_body_go(&s, &b, 300, -10);
  ck_assert_double_lt(host_body_fastest(&s, &b, 60), 1e-3);
  ck_assert_double_eq_tol(b.at[1], 0.34, 0.001); /* 1 cm over them, which it presses in by as much */
  ck_assert_float_lt(fabsf(b.rotation.z), 0.02f);
  end(&s, &b);
}
END_TEST

/* Without an update for some ticks it continues its motion, and falls. */
START_TEST(without_new_commands_it_continues)
{
  scene s = soft_scene_begin();
  add_attached(&s, 0, CUBE, 0, 20000);
  scene_start(&s);
  host_body b = host_body_make(&s, collision_ball(0.1f), 0.5, NULL, 1, (sbr_double3){0, 5, 0});
  b.velocity[0] = 1;
  host_body_tell(&s, &b);
  scene_ticks(&s, 60);
  sbr_hit hit;
  ck_assert(sbr_world_cast_ray(s.world, (sbr_double3){59.0 / 60, 4, 0}, (sbf_vec3){0, -1, 0}, 4, NULL, &hit));
  ck_assert_double_eq_tol(hit.position.y, 5 - G / 2 + 0.1, 0.1);
  end(&s, &b);
}
END_TEST

START_TEST(bad_ones_are_refused)
{
  scene s = soft_scene_begin();
  add_attached(&s, 0, CUBE, 0, 20000);
  scene_start(&s);
  sbr_shape *shape = collision_shape(collision_ball(0.1f));
  sbf_diagnostic error;
  for (int i = 0; i < 6; i++) {
    sbr_collider_definition d = sbr_default_collider_definition();
    sbr_collider_id id;
    d.shape = shape;
    if (i == 0) d.mass = -1;
    if (i == 1) d.mass = NAN;
    if (i == 2) d.mass = 1, d.inertia.y = -1;
    if (i == 3) d.mass = 1, d.centre.z = INFINITY;
    if (i == 4) d.part_of = (sbr_collider_id){77};
    if (i == 5) {
      ck_assert(sbr_collider_create(s.world, &d, &d.part_of, NULL) == SBF_OK); /* it has no mass */
    }
    ck_assert(sbr_collider_create(s.world, &d, &id, &error) == SBF_FAILED);
    ck_assert_uint_eq(id.value, 0);
  }
  host_body b = host_body_make(&s, collision_ball(0.1f), 0.5, NULL, 1, (sbr_double3){0, 0.4, 0});
  sbr_collider_motion bad = {.position = {0, 1, 0}, .rotation = {0, 0, 0, 1}, .velocity = {NAN, 0, 0}};
  sbr_collider_set_motion(s.world, b.ids[0], &bad);
  sbr_collider_set_motion(s.world, b.ids[0], NULL);
  sbr_collider_set_motion(s.world, (sbr_collider_id){999}, &bad);
  host_body_go(&s, &b, 60, -10);
  ck_assert_double_gt(b.at[1], 0.3);
  end(&s, &b);
  sbr_shape_destroy(shape);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("external_body");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, momentum_is_conserved, 0, 8);
  tcase_add_loop_test(tests, dropped_bodies_come_to_rest, 0, HARNESS_FEW(12, 2));
  tcase_add_loop_test(tests, weight_presses_as_it_should, 0, HARNESS_FEW(2, 1));
  tcase_add_test(tests, bodies_on_a_floor_carry_others);
  tcase_add_loop_test(tests, several_bodies_carry_it_together, 0, 2);
  tcase_add_test(tests, without_new_commands_it_continues);
  tcase_add_test(tests, bad_ones_are_refused);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
