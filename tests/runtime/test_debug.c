/* A world's times by stage, and its counters. */
#include "sbrun/debug.h"

#include "sbfmt/codes.h"
#include "state/world.h"

#include "collision_scenes.h"
#include "harness.h"

/* A clock that goes on by a second whenever it is read. */
typedef struct counting_clock {
  double now_s;
} counting_clock;

static double count_on(void *user) {
  counting_clock *clock = user;
  return clock->now_s += 1;
}

static scene started(scene s) {
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  scene_body(&s, 0)->attributes.friction = 0.5f;
  scene_body(&s, 0)->attributes.stiffness_damping = 2e-3f;
  s.world_definition.sleep_after_s = 0.5;
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  scene_start(&s);
  return s;
}

/* A loose block of tetrahedra on the ground. */
static scene loose_block(void) {
  scene s = scene_begin();
  lattice_box box =
      lattice_box_make((sbf_vec3){-0.1f, 0, -0.1f}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 2, 2, 2, 1000, 2e4f, 0.4f);
  scene_bone(&s, (sbf_vec3){0, 0.1f, 0});
  scene_section(&s, 0, (sbf_vec3){0, 0.1f, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 3);
  scene_embed(&s, scene_lattice(&s, 0, &box), &box);
  lattice_box_free(&box);
  s.model_options.free = true;
  return started(s);
}

/* A box of springs that a bone holds off the ground. */
static scene held_box(void) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.3f, 0.2f, 0.4f}, 3);
  return started(s);
}

START_TEST(stages_run_in_order_and_add_up_to_the_tick)
{
  scene s = held_box();
  counting_clock clock = {100};
  ck_assert_uint_eq(sbr_world_get_profile(s.world).tick, 0);
  scene_ticks(&s, 2);
  ck_assert_uint_eq(sbr_world_get_profile(s.world).tick, 0);
  sbr_world_set_clock(s.world, (sbr_clock){count_on, &clock});
  scene_ticks(&s, 1);
  sbr_profile profile = sbr_world_get_profile(s.world);
  ck_assert_uint_eq(profile.tick, 3);
  ck_assert_double_eq(profile.whole.begin_s, 101);
  ck_assert_double_eq(profile.whole.duration_s, SBR_STAGE_COUNT);
  for (int i = 0; i < SBR_STAGE_COUNT; i++) {
    ck_assert_double_eq(profile.stages[i].begin_s, 101 + i);
    ck_assert_double_eq(profile.stages[i].duration_s, 1);
  }
  sbr_world_set_clock(s.world, (sbr_clock){NULL, NULL});
  scene_ticks(&s, 1);
  ck_assert_uint_eq(sbr_world_get_profile(s.world).tick, 0);
  ck_assert_double_eq(clock.now_s, 101 + SBR_STAGE_COUNT);
  scene_free(&s);
}
END_TEST

START_TEST(a_clock_changes_no_motion)
{
  scene with = loose_block(), without = loose_block();
  counting_clock clock = {0};
  sbr_world_set_clock(with.world, (sbr_clock){count_on, &clock});
  scene_ticks(&with, 60), scene_ticks(&without, 60);
  ck_assert_uint_eq(sbr_world_get_state_hash(with.world), sbr_world_get_state_hash(without.world));
  scene_free(&with), scene_free(&without);
}
END_TEST

START_TEST(counters_are_those_of_the_scene)
{
  scene s = loose_block();
  sbr_counters before = sbr_world_get_counters(s.world);
  ck_assert_uint_eq(before.character_count, 1);
  ck_assert_uint_eq(before.soft_body_count, 1);
  ck_assert_uint_eq(before.island_count, 1);
  ck_assert_uint_eq(before.point_count, 27);
  ck_assert_uint_eq(
      before.tetrahedron_count, s.asset->soft_bodies.at[0].levels.at[0].lattice.tetrahedra.count);
  ck_assert_uint_eq(before.collider_count, 0);
  ck_assert_uint_eq(before.contact_count, 0);
  ck_assert_uint_eq(before.element_visit_count, 0);
  sbr_shape *ball = collision_shape(collision_ball(0.1f));
  collision_collider(&s, ball, (sbr_double3){2, 0, 0});
  scene_ticks(&s, 30);
  sbr_counters lying = sbr_world_get_counters(s.world);
  ck_assert_uint_eq(lying.collider_count, 1);
  ck_assert_uint_gt(lying.contact_count, 0);
  ck_assert_uint_eq(lying.soft_body_awake_count, 1);
  ck_assert_uint_ge(lying.element_visit_count, 30);
  ck_assert_uint_gt(lying.memory_bytes, lying.state_bytes);
  scene_free(&s);
  sbr_shape_destroy(ball);
}
END_TEST

