/* Persons of 14 and 20 parts fall down eight steps, made of boxes with a floor below, and down stairs of a
 * ground. Tipping and hanging bodies come to rest in their expected positions. */
#include <math.h>

#include "collision_scenes.h"
#include "harness.h"
#include "host_threads.h"
#include "rigid_person.h"

enum { STEPS = 9, RANDOM_SHOVES = 30 };
static const float RISE = 0.17f, RUN = 0.29f;
static const sbf_vec3 SHOVES[3] = {{0, 0, -130}, {40, 0, -150}, {-60, 0, -120}};

typedef struct flight {
  scene scene;
  sbr_shape *steps[STEPS];
  uint32_t parts;
} flight;

/* At the top of the stairs, which descend towards -Z. The first box is a wide landing. The ground's stairs
 * are endless, towards +Z. */
static flight begin(bool whole, bool boxes) {
  flight f = {.scene = whole ? whole_person() : person(), .parts = whole ? ALL_PARTS : PARTS};
  f.scene.character_definition.position = (sbr_double3){0, 0.02, boxes ? 0.25 : 0};
  if (boxes) f.scene.character_definition.position.y += (double)(RISE * STEPS);
  if (!boxes) f.scene.world_definition.ground = sbr_ground_stairs(-(double)RISE, (double)RUN);
  f.scene.world_definition.sleep_after_s = 0.5;
  return f;
}

static void start(flight *f, bool boxes) {
  scene_start(&f->scene);
  for (int k = 0; boxes && k < STEPS; k++) {
    sbr_shape_definition d = sbr_default_shape_definition();
    float high = RISE * (float)(STEPS - k), deep = k ? RUN : 4;
    d.kind = SBR_SHAPE_BOX;
    d.half_sizes = (sbf_vec3){3, 0.5f * high, 0.5f * deep};
    f->steps[k] = collision_shape(d);
    double z = k ? -(double)RUN * (k - 0.5) : 2;
    collision_collider(&f->scene, f->steps[k], (sbr_double3){0, 0.5 * (double)high, z});
  }
}

static void end(flight *f) {
  scene_free(&f->scene);
  for (int k = 0; k < STEPS; k++) sbr_shape_destroy(f->steps[k]);
}

static float larger(float a, float b) {
  return a > b ? a : b;
}

static float fastest(const flight *f) {
  float max = 0;
  for (uint32_t b = 0; b < f->parts; b++) {
    sbf_vec3 v = rigid_state(&f->scene, b).velocity;
    max = larger(max, sqrtf(v.x * v.x + v.y * v.y + v.z * v.z));
  }
  return max;
}

typedef struct fall {
  float separation, on_the_way, at_rest; /* m, rad: errors of joints and limits, in motion and at rest */
  int moved;                             /* ticks until all speeds stay below 1 mm/s */
} fall;

static fall tumble(flight *f, int ticks, int rests_from) {
  fall found = {0};
  for (int i = 0; i < ticks; i++) {
    sbr_world_tick(f->scene.world);
    float *beyond = i < rests_from ? &found.on_the_way : &found.at_rest;
    for (uint32_t j = 0; j + 1 < f->parts; j++) {
      sbr_joint_state now = rigid_joint_state(&f->scene, j);
      found.separation = larger(found.separation, now.separation),
      *beyond = larger(*beyond, now.angle_violation);
    }
    if (fastest(f) > 1e-3f) found.moved = i + 1;
  }
  return found;
}

/* No joint comes off by a millimetre and no limit is broken by a degree on the way, or by a tenth of one at
 * rest; and after 5 s nothing moves by more than 1 mm/s. */
static void falls(bool whole, bool boxes, sbf_vec3 shove) {
  flight f = begin(whole, boxes);
  start(&f, boxes);
  person_shove(&f.scene, 1, (sbf_vec3){shove.x, shove.y, boxes ? shove.z : -shove.z});
  fall found = tumble(&f, 360, 300);
  ck_assert_float_le(found.separation, 1e-3f);
  ck_assert_float_le(found.on_the_way, 0.0175f);
  ck_assert_float_le(found.at_rest, 0.00175f);
  ck_assert_int_le(found.moved, 300);
  sbf_vec3 hips = rigid_state(&f.scene, 0).center;
  double z = (double)hips.z + sbr_character_get_origin(f.scene.world, f.scene.character).z;
  ck_assert_double_ge(boxes ? -z : z, 0.5);
  end(&f);
}

