/* Characters that walk show one motion, however a host's frames come: at 30, 60 and 144 a second, unevenly,
 * after a hitch. The state after so many ticks is the same to the bit, and so is what is shown at a time, to
 * rounding. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "harness.h"
#include "sbfmt/build.h"
#include "sbfmt/convert.h"
#include "sbrun/sbrun.h"

enum { SECONDS = 4, TICKS = 60 * SECONDS + 30, MAX_BONES = 64 };

typedef struct example {
  const char *name, *mesh, *rig;
  uint32_t legs;
  bool bodies;
} example;

static const example examples[] = {{"yeti", "yeti.glb", NULL, 2, false}, {"pup", "pup.glb", NULL, 4, false},
    {"lizard", "lizard.obj", "lizard.glb", 4, true}, {"spider", "spider.glb", NULL, 8, false},
    {"caterpillar", "caterpillar.glb", NULL, 14, false}};
enum { EXAMPLES = sizeof examples / sizeof *examples };

typedef struct stage {
  sbf_asset *asset;
  sbr_model *model;
} stage;

typedef struct walk {
  sbr_world *world;
  sbr_character_id character;
} walk;

static const char *path_of(const example *e, const char *file) {
  char below[256];
  snprintf(below, sizeof below, "examples/%s/%s", e->name, file);
  return harness_source(below);
}

static stage stage_of(const example *e) {
  stage s;
  sbf_diagnostic error;
  sbf_asset *built;
  const sbf_convert_options options = {.rig = e->rig ? path_of(e, e->rig) : NULL};
  ck_assert_msg(sbf_convert(path_of(e, e->mesh), &options, &s.asset, &error) == SBF_OK, "%s", error.message);
  if (e->bodies) {
    ck_assert_msg(sbf_build(s.asset, NULL, &built, NULL, &error) == SBF_OK, "%s", error.message);
    sbf_asset_free(s.asset);
    s.asset = built;
  }
  ck_assert_uint_eq(s.asset->gaits.at[0].legs.count, e->legs);
  ck_assert_uint_le(s.asset->bones.count, MAX_BONES);
  ck_assert_msg(sbr_model_create(s.asset, NULL, &s.model, &error) == SBF_OK, "%s", error.message);
  return s;
}

static void strike(stage *s) {
  sbr_model_destroy(s->model);
  sbf_asset_free(s->asset);
}

static walk begin(const stage *s) {
  walk w;
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  definition.ground = sbr_ground_noise(0.03, 5);
  ck_assert_int_eq(sbr_world_create(&definition, &w.world, NULL), SBF_OK);
  ck_assert_int_eq(sbr_character_create(w.world, s->model, &standing, &w.character, NULL), SBF_OK);
  sbr_character_set_drive(w.world, w.character, 0.25f, 0, 0.3f);
  return w;
}

/* From 0 to 1, the same for the same number. */
static double chance(uint32_t k) {
  return (double)(k * 2654435761u % 1000) / 1000;
}

/* The k-th frame's time of a host. */
typedef double frame_time(uint32_t k);
static double at_30(uint32_t k) {
  (void)k;
  return 1.0 / 30;
}
static double at_60_with_jitter(uint32_t k) {
  return (0.5 + chance(k)) / 60;
}
static double at_144(uint32_t k) {
  (void)k;
  return 1.0 / 144;
}
static double at_144_with_jitter(uint32_t k) {
  return (0.5 + chance(k)) / 144;
}
static double with_hitches(uint32_t k) {
  return k % 40 == 39 ? 0.25 : (0.5 + chance(k)) / 60;
}

START_TEST(every_tick_has_one_state)
{
  static frame_time *const hosts[] = {at_30, at_60_with_jitter, at_144, at_144_with_jitter, with_hitches};
  stage s = stage_of(&examples[_i]);
  uint64_t hashes[TICKS + 1];
  walk even = begin(&s);
  for (int i = 1; i <= TICKS; i++) {
    sbr_world_tick(even.world);
    hashes[i] = sbr_world_get_state_hash(even.world);
    ck_assert(i < 2 || hashes[i] != hashes[i - 1]);
  }
  ck_assert_double_gt(sbr_character_get_distance(even.world, even.character), 0.05 * SECONDS);
  sbr_world_destroy(even.world);
  for (size_t h = 0; h < sizeof hosts / sizeof *hosts; h++) {
    walk w = begin(&s);
    for (uint32_t k = 0; sbr_world_get_tick_count(w.world) < 60 * SECONDS; k++) {
      sbr_world_step(w.world, hosts[h](k));
      uint64_t ticks = sbr_world_get_tick_count(w.world);
      if (ticks > 0) ck_assert_uint_eq(sbr_world_get_state_hash(w.world), hashes[ticks]);
    }
    sbr_world_destroy(w.world);
  }
  strike(&s);
}
END_TEST

typedef struct shown {
  sbr_transform bones[MAX_BONES];
  sbr_double3 origin;
} shown;

/* Displayed state after each second, at an even rate. */
static void watch(const stage *s, int fps, shown *seconds) {
  walk w = begin(s);
  for (int second = 0; second < SECONDS; second++) {
    for (int i = 0; i < fps; i++) sbr_world_step(w.world, 1.0 / fps);
    sbr_character_get_bones(w.world, w.character, seconds[second].bones, MAX_BONES);
    seconds[second].origin = sbr_character_get_origin(w.world, w.character);
  }
  sbr_world_destroy(w.world);
}

START_TEST(every_rate_shows_the_same_pose_at_a_time)
{
  static const int rates[] = {30, 144, 90};
  stage s = stage_of(&examples[_i]);
  static shown at_60[SECONDS], other[SECONDS];
  watch(&s, 60, at_60);
  for (int r = 0; r < 3; r++) {
    watch(&s, rates[r], other);
    for (int k = 0; k < SECONDS; k++)
      for (uint32_t b = 0; b < s.asset->bones.count; b++) {
        const sbf_vec3 *p = &at_60[k].bones[b].position, *q = &other[k].bones[b].position;
        double x = at_60[k].origin.x + (double)p->x - other[k].origin.x - (double)q->x;
        double y = at_60[k].origin.y + (double)p->y - other[k].origin.y - (double)q->y;
        double z = at_60[k].origin.z + (double)p->z - other[k].origin.z - (double)q->z;
        ck_assert_double_lt(sqrt(x * x + y * y + z * z), 2e-5);
      }
  }
  strike(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("frame_times");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, every_tick_has_one_state, 0, EXAMPLES);
  tcase_add_loop_test(tests, every_rate_shows_the_same_pose_at_a_time, 0, EXAMPLES);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
