/* Persons of 14 and 20 parts fall down a flight of eight steps, of boxes with a floor below. */
#include <math.h>

#include "collision_scenes.h"
#include "harness.h"
#include "host_threads.h"
#include "rigid_person.h"

enum { STEPS = 9 };
static const float RISE = 0.17f, RUN = 0.29f;
static const sbf_vec3 SHOVES[3] = {{0, 0, -130}, {40, 20, -150}, {-60, 0, -120}};

typedef struct flight {
  scene scene;
  sbr_shape *steps[STEPS];
  uint32_t parts;
} flight;

/* At the head of the stairs, which go down towards -Z; the first box is where one stands, and wide. */
static flight begin(bool whole) {
  flight f = {.scene = whole ? whole_person() : person(), .parts = whole ? ALL_PARTS : PARTS};
  f.scene.character_definition.position = (sbr_double3){0, (double)(RISE * STEPS) + 0.02, 0.25};
  f.scene.world_definition.sleep_after_s = 0.5;
  return f;
}

static void start(flight *f) {
  scene_start(&f->scene);
  for (int k = 0; k < STEPS; k++) {
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
  float most = 0;
  for (uint32_t b = 0; b < f->parts; b++) {
    sbf_vec3 v = rigid_state(&f->scene, b).velocity;
    most = larger(most, sqrtf(v.x * v.x + v.y * v.y + v.z * v.z));
  }
  return most;
}

/* No joint comes off by a millimetre and no limit is broken by a degree on the way, or by a tenth of one at
 * rest; and after 5 s nothing moves by more than 1 mm/s, where there are limp hands, toes and a tail after 7
 * s by more than 5. */
START_TEST(a_person_falls_down_stairs)
{
  flight f = begin(_i & 1);
  start(&f);
  person_shove(&f.scene, 1, SHOVES[_i / 2]);
  int rests_from = _i & 1 ? 420 : 300;
  float apart = 0, on_the_way = 0, at_rest = 0, shaking = 0;
  for (int i = 0; i < rests_from + 60; i++) {
    sbr_world_tick(f.scene.world);
    float *beyond = i < rests_from ? &on_the_way : &at_rest;
    for (uint32_t j = 0; j + 1 < f.parts; j++) {
      sbr_joint_state now = rigid_joint_state(&f.scene, j);
      apart = larger(apart, now.apart), *beyond = larger(*beyond, now.beyond_angle);
    }
    if (i >= rests_from) shaking = larger(shaking, fastest(&f));
  }
  ck_assert_float_le(apart, 1e-3f);
  ck_assert_float_le(on_the_way, 0.0175f);
  ck_assert_float_le(at_rest, 0.00175f);
  ck_assert_float_le(shaking, _i & 1 ? 5e-3f : 1e-3f);
  sbf_vec3 hips = rigid_state(&f.scene, 0).center;
  ck_assert_double_le((double)hips.z + sbr_character_origin(f.scene.world, f.scene.character).z, -0.5);
  end(&f);
}
END_TEST

/* Three beside each other: the same bits on one thread, on two and on four. */
START_TEST(threads_change_nothing)
{
  uint64_t hashes[3];
  for (int i = 0; i < 3; i++) {
    flight f = begin(true);
    int threads = 1 << i;
    f.scene.world_definition.tasks = (sbr_tasks){.run = run_on_threads, .user = &threads};
    start(&f);
    for (int k = 1; k < 3; k++) {
      sbr_character_definition d = f.scene.character_definition;
      sbr_character_id id;
      d.position.x = 1.9 * (k == 1 ? 1 : -1);
      ck_assert(sbr_character_create(f.scene.world, f.scene.model, &d, &id, NULL) == SBF_OK);
    }
    person_shove(&f.scene, 1, SHOVES[0]);
    scene_ticks(&f.scene, 120);
    hashes[i] = sbr_world_state_hash(f.scene.world);
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
  tcase_add_test(tests, threads_change_nothing);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