START_TEST(a_person_falls_down_stairs)
{ falls(_i & 1, true, SHOVES[_i / 2]); }
END_TEST

START_TEST(a_person_falls_down_stairs_of_the_ground)
{ falls(_i & 1, false, SHOVES[1 + _i / 2]); }
END_TEST

static float next_fraction(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (float)(*seed >> 8) / 16777216.0f;
}

/* However they are shoved, all lie still within 5 s. */
START_TEST(bodies_that_fall_down_stairs_come_to_rest)
{
  bool whole = _i;
  uint32_t seed = 12345;
  for (int i = 0; i < RANDOM_SHOVES; i++) {
    flight f = begin(whole, false);
    start(&f, false);
    float aside = 120 * next_fraction(&seed) - 60;
    person_shove(&f.scene, 1, (sbf_vec3){aside, 0, 120 + 60 * next_fraction(&seed)});
    fall found = tumble(&f, 360, 300);
    ck_assert_float_le(found.separation, 1e-3f);
    ck_assert_float_le(found.on_the_way, 0.0175f);
    ck_assert_float_le(found.at_rest, 0.00175f);
    ck_assert_int_le(found.moved, 300);
    end(&f);
  }
}
END_TEST

/* A plank released level over stairs tips until it lies along them on their nosings alone. Its corners are
 * over treads that it does not reach. */
START_TEST(a_plank_rests_across_nosings)
{
  bool down = _i;
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  s.world_definition.ground = sbr_ground_stairs((double)(down ? -RISE : RISE), (double)RUN);
  s.world_definition.sleep_after_s = 0.5;
  uint32_t plank = rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.3f, 0.04f, 1.5f}, 5);
  rigid_body(&s, plank)->friction = 1;
  s.character_definition.position = (sbr_double3){0, 0.5, 7.5 * (double)RUN};
  scene_start(&s);
  scene_ticks(&s, 300);
  sbf_vec3 c = rigid_state(&s, plank).center;
  sbr_double3 o = sbr_character_get_origin(s.world, s.character);
  double slope = (double)(RISE / RUN) * (down ? -1 : 1), z = (double)c.z + o.z;
  double nosings = slope * (z - (down ? (double)RUN : 0)) + 0.02 * sqrt(1 + slope * slope);
  ck_assert_double_eq_tol((double)c.y + o.y, nosings, 2e-3);
  ck_assert_float_eq(rigid_state(&s, plank).velocity.y, 0);
  scene_free(&s);
}
END_TEST

/* A cube whose middle is beyond a nosing, over the step below, hits the nosing as it falls. */
START_TEST(parts_over_a_nosing_are_in_contact)
{
  const float half = 0.05f;
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  s.world_definition.ground = sbr_ground_stairs(-(double)RISE, (double)RUN);
  uint32_t cube = rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){2 * half, 2 * half, 2 * half}, 1);
  double z = 5 * (double)RUN, y = -4 * (double)RISE;                  /* the nosing */
  s.character_definition.position = (sbr_double3){0, 0.25, z + 0.03}; /* over the ground there */
  scene_start(&s);
  float deepest = 0;
  for (int i = 0; i < 60; i++) {
    scene_ticks(&s, 1);
    sbr_rigid_state state = rigid_state(&s, cube);
    sbr_double3 o = sbr_character_get_origin(s.world, s.character);
    sbf_vec3 off = {0, (float)(y - o.y) - state.center.y, (float)(z - o.z) - state.center.z};
    sbf_quat q = state.frame.rotation; /* about x alone */
    float c = 1 - 2 * q.x * q.x, w = 2 * q.w * q.x;
    float deep = half - larger(fabsf(c * off.y + w * off.z), fabsf(c * off.z - w * off.y));
    deepest = larger(deepest, deep);
  }
  ck_assert_float_ge(deepest, -1e-3f); /* it met it */
  ck_assert_float_le(deepest, 2e-3f);
  scene_free(&s);
}
END_TEST

/* A post with a weight to the side, whose common centre of mass is 4 mm inside the post's foot or outside it.
 * The first stands and sleeps, the second tips, however slowly it starts. */
