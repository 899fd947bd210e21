/* Soft bodies exert forces on the rigid bodies that they are pinned to. Compared with closed forms. */
#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "host_threads.h"
#include "momentum.h"
#include "rigid_scenes.h"
#include "state/state.h"
#include "state/world.h"

static const double PI = 3.14159265358979;

static scene weightless(void) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  scene_bodies(&s, 1);
  return s;
}

/* A block of soft tissue of that mass; each end is pinned to a box. */
static scene dumbbell(float soft_kg, float rigid_kg, float damping_ratio) {
  scene s = weightless();
  lattice_box box = lattice_box_make(
      (sbf_vec3){-0.2f, -0.05f, -0.05f}, (sbf_vec3){0.4f, 0.1f, 0.1f}, 8, 2, 2, soft_kg / 0.004f, 3e4f, 0.4f);
  sbf_level *level = scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->attributes.damping_ratio = damping_ratio;
  for (int end = 0; end < 2; end++) {
    float x = end ? 0.22f : -0.22f;
    uint32_t body = rigid_box(&s, (sbf_vec3){x, 0, 0}, (sbf_vec3){0.08f, 0.12f, 0.12f}, rigid_kg), points[9];
    for (uint32_t i = 0; i < 9; i++) points[i] = lattice_box_point(&box, end ? 8 : 0, i % 3, i / 3);
    rigid_pin(&s, level, (uint32_t)end, (int32_t)body, points, 9);
  }
  lattice_box_free(&box);
  return s;
}

/* An impulse on one end, off its middle: total momentum is conserved, whichever part is heavier. */
static const struct {
  float soft_kg, rigid_kg, damping_ratio;
} dumbbells[] = {{1, 1, 0}, {1, 1, 0.2f}, {0.1f, 10, 0.05f}, {10, 0.1f, 0.05f}, {100, 0.1f, 0.05f}};

START_TEST(a_hit_conserves_momentum)
{
  scene s = dumbbell(dumbbells[_i].soft_kg, dumbbells[_i].rigid_kg, dumbbells[_i].damping_ratio);
  scene_start(&s);
  float whole = dumbbells[_i].soft_kg + 2 * dumbbells[_i].rigid_kg;
  float kg = dumbbells[_i].rigid_kg; /* at some 2 m/s */
  sbf_vec3 impulse = {0.9f * kg, 1.5f * kg, 0.3f * kg};
  rigid_push(&s, 0, (sbf_vec3){0, 0, 0.05f}, impulse);
  scene_momentum first = scene_momentum_of(&s);
  ck_assert_double_eq_tol(first.linear[1], (double)impulse.y, 1e-5 * (double)whole);
  for (int second = 0; second < 5; second++) {
    scene_ticks(&s, 60);
    scene_momentum now = scene_momentum_of(&s);
    for (int k = 0; k < 3; k++) {
      ck_assert_double_eq_tol(now.linear[k], first.linear[k], 2e-5 * (double)whole);
      ck_assert_double_eq_tol(now.angular[k], first.angular[k], 2e-4 * (double)whole);
    }
  }
  sbf_vec3 other = rigid_state(&s, 1).velocity; /* which has received the impulse */
  ck_assert_float_ge(fabsf(other.x) + fabsf(other.y), 0.1f * impulse.y / whole);
  scene_free(&s);
}
END_TEST

/* Undamped, with the impulse above and with ten times that: about 20 m/s, faster than sound in such soft
 * tissue. Compressed elements and the speed limit take energy. Neither may treat the bones as infinitely
 * heavy, or the motion would gain energy. */
static const struct {
  float soft_kg, rigid_kg, times;
  int ticks;
} hard_hits[] = {{1, 1, 1, 540}, {0.1f, 10, 1, 540}, {1, 1, 10, 300}, {0.1f, 10, 10, 90}, {10, 0.1f, 10, 300},
    {100, 0.1f, 10, 300}};

