/* Impulses on a host's bodies: the total momentum of both sides is conserved. */
#include <math.h>

#include "collision_scenes.h"
#include "harness.h"
#include "momentum.h"
#include "rigid_scenes.h"

/* A body of the host that moves by the impulses on its collider. */
typedef struct external_body {
  sbr_shape *shape;
  sbr_collider_id id;
  double mass, at[3], velocity[3], angular_velocity[3]; /* kg, m, m/s, kg m^2/s about its middle */
} external_body;

static external_body external_body_of(
    scene *s, sbr_shape_definition form, double mass, sbr_double3 at, sbr_double3 velocity) {
  external_body g = {.shape = collision_shape(form), .mass = mass, .at = {at.x, at.y, at.z}};
  g.velocity[0] = velocity.x, g.velocity[1] = velocity.y, g.velocity[2] = velocity.z;
  sbr_collider_definition d = sbr_default_collider_definition();
  d.shape = g.shape, d.position = at, d.friction = 0.5f, d.restitution = 0;
  ck_assert(sbr_collider_create(s->world, &d, &g.id, NULL) == SBF_OK);
  return g;
}

/* Applies the impulse and moves the body by one tick. Rotation is left out: a ball looks the same, and a box
 * hardly rotates. */
static void external_body_tick(scene *s, external_body *g, double tick_s) {
  sbr_collider_move(s->world, g->id,
      (sbr_double3){g->at[0] + tick_s * g->velocity[0], g->at[1] + tick_s * g->velocity[1],
          g->at[2] + tick_s * g->velocity[2]},
      (sbf_quat){0, 0, 0, 1});
  scene_ticks(s, 1);
  sbr_collider_impulse push = sbr_collider_take_impulse(s->world, g->id);
  const float j[3] = {push.impulse.x, push.impulse.y, push.impulse.z},
              l[3] = {push.moment.x, push.moment.y, push.moment.z};
  for (int k = 0; k < 3; k++) {
    g->at[k] += tick_s * g->velocity[k];
    g->velocity[k] += (double)j[k] / g->mass;
    g->angular_velocity[k] += (double)l[k];
  }
}

static scene_momentum all_of(const scene *s, const external_body *g) {
  scene_momentum m = scene_momentum_of(s);
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    m.linear[k] += g->mass * g->velocity[k];
    m.angular[k] +=
        g->mass * (g->at[i] * g->velocity[j] - g->at[j] * g->velocity[i]) + g->angular_velocity[k];
  }
  return m;
}

/* Angular momentum has its own tolerance: the host moves a body once a tick, and impulses act at its position
 * at the end of the tick. */
static void assert_kept(const scene_momentum *is, const scene_momentum *was, double within, double turning) {
  for (int k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(is->linear[k], was->linear[k], within);
    ck_assert_double_eq_tol(is->angular[k], was->angular[k], turning);
  }
}

/* A cloth is struck by a ball, off its middle and from aside, by each scheme that follows the energy. */
START_TEST(a_ball_and_a_cloth_conserve_momentum)
{
  const sbf_scheme schemes[3] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN};
  scene s = scene_begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  s.character_definition.position = (sbr_double3){0, 1000, 0};
  collision_sheet(&s, 0, (sbf_vec3){0, 0.5f, 0}, 1, 12, false);
  s.model_options.scheme = schemes[_i];
  scene_start(&s);
  external_body g =
      external_body_of(&s, collision_ball(0.3f), 0.5, (sbr_double3){0.1, 0, 0.05}, (sbr_double3){1, 3, 0});
  scene_momentum before = all_of(&s, &g);
  for (int i = 0; i < 60; i++) external_body_tick(&s, &g, 1.0 / 60);
  scene_momentum after = all_of(&s, &g);
  ck_assert_double_lt(g.velocity[1], 2.9); /* it has given some of it away */
  ck_assert_double_gt(
      g.angular_velocity[2] * g.angular_velocity[2] + g.angular_velocity[0] * g.angular_velocity[0], 1e-8);
  assert_kept(&after, &before, 2e-5, 1e-3);
  scene_free(&s);
  sbr_shape_destroy(g.shape);
}
END_TEST

/* Two rigid boxes on a joint, thrown at the host's. */
START_TEST(boxes_conserve_momentum)
{
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  s.character_definition.position.y = 1000;
  rigid_box(&s, (sbf_vec3){0, 0.8f, 0.05f}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  rigid_box(&s, (sbf_vec3){0.3f, 0.8f, 0.05f}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 0.5f);
  rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, 0, 1, (sbf_vec3){0.15f, 0.8f, 0.05f}, (sbf_quat){0, 0, 0, 1});
  rigid_body(&s, 0)->restitution = _i ? 0.5f : 0;
  scene_start(&s);
  sbr_character_apply_rigid_impulse(
      s.world, s.character, 0, (sbr_double3){0, 0.8, 0.05}, (sbf_vec3){0.3f, -3, 0});
  external_body g = external_body_of(
      &s, collision_box(0.3f, 0.3f, 0.3f), 4, (sbr_double3){0, 0, 0}, (sbr_double3){0, 0, 0});
  scene_ticks(&s, 2);
  scene_momentum before = all_of(&s, &g);
  for (int i = 0; i < 40; i++) external_body_tick(&s, &g, 1.0 / 60);
  scene_momentum after = all_of(&s, &g);
  ck_assert_double_lt(g.velocity[1], -0.3);
  assert_kept(&after, &before, 1e-4, 5e-3);
  scene_free(&s);
  sbr_shape_destroy(g.shape);
}
END_TEST