START_TEST(sleepers_are_not_awake)
{
  scene s = held_box();
  scene_ticks(&s, 1);
  ck_assert_uint_eq(sbr_world_get_counters(s.world).soft_body_awake_count, 1);
  scene_ticks(&s, 600);
  ck_assert_uint_eq(sbr_world_count_awake_bodies(s.world), 0);
  ck_assert_uint_eq(sbr_world_get_counters(s.world).soft_body_awake_count, 0);
  scene_free(&s);
}
END_TEST

/* The message about a world that is not valid. */
static const char *fault_of(const scene *s) {
  static sbf_diagnostic fault;
  ck_assert_int_eq(sbr_world_validate(s->world, &fault), SBF_FAILED);
  ck_assert_int_eq(fault.code, SBF_CODE_WORLD_INVALID);
  return fault.message;
}

START_TEST(broken_states_are_noticed)
{
  scene s = loose_block();
  scene_ticks(&s, 30);
  sbri_character *c = sbri_character_of(s.world, s.character);
  float x = sbri_positions(c)[3].x;
  sbri_positions(c)[3].x = NAN;
  ck_assert_str_eq(fault_of(&s), "character 0, island 0: a position of its points is not finite");
  sbri_positions(c)[3].x = x;
  sbri_velocities(c)[5] = INFINITY;
  ck_assert_str_eq(fault_of(&s), "character 0, island 0: a velocity of its points is not finite");
  sbri_velocities(c)[5] = 0;
  sbri_pose(c)[0].rotation.w += 1;
  ck_assert_str_eq(fault_of(&s), "character 0, frame 0: its rotation is not a unit quaternion");
  sbri_pose(c)[0].rotation.w -= 1;
  ck_assert_uint_gt(sbri_contact_counts(c)[0], 0);
  sbri_contacts(c)[c->model->bodies[0].contact.first].sample.slots[2] = 100000;
  ck_assert_str_eq(
      fault_of(&s), "character 0, soft body 0: a contact is on a point that is not in its island");
  sbri_contact_counts(c)[0] = UINT32_MAX;
  ck_assert_str_eq(fault_of(&s), "character 0, soft body 0: it has more contacts than its capacity");
  sbri_contact_counts(c)[0] = 0;
  ck_assert_int_eq(sbr_world_validate(s.world, NULL), SBF_OK);
  s.world->events.counts[1] = s.world->events.capacity + 1;
  ck_assert_str_eq(fault_of(&s), "world, events 1: there are more than the capacity");
  s.world->events.counts[1] = 0;
  scene_free(&s);
}
END_TEST

START_TEST(no_world_has_nothing)
{
  ck_assert_uint_eq(sbr_world_get_counters(NULL).memory_bytes, 0);
  ck_assert_uint_eq(sbr_world_get_profile(NULL).tick, 0);
  ck_assert_int_eq(sbr_world_validate(NULL, NULL), SBF_OK);
  sbr_world_set_clock(NULL, (sbr_clock){NULL, NULL});
  ck_assert_str_eq(sbr_stage_get_name(SBR_STAGE_ISLANDS), "islands");
  ck_assert_str_eq(sbr_stage_get_name(SBR_STAGE_COUNT), "");
}
END_TEST

int main(void) {
  Suite *suite = suite_create("debug");
  TCase *c = tcase_create("debug");
  tcase_add_test(c, stages_run_in_order_and_add_up_to_the_tick);
  tcase_add_test(c, a_clock_changes_no_motion);
  tcase_add_test(c, counters_are_those_of_the_scene);
  tcase_add_test(c, sleepers_are_not_awake);
  tcase_add_test(c, broken_states_are_noticed);
  tcase_add_test(c, no_world_has_nothing);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