START_TEST(a_hard_hit_swings_nothing_up)
{
  scene s = dumbbell(hard_hits[_i].soft_kg, hard_hits[_i].rigid_kg, 0);
  scene_start(&s);
  float kg = hard_hits[_i].times * hard_hits[_i].rigid_kg;
  rigid_push(&s, 0, (sbf_vec3){0, 0, 0.05f}, (sbf_vec3){0.9f * kg, 1.5f * kg, 0.3f * kg});
  double first = scene_energy_of(&s);
  scene_momentum before = scene_momentum_of(&s);
  for (int t = 0; t < hard_hits[_i].ticks; t++) {
    sbr_world_tick(s.world);
    double now = scene_energy_of(&s);
    ck_assert_msg(now < 1.04 * first, "tick %d: %g J of %g", t, now, first);
  }
  scene_momentum after = scene_momentum_of(&s);
  for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(after.linear[k], before.linear[k], 1e-3 * (double)kg);
  scene_free(&s);
}
END_TEST

/* Points between two boxes, each on springs to four points of each box. The boxes receive the opposite of the
 * springs' and dampers' forces on the points. */
START_TEST(springs_conserve_momentum)
{
  enum { HELD = 8, FREE = 3 };
  scene s = weightless();
  sbf_vec3 at[HELD + FREE];
  float points_kg[HELD + FREE] = {0}, k[HELD * FREE];
  sbf_uint2 ends[HELD * FREE];
  uint32_t count = 0, pinned[2][4];
  for (uint32_t i = 0; i < HELD; i++)
    at[i] = (sbf_vec3){i < 4 ? -0.2f : 0.2f, i & 1 ? 0.06f : -0.06f, i & 2 ? 0.06f : -0.06f},
    pinned[i / 4][i % 4] = i;
  for (uint32_t i = 0; i < FREE; i++)
    at[HELD + i] = (sbf_vec3){0.01f * (float)i, 0.05f * (float)i - 0.05f, 0.02f}, points_kg[HELD + i] = 0.3f;
  for (uint32_t i = 0; i < HELD * FREE; i++)
    ends[count] = (sbf_uint2){{i / FREE, HELD + i % FREE}}, k[count++] = 40;
  sbf_level *level = scene_points(&s, 0, at, points_kg, HELD + FREE);
  scene_springs(&s, level, ends, k, count);
  scene_body(&s, 0)->attributes.stiffness_damping = _i ? 0.02f : 0;
  for (uint32_t end = 0; end < 2; end++) {
    float x = end ? 0.22f : -0.22f;
    uint32_t body = rigid_box(&s, (sbf_vec3){x, 0, 0}, (sbf_vec3){0.08f, 0.12f, 0.12f}, 1);
    rigid_pin(&s, level, end, (int32_t)body, pinned[end], 4);
  }
  scene_start(&s);
  rigid_push(&s, 0, (sbf_vec3){0, 0, 0.05f}, (sbf_vec3){0.09f, 0.15f, 0.03f});
  scene_momentum first = scene_momentum_of(&s);
  for (int second = 0; second < 5; second++) {
    scene_ticks(&s, 60);
    scene_momentum now = scene_momentum_of(&s);
    for (int i = 0; i < 3; i++) {
      ck_assert_double_eq_tol(now.linear[i], first.linear[i], 5e-5);
      ck_assert_double_eq_tol(now.angular[i], first.angular[i], 5e-4);
    }
  }
  ck_assert_float_ge(fabsf(rigid_state(&s, 1).velocity.y), 0.02f);
  scene_free(&s);
}
END_TEST

/* ---- Periods and sag ---- */

/* The time from one upward passing of `level` to the tenth after it, over ten. */
static double period_of(scene *s, uint32_t body, float level) {
  double first = -1, last = -1;
  int passed = 0;
  float before = rigid_state(s, body).center.y;
  for (int i = 1; i < 2400 && passed < 11; i++) {
    sbr_world_tick(s->world);
    float now = rigid_state(s, body).center.y;
    if (before < level && now >= level) {
      last = ((double)i - 1 + (double)((level - before) / (now - before))) / 60;
      if (first < 0) first = last;
      passed++;
    }
    before = now;
  }
  ck_assert_int_eq(passed, 11);
  return (last - first) / 10;
}