/* Bodies at rest on it press with their weight, at any size, and also while they sleep. */
START_TEST(resting_bodies_press_with_their_weight)
{
  scene s = scene_begin();
  const sbf_vec3 at[2] = {{0.1f, 0.011f, 0}, {-0.1f, 0.011f, 0}};
  const float masses[2] = {1, 2}, scale = _i ? 2.0f : 1.0f;
  const sbf_uint2 ends[1] = {{{0, 1}}};
  const float stiffness[1] = {4000};
  sbf_level *level = scene_points(&s, 0, at, masses, 2);
  scene_springs(&s, level, ends, stiffness, 1);
  scene_body(&s, 0)->attributes.media_friction = 1;
  s.character_definition.position = (sbr_double3){0, 1000, 0};
  s.character_definition.scale = scale;
  s.world_definition.sleep_after_s = 0.3;
  scene_start(&s);
  external_body g =
      external_body_of(&s, collision_box(1, 1, 1), 1, (sbr_double3){0, -1, 0}, (sbr_double3){0, 0, 0});
  scene_ticks(&s, 50);
  bool slept = false;
  for (int i = 0; i < 60; i++) {
    (void)sbr_collider_take_impulse(s.world, g.id);
    scene_ticks(&s, 1);
    sbr_collider_impulse push = sbr_collider_take_impulse(s.world, g.id);
    float k = scale * scale * scale, weight = 3 * k * 9.81f / 60;
    ck_assert_float_eq_tol(push.impulse.y, -weight, 0.02f * weight);
    ck_assert_float_eq_tol(push.moment.z, 0.1f * scale * weight / 3, 0.02f * weight);
    slept = slept || sbr_world_count_awake_bodies(s.world) == 0;
  }
  ck_assert(slept);
  sbr_collider_impulse none = sbr_collider_take_impulse(s.world, g.id);
  ck_assert(none.impulse.y == 0 && none.moment.z == 0); /* it was asked already */
  sbr_character_set_paused(s.world, s.character, true);
  scene_ticks(&s, 5);
  ck_assert(sbr_collider_take_impulse(s.world, g.id).impulse.y == 0);
  ck_assert(sbr_collider_take_impulse(s.world, (sbr_collider_id){77}).impulse.y == 0);
  scene_free(&s);
  sbr_shape_destroy(g.shape);
}
END_TEST

enum { MANY = 11 }; /* and the ground makes twelve */

/* A body that lies on many bodies of the host at once pushes each of them. */
START_TEST(each_of_many_carries_its_part)
{
  scene s = scene_begin();
  sbf_vec3 at[MANY];
  float masses[MANY], stiffness[MANY - 1];
  sbf_uint2 ends[MANY - 1];
  external_body external_bodies[MANY];
  for (uint32_t i = 0; i < MANY; i++) {
    at[i] = (sbf_vec3){0.2f * (float)i, 0.011f, 0}, masses[i] = 1 + 0.1f * (float)i;
    if (i > 0) ends[i - 1] = (sbf_uint2){{i - 1, i}}, stiffness[i - 1] = 50;
  }
  sbf_level *level = scene_points(&s, 0, at, masses, MANY);
  scene_springs(&s, level, ends, stiffness, MANY - 1);
  scene_body(&s, 0)->attributes.media_friction = 1;
  s.character_definition.position = (sbr_double3){0, 1000, 0};
  scene_start(&s);
  for (uint32_t i = 0; i < MANY; i++)
    external_bodies[i] = external_body_of(&s, collision_box(0.05f, 0.05f, 0.05f), 1,
        (sbr_double3){(double)at[i].x, -0.05, 0}, (sbr_double3){0, 0, 0});
  scene_ticks(&s, 90);
  for (uint32_t i = 0; i < MANY; i++) (void)sbr_collider_take_impulse(s.world, external_bodies[i].id);
  scene_ticks(&s, 1);
  for (uint32_t i = 0; i < MANY; i++) {
    float weight = masses[i] * 9.81f / 60;
    ck_assert_float_eq_tol(
        sbr_collider_take_impulse(s.world, external_bodies[i].id).impulse.y, -weight, 0.02f * weight);
  }
  scene_free(&s);
  for (uint32_t i = 0; i < MANY; i++) sbr_shape_destroy(external_bodies[i].shape);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("collider_host");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, a_ball_and_a_cloth_conserve_momentum, 0, 3);
  tcase_add_loop_test(tests, boxes_conserve_momentum, 0, 2);
  tcase_add_loop_test(tests, resting_bodies_press_with_their_weight, 0, 2);
  tcase_add_test(tests, each_of_many_carries_its_part);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