START_TEST(tipping_bodies_do_not_fall_asleep)
{
  bool tips = _i;
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.sleep_after_s = 0.5;
  s.character_definition.position.y = 0.001;
  uint32_t foot = rigid_box(&s, (sbf_vec3){0, 0.1f, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  uint32_t top =
      rigid_box(&s, (sbf_vec3){0.2f + (tips ? 8e-3f : -8e-3f), 0.9f, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  rigid_joint(&s, SBF_JOINT_KIND_FIXED, (int32_t)foot, top, (sbf_vec3){0.1f, 0.5f, 0}, rigid_along_x);
  scene_start(&s);
  scene_ticks(&s, 300);
  if (tips)
    ck_assert_float_le(rigid_state(&s, top).center.y, 0.15f);
  else
    ck_assert_float_ge(rigid_state(&s, top).center.y, 0.89f);
  ck_assert_float_eq(rigid_state(&s, top).angular_velocity.z, 0);
  scene_free(&s);
}
END_TEST

/* A passive leg without friction sleeps within 4 s, near its hanging position. Its soft tissue alone takes
 * longer. An impulse wakes it. */
START_TEST(bodies_fall_asleep_after_swinging)
{
  scene s = person();
  s.world_definition.sleep_after_s = _i ? 0.5 : 0;
  s.character_definition.position.y = 1;
  scene_start(&s);
  sbr_rigid_drive drive = sbr_default_rigid_drive();
  drive.joint_friction = 0;
  sbr_character_set_rigid_drive(s.world, s.character, &drive);
  sbr_character_set_rigid_mode(s.world, s.character, -1, SBR_RIGID_KINEMATIC);
  sbr_character_set_rigid_mode(s.world, s.character, 8, SBR_RIGID_PASSIVE); /* a shin and its foot */
  sbr_character_set_rigid_mode(s.world, s.character, 9, SBR_RIGID_PASSIVE);
  scene_ticks(&s, 1);
  person_shove(&s, 8, (sbf_vec3){1.5f, 0, 0});
  scene_ticks(&s, 240);
  float speed = fabsf(rigid_state(&s, 8).velocity.x), off = fabsf(rigid_state(&s, 8).center.x - 0.1f);
  if (_i) {
    ck_assert_float_eq(speed, 0);
    ck_assert_float_le(off, 0.01f);
    person_shove(&s, 8, (sbf_vec3){0, 0, -1});
    scene_ticks(&s, 1);
    ck_assert_float_le(rigid_state(&s, 8).velocity.z, -0.05f);
  } else {
    ck_assert_float_gt(person_fastest(&s), 1e-3f);
  }
  scene_free(&s);
}
END_TEST

/* Three beside each other: the same bits on one thread, on two and on four. */
START_TEST(threads_change_nothing)
{
  uint64_t hashes[3];
  for (int i = 0; i < 3; i++) {
    flight f = begin(true, true);
    int threads = 1 << i;
    f.scene.world_definition.tasks = (sbr_tasks){.run = run_on_threads, .user = &threads};
    start(&f, true);
    for (int k = 1; k < 3; k++) {
      sbr_character_definition d = f.scene.character_definition;
      sbr_character_id id;
      d.position.x = 1.9 * (k == 1 ? 1 : -1);
      ck_assert(sbr_character_create(f.scene.world, f.scene.model, &d, &id, NULL) == SBF_OK);
    }
    person_shove(&f.scene, 1, SHOVES[0]);
    scene_ticks(&f.scene, 120);
    hashes[i] = sbr_world_get_state_hash(f.scene.world);
    end(&f);
  }
  ck_assert_uint_eq(hashes[0], hashes[1]);
  ck_assert_uint_eq(hashes[0], hashes[2]);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("tumble");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, a_person_falls_down_stairs, 0, 6);
  tcase_add_loop_test(tests, a_person_falls_down_stairs_of_the_ground, 0, 4);
  tcase_add_loop_test(tests, bodies_that_fall_down_stairs_come_to_rest, 0, 2);
  tcase_add_loop_test(tests, a_plank_rests_across_nosings, 0, 2);
  tcase_add_test(tests, parts_over_a_nosing_are_in_contact);
  tcase_add_loop_test(tests, tipping_bodies_do_not_fall_asleep, 0, 2);
  tcase_add_loop_test(tests, bodies_fall_asleep_after_swinging, 0, 2);
  tcase_add_test(tests, threads_change_nothing);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