/* A mass on two springs in a row with a light point between them: 2 pi sqrt((M + m/4) / (k/2)). */
START_TEST(a_mass_swings_on_a_soft_spring)
{
  static const float masses[3] = {0.2f, 1, 50}, stiffness[3] = {40, 40, 4000};
  scene s = weightless();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  const sbf_vec3 at[3] = {{0, 2, 0}, {0, 1, 0}, {0, 0, 0}};
  const float points_kg[3] = {0, 0.02f, 0};
  const sbf_uint2 ends[2] = {{{0, 1}}, {{1, 2}}};
  const float k[2] = {2 * stiffness[_i], 2 * stiffness[_i]};
  sbf_level *level = scene_points(&s, 0, at, points_kg, 3);
  scene_springs(&s, level, ends, k, 2);
  const uint32_t top = 0, bottom = 2;
  uint32_t body = rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, masses[_i]);
  rigid_pin(&s, level, 0, -1, &top, 1);
  rigid_pin(&s, level, 1, (int32_t)body, &bottom, 1);
  scene_start(&s);
  float sag = (masses[_i] * 9.81f + 0.01f * 9.81f) / stiffness[_i];
  double expected = 2 * PI * sqrt((double)(masses[_i] + 0.005f) / (double)stiffness[_i]);
  double found = period_of(&s, body, -sag);
  ck_assert_double_eq_tol(found, expected, 0.003 * expected);
  scene_free(&s);
}
END_TEST

/* A point and a body on the two ends of a spring, nothing else: 2 pi sqrt(m M / (m + M) / k). */
START_TEST(both_ends_of_a_spring_swing)
{
  static const float soft[3] = {0.1f, 1, 10};
  scene s = weightless();
  const sbf_vec3 at[2] = {{0, 0, 0}, {0, 1, 0}};
  const float points_kg[2] = {0, soft[_i]};
  const sbf_uint2 ends[1] = {{{0, 1}}};
  const float k[1] = {50};
  const uint32_t bottom = 0;
  sbf_level *level = scene_points(&s, 0, at, points_kg, 2);
  scene_springs(&s, level, ends, k, 1);
  uint32_t body = rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  rigid_pin(&s, level, 0, (int32_t)body, &bottom, 1);
  scene_start(&s);
  rigid_push(&s, body, (sbf_vec3){0, 0, 0}, (sbf_vec3){0, 0.05f, 0});
  sbri_character *c = sbri_character_of(s.world, s.character);
  sbri_velocities(c)[SBRI_BLOCK] = -0.05f / soft[_i]; /* all of it stands */
  double expected = 2 * PI * sqrt((double)(soft[_i] / (soft[_i] + 1) / 50));
  double found = period_of(&s, body, 0);
  ck_assert_double_eq_tol(found, expected, 0.005 * expected);
  scene_free(&s);
}
END_TEST

/* A load on a column of soft tissue whose lower end is fixed: compressed by (load + half its own weight) L /
 * (E A). */
START_TEST(a_load_presses_a_column)
{
  static const float loads[3] = {0.05f, 1, 10};
  scene s = weightless();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  const float young = loads[_i] * 3e5f, side = 0.1f, length = 0.2f, soft_kg = 0.5f;
  lattice_box box = lattice_box_make((sbf_vec3){-side / 2, 0, -side / 2}, (sbf_vec3){side, length, side}, 2,
      4, 2, soft_kg / (side * side * length), young, 0);
  scene_body(&s, 0)->attributes.stiffness_damping = 1e-3f;
  sbf_level *level = scene_lattice(&s, 0, &box);
  uint32_t body = rigid_box(&s, (sbf_vec3){0, length + 0.05f, 0}, (sbf_vec3){side, 0.1f, side}, loads[_i]);
  for (int end = 0; end < 2; end++) {
    uint32_t points[9];
    for (uint32_t i = 0; i < 9; i++) points[i] = lattice_box_point(&box, i % 3, end ? 4 : 0, i / 3);
    rigid_pin(&s, level, (uint32_t)end, end ? (int32_t)body : -1, points, 9);
  }
  lattice_box_free(&box);
  scene_start(&s);
  sbri_character *c = sbri_character_of(s.world, s.character);
  double soft = 0;
  for (uint32_t i = 0; i < c->model->islands[0].free_count; i++)
    soft += (double)c->model->islands[0].masses[i];
  /* The boxes carry the mass of the pinned ends, so the rest hangs between them symmetrically. */
  scene_ticks(&s, 300);
  double expected = 9.81 * ((double)loads[_i] + 0.5 * soft) * (double)(length / (young * side * side));
  double found = (double)(length + 0.05f - rigid_state(&s, body).center.y);
  ck_assert_double_eq_tol(found, expected, 0.01 * expected + 1e-7);
  scene_free(&s);
}
END_TEST

