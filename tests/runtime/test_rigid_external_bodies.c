/* Bodies of a host that rigid parts push within the tick: impulses on both sides are equal and opposite. */
#include "rigid/rigid_external_bodies.h"

#include <math.h>

#include "contact_scenes.h"
#include "harness.h"
#include "host_bodies.h"
#include "momentum.h"
#include "rigid_person.h"

static const double G = 9.81;

static scene weightless(void) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  s.character_definition.position.y = 1000;
  return s;
}

static host_body ball(scene *s, double mass, sbr_double3 at, double speed) {
  host_body b = host_body_make(s, collision_ball(0.1f), mass, NULL, 1, at);
  b.weight = 0, b.velocity[2] = speed;
  return b;
}

static void end(scene *s, host_body *b) {
  scene_free(s);
  sbr_shape_destroy(b->shape);
}

/* Of both, along z. */
static double sum_of(const scene *s, const host_body *b) {
  return scene_momentum_of(s).linear[2] + b->mass * b->velocity[2];
}

/* A ball strikes a box of 2 kg in its middle, like two rigid bodies. */
START_TEST(struck_in_the_middle)
{
  const double masses[5] = {0.02, 0.5, 2, 5, 200}, backs[3] = {0, 0.5, 0.8};
  double mass = masses[_i / 3], e = backs[_i % 3], u = 2, own = 2;
  scene s = weightless();
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, (float)own);
  rigid_body(&s, 0)->restitution = (float)e;
  scene_start(&s);
  host_body b = ball(&s, mass, (sbr_double3){0, 0, -0.43}, u);
  double all = mass * u;
  for (int i = 0; i < 60; i++) {
    host_body_go(&s, &b, 1, -10);
    ck_assert_double_eq_tol(sum_of(&s, &b), all, 2e-4 * all);
  }
  double after = (double)rigid_state(&s, 0).velocity.z, wanted = (1 + e) * mass * u / (mass + own);
  ck_assert_double_eq_tol(after, wanted, 0.01 * (1 + e) * mass * u / (mass + own));
  ck_assert_double_eq_tol(b.velocity[2], u - wanted * own / mass, 0.02 * u);
  end(&s, &b);
}
END_TEST

/* The same at the end of a rod, which also starts to rotate. Starts from several distances, so the impact is
 * anywhere in a tick. */
START_TEST(a_box_struck_at_an_end)
{
  const double mass = 1, own = 2, u = 3, length = 0.6, side = 0.1, off = 0.25, e = 0.5;
  scene s = weightless();
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){(float)length, (float)side, (float)side}, (float)own);
  rigid_body(&s, 0)->restitution = (float)e;
  scene_start(&s);
  host_body b = ball(&s, mass, (sbr_double3){off, 0, -0.3 - 0.01 * _i}, u);
  double moment = own * (length * length + side * side) / 12;
  double impulse = (1 + e) * u / (1 / mass + 1 / own + off * off / moment);
  for (int i = 0; i < 20; i++) {
    host_body_go(&s, &b, 1, -10);
    ck_assert_double_eq_tol(sum_of(&s, &b), mass * u, 2e-4 * mass * u);
    double turn = scene_momentum_of(&s).angular[1] - b.at[0] * mass * b.velocity[2] +
                  b.at[2] * mass * b.velocity[0] + b.inertia[1] * b.angular_velocity[1];
    ck_assert_double_eq_tol(turn, -off * mass * u, 2e-3 * off * mass * u);
  }
  ck_assert_double_eq_tol((double)rigid_state(&s, 0).velocity.z, impulse / own, 0.01 * impulse / own);
  ck_assert_double_eq_tol(b.velocity[2], u - impulse / mass, 0.01 * u);
  end(&s, &b);
}
END_TEST

/* A crate on a box on the ground. */
START_TEST(a_crate_rests_on_a_hull)
{
  const double masses[5] = {0.01, 0.3, 1, 5, 60};
  double mass = masses[_i % 5], scale = _i < 5 ? 1 : 2;
  scene s = rigid_begin();
  s.character_definition.scale = (float)scale;
  s.asset->environment.gravity = (sbf_vec3){0, -(float)G, 0};
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  rigid_box(&s, (sbf_vec3){0, 0.1f, 0}, (sbf_vec3){0.4f, 0.2f, 0.4f}, 2);
  scene_start(&s);
  host_body b =
      host_body_make(&s, collision_box(0.1f, 0.1f, 0.1f), mass, NULL, 1, (sbr_double3){0.05, 0.35, 0.02});
  host_body_go(&s, &b, 180, -10);
  double max = host_body_fastest(&s, &b, 60);
  ck_assert_double_lt(max, 1e-3);
  ck_assert_double_eq_tol(b.at[0], 0.05, 1e-3);
  ck_assert_double_eq_tol(b.at[1], 0.2 * scale + 0.1, 1e-3);
  end(&s, &b);
}
END_TEST