/* ---- Weight ---- */

/* A heavy block of soft tissue under a light bone on a ball joint, and a light block under a heavy bone. The
 * joint stays connected in both, and the swing continues as a pendulum almost without energy loss. */
static const struct { float soft_kg, rigid_kg; } hung[] = {{50, 0.05f}, {5, 0.05f}, {1, 1}, {0.01f, 10}};

START_TEST(a_soft_body_is_attached_to_a_joint)
{
  scene s = weightless();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  lattice_box box = lattice_box_make((sbf_vec3){-0.1f, -0.6f, -0.1f}, (sbf_vec3){0.2f, 0.5f, 0.2f}, 2, 5, 2,
      hung[_i].soft_kg / 0.02f, 2e3f * hung[_i].soft_kg + 2e3f, 0.3f);
  sbf_level *level = scene_lattice(&s, 0, &box);
  uint32_t body = rigid_box(&s, (sbf_vec3){0, -0.1f, 0}, (sbf_vec3){0.1f, 0.2f, 0.1f}, hung[_i].rigid_kg),
           points[9];
  rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, -1, body, (sbf_vec3){0, 0, 0}, rigid_along_y);
  for (uint32_t i = 0; i < 9; i++) points[i] = lattice_box_point(&box, i % 3, 5, i / 3);
  rigid_pin(&s, level, 0, (int32_t)body, points, 9);
  lattice_box_free(&box);
  scene_start(&s);
  scene_ticks(&s, 60);
  rigid_push(&s, body, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.3f * hung[_i].rigid_kg, 0, 0});
  float separation = 0, farthest = 0;
  for (int i = 0; i < 600; i++) {
    sbr_world_tick(s.world);
    sbr_joint_state joint = rigid_joint_state(&s, 0);
    separation = joint.separation > separation ? joint.separation : separation;
    float x = fabsf(scene_point(&s, 0, lattice_box_point(&box, 1, 0, 1)).x);
    farthest = x > farthest ? x : farthest;
  }
  ck_assert_float_le(separation, 1e-4f);
  ck_assert_float_le(farthest, 0.5f);
  scene_free(&s);
}
END_TEST

/* ---- Falls ---- */

/* Jelly of 4 to 24 cm about a bone of a fiftieth of its mass to as much. From 2.9 m it strikes the ground
 * at 4.4 times its speed of sound in a rod, and the bone squeezes what lies between them. */
START_TEST(jelly_about_a_bone_is_not_turned_inside_out)
{
  static const float bone_to_jelly[4] = {0.02f, 0.1f, 0.3f, 1};
  const float side = 0.04f * (float)(_i / 4 + 1), density = 1020;
  scene s = weightless();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 2.9 + 0.5 * (double)side;
  lattice_box box = lattice_box_make((sbf_vec3){-side / 2, -side / 2, -side / 2},
      (sbf_vec3){side, side, side}, 6, 6, 6, density, 3000, 0.48f);
  sbf_level *level = scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->attributes.damping_ratio = 0.06f;
  float bone_kg = bone_to_jelly[_i % 4] * density * side * side * side;
  uint32_t bone = rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){side / 3, side / 3, side / 3}, bone_kg),
           points[27];
  for (uint32_t i = 0; i < 27; i++) points[i] = lattice_box_point(&box, 2 + i % 3, 2 + i / 3 % 3, 2 + i / 9);
  rigid_pin(&s, level, 0, (int32_t)bone, points, 27);
  lattice_box_free(&box);
  scene_start(&s);
  for (int i = 0; i < 90; i++) {
    sbr_world_tick(s.world);
    ck_assert_msg(!sbr_character_get_body_health(s.world, s.character, 0).inverted,
        "side %g m, bone %g kg, tick %d", (double)side, (double)bone_kg, i);
  }
  scene_free(&s);
}
END_TEST

/* ---- Threads, snapshots, sleep ---- */

static scene on_the_ground(void) {
  scene s = dumbbell(2, 1, 0.2f);
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0.3;
  return s;
}

START_TEST(the_same_bits_on_any_threads)
{
  uint64_t hashes[4];
  for (int threads = 1; threads <= 3; threads++) {
    scene s = on_the_ground();
    s.world_definition.tasks = (sbr_tasks){run_on_threads, &threads};
    scene_start(&s);
    for (int i = 0; i < 2; i++) {
      sbr_character_id id;
      s.character_definition.position.x += 1.5;
      s.character_definition.heading += 0.7f;
      ck_assert_int_eq(sbr_character_create(s.world, s.model, &s.character_definition, &id, NULL), SBF_OK);
    }
    rigid_push(&s, 0, (sbf_vec3){0, 0, 0.05f}, (sbf_vec3){1, 2, 0.5f});
    scene_ticks(&s, 30);
    size_t size = sbr_world_get_snapshot_size(s.world);
    void *kept = malloc(size);
    ck_assert_int_eq(sbr_world_save_snapshot(s.world, kept, size), SBF_OK);
    for (int again = 0; again < 2; again++) {
      scene_ticks(&s, 40);
      hashes[threads == 1 && again == 0 ? 0 : 1] = sbr_world_get_state_hash(s.world);
      ck_assert_uint_eq(hashes[threads == 1 && again == 0 ? 0 : 1], hashes[0]);
      ck_assert_int_eq(sbr_world_restore_snapshot(s.world, kept, size), SBF_OK);
    }
    free(kept);
    scene_free(&s);
  }
}
END_TEST

/* Soft tissue and bones fall asleep in the same tick, and wake in the same tick. */
START_TEST(coupled_bodies_sleep_together)
{
  scene s = on_the_ground();
  s.world_definition.sleep_after_s = 0.5;
  scene_start(&s);
  sbri_character *c = sbri_character_of(s.world, s.character);
  int slept_at = 0;
  for (int i = 1; i < 900; i++) {
    sbr_world_tick(s.world);
    bool soft = sbri_island_states(c)[0].asleep, rigid = sbri_rigid_drive(c)->asleep;
    ck_assert_int_eq(soft, rigid);
    if (rigid && !slept_at) slept_at = i;
  }
  ck_assert_int_ge(slept_at, 30);
  ck_assert_uint_eq(sbri_header(c)->asleep, 1);
  sbf_vec3 before = scene_point(&s, 0, 40);
  rigid_push(&s, 0, (sbf_vec3){0, 0, 0}, (sbf_vec3){0, 3, 0});
  scene_ticks(&s, 12);
  ck_assert_uint_eq(sbri_island_states(c)[0].asleep, 0);
  ck_assert_float_ge(fabsf(scene_point(&s, 0, 40).y - before.y), 0.005f);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("coupled");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, a_hit_conserves_momentum, 0, sizeof dumbbells / sizeof *dumbbells);
  tcase_add_loop_test(
      tests, a_hard_hit_swings_nothing_up, 0, HARNESS_FEW((int)(sizeof hard_hits / sizeof *hard_hits), 2));
  tcase_add_loop_test(tests, springs_conserve_momentum, 0, 2);
  tcase_add_loop_test(tests, a_mass_swings_on_a_soft_spring, 0, 3);
  tcase_add_loop_test(tests, both_ends_of_a_spring_swing, 0, 3);
  tcase_add_loop_test(tests, a_load_presses_a_column, 0, 3);
  tcase_add_loop_test(tests, a_soft_body_is_attached_to_a_joint, 0, sizeof hung / sizeof *hung);
  tcase_add_test(tests, the_same_bits_on_any_threads);
  tcase_add_loop_test(tests, jelly_about_a_bone_is_not_turned_inside_out, 0, 24);
  tcase_add_test(tests, coupled_bodies_sleep_together);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