/* A plank over two boxes, more on one than on the other. */
START_TEST(two_hulls_carry_it_together)
{
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -(float)G, 0};
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  rigid_box(&s, (sbf_vec3){-0.3f, 0.1f, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  rigid_box(&s, (sbf_vec3){0.3f, 0.1f, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  scene_start(&s);
  host_body b = host_body_make(&s, collision_box(0.5f, 0.05f, 0.1f), 3, NULL, 1, (sbr_double3){0.1, 0.26, 0});
  host_body_go(&s, &b, 240, -10);
  double max = host_body_fastest(&s, &b, 60);
  ck_assert_double_lt(max, 1e-3);
  ck_assert_double_eq_tol(b.at[1], 0.25, 1e-3);
  end(&s, &b);
}
END_TEST

/* A ball of 5 kg hits a person of 14 parts in the air; joints transmit the impulse. */
START_TEST(a_ball_hits_a_person)
{
  scene s = person();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  s.world_definition.ground = sbr_ground_flat(-1000);
  s.character_definition.position.y = 1000;
  scene_start(&s);
  sbf_vec3 at = rigid_state(&s, (uint32_t)_i).center;
  host_body b = ball(&s, 5, (sbr_double3){(double)at.x, (double)at.y, (double)at.z - 0.6}, 4);
  double lost = 0;
  for (int i = 0; i < 40; i++) {
    host_body_go(&s, &b, 1, -10);
    lost = fmax(lost, fabs(sum_of(&s, &b) - 20));
  }
  ck_assert_double_lt(lost, 20 * 1e-3);
  ck_assert_double_lt(b.velocity[2], 3.6);
  end(&s, &b);
}
END_TEST

/* A person falls onto a light crate on the host's floor. The crate supports it, and moves only to the
 * side. */
START_TEST(a_person_falls_on_a_crate)
{
  scene s = person();
  scene_start(&s);
  sbf_vec3 at = rigid_state(&s, 0).center;
  host_body b = host_body_make(&s, collision_box(0.15f, 0.15f, 0.15f), 1, NULL, 1,
      (sbr_double3){(double)at.x, 0.15, (double)at.z + 0.4});
  person_shove(&s, 0, (sbf_vec3){0, 0, 40});
  double fastest = 0;
  for (int i = 0; i < 300; i++) {
    host_body_go(&s, &b, 1, 0.15);
    fastest = fmax(fastest, host_body_speed(&b));
  }
  ck_assert_double_lt(fastest, 10);
  ck_assert_float_lt(person_fastest(&s), 0.02f);
  end(&s, &b);
}
END_TEST

static scene tower(double below) {
  scene s = contact_scene_begin((sbf_vec3){0, -(float)G, 0});
  s.world_definition.ground = sbr_ground_flat(below);
  s.character_definition.position.y = -below;
  for (int i = 0; i < 3; i++)
    rigid_box(&s, (sbf_vec3){0, 0.1f + 0.21f * (float)i, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  contact_scene_start(&s);
  return s;
}

/* Stacked bodies press with their whole weight on the host's body below. */
START_TEST(a_tower_weighs)
{
  scene s = tower(-1000);
  sbr_shape *shape = collision_shape(collision_box(0.5f, 0.5f, 0.5f));
  sbr_collider_id id = collision_collider(&s, shape, (sbr_double3){0, -0.5, 0});
  double sum = 0;
  for (int i = 0; i < 240; i++) {
    scene_ticks(&s, 1);
    double push = (double)sbr_collider_take_impulse(s.world, id).impulse.y;
    if (i >= 180) sum += push;
  }
  ck_assert_double_eq_tol(sum, -3 * G, 0.01);
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

/* Both carry the load on it. */
START_TEST(a_crate_rests_on_a_tower)
{
  const double masses[3] = {0.1, 1, 5};
  scene s = tower(0);
  host_body b =
      host_body_make(&s, collision_box(0.1f, 0.1f, 0.1f), masses[_i], NULL, 1, (sbr_double3){0, 0.74, 0});
  host_body_go(&s, &b, 180, -10);
  ck_assert_double_lt(host_body_fastest(&s, &b, 900), 1e-3);
  for (uint32_t i = 0; i < 3; i++)
    ck_assert_float_eq_tol(rigid_state(&s, i).center.y, 0.1f + 0.2f * (float)i, 1e-3f);
  ck_assert_double_eq_tol(b.at[1], 0.7, 1e-3);
  end(&s, &b);
}
END_TEST

/* A light body of the host on its floor supports the tower. */
START_TEST(a_floor_carries_a_tower)
{
  scene s = tower(-1000);
  host_body b = host_body_make(&s, collision_box(0.5f, 0.5f, 0.5f), 0.5, NULL, 1, (sbr_double3){0, -0.5, 0});
  host_body_go(&s, &b, 240, -0.5);
  ck_assert_double_lt(host_body_speed(&b), 1e-3);
  ck_assert_float_eq_tol(rigid_state(&s, 2).center.y, 0.5f, 1e-3f);
  end(&s, &b);
}
END_TEST

/* A ball hits one of two boxes in contact: the momentum of all three is conserved. */
START_TEST(struck_boxes_strike_others)
{
  scene s = contact_scene_begin((sbf_vec3){0, 0, 0});
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 2);
  rigid_box(&s, (sbf_vec3){0, 0, 0.23f}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 2);
  contact_scene_start(&s);
  host_body b = ball(&s, 1, (sbr_double3){0.02, 0, -0.4}, 3);
  for (int i = 0; i < 40; i++) {
    host_body_go(&s, &b, 1, -10);
    ck_assert_double_eq_tol(sum_of(&s, &b), 3, 1e-3);
  }
  ck_assert_float_gt(rigid_state(&s, 1).velocity.z, 0.4f);
  end(&s, &b);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rigid_external_bodies");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, struck_in_the_middle, 0, 15);
  tcase_add_loop_test(tests, a_box_struck_at_an_end, 0, 6);
  tcase_add_loop_test(tests, a_crate_rests_on_a_hull, 0, 10);
  tcase_add_test(tests, two_hulls_carry_it_together);
  tcase_add_loop_test(tests, a_ball_hits_a_person, 0, 14);
  tcase_add_test(tests, a_person_falls_on_a_crate);
  tcase_add_test(tests, a_tower_weighs);
  tcase_add_loop_test(tests, a_crate_rests_on_a_tower, 0, 3);
  tcase_add_test(tests, a_floor_carries_a_tower);
  tcase_add_test(tests, struck_boxes_strike_others);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
