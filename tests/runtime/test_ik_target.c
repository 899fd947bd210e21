/* Targets for limbs that a host sets: in world coordinates, by chain index, until they are removed. */
#include "harness.h"
#include "math/vec3.h"
#include "quadruped.h"
#include "sbfmt/asset.h"
#include "sbrun/animation.h"
#include "sbrun/sbrun.h"

enum { BONES = 20, FORE_FOOT = 16, FORE_CHAIN = QUADRUPED_FORE_L };

typedef struct walker {
  sbf_asset *asset;
  sbr_model *model;
  sbr_world *world;
  sbr_character_id character;
} walker;

/* Far from the world's origin. An error in the frame of the target would be obvious. */
static const sbr_double3 position = {100, 0, -40};

static walker begin(void) {
  walker w = {.asset = quadruped_asset()};
  sbr_world_definition world = sbr_default_world_definition();
  sbr_character_definition character = sbr_default_character_definition();
  character.position = position;
  ck_assert_int_eq(sbr_model_create(w.asset, NULL, &w.model, NULL), SBF_OK);
  ck_assert_int_eq(sbr_world_create(&world, &w.world, NULL), SBF_OK);
  ck_assert_int_eq(sbr_character_create(w.world, w.model, &character, &w.character, NULL), SBF_OK);
  return w;
}

static void end(walker *w) {
  sbr_world_destroy(w->world);
  sbr_model_destroy(w->model);
  sbf_asset_free(w->asset);
}

static void ticks(walker *w, int count) {
  for (int i = 0; i < count; i++) sbr_world_tick(w->world);
}

/* Where the foot is from the character's place. */
static sbf_vec3 foot(const walker *w) {
  sbr_transform bones[BONES];
  sbr_double3 origin = sbr_character_get_origin(w->world, w->character);
  sbr_character_get_bones(w->world, w->character, bones, BONES);
  sbf_vec3 at = bones[FORE_FOOT].position;
  return sbri_vec3((float)(at.x + origin.x - position.x), (float)(at.y + origin.y - position.y),
      (float)(at.z + origin.z - position.z));
}

static float separation(sbf_vec3 a, sbf_vec3 b) {
  return sbri_length(sbri_sub(a, b));
}

static sbr_ik_target target_at(sbf_vec3 at, float weight) {
  sbr_ik_target target = sbr_default_ik_target();
  target.position =
      (sbr_double3){position.x + (double)at.x, position.y + (double)at.y, position.z + (double)at.z};
  target.weight = weight;
  return target;
}

static const sbf_vec3 wanted = {0.15f, 0.15f, 0.3f};

START_TEST(a_foot_moves_to_its_target_and_back)
{
  walker w = begin();
  ticks(&w, 2);
  sbf_vec3 rest = foot(&w);
  ck_assert_float_gt(separation(rest, wanted), 0.05f);
  sbr_ik_target target = target_at(wanted, 1);
  sbr_character_set_ik_target(w.world, w.character, FORE_CHAIN, &target);
  ticks(&w, 30);
  ck_assert_float_le(separation(foot(&w), wanted), 2e-3f);
  sbr_character_set_ik_target(w.world, w.character, FORE_CHAIN, NULL);
  ticks(&w, 30);
  ck_assert_float_le(separation(foot(&w), rest), 1e-3f);
  end(&w);
}
END_TEST

START_TEST(weights_are_clamped_between_zero_and_one)
{
  walker w = begin();
  ticks(&w, 2);
  sbf_vec3 rest = foot(&w);
  static const float weights[] = {5, 0.5f, 0, -1};
  float far[4];
  for (int i = 0; i < 4; i++) {
    sbr_ik_target target = target_at(wanted, weights[i]);
    sbr_character_set_ik_target(w.world, w.character, FORE_CHAIN, &target);
    ticks(&w, 30);
    far[i] = separation(foot(&w), wanted);
    if (weights[i] <= 0) ck_assert_float_le(separation(foot(&w), rest), 1e-3f);
  }
  ck_assert_float_le(far[0], 2e-3f); /* as with 1 */
  ck_assert_float_gt(far[1], 0.01f);
  ck_assert_float_lt(far[1], 0.9f * far[2]);
  end(&w);
}
END_TEST

START_TEST(invalid_targets_are_ignored)
{
  walker w = begin();
  ticks(&w, 2);
  sbf_vec3 rest = foot(&w);
  sbr_ik_target target = target_at(wanted, 1);
  sbr_character_set_ik_target(w.world, w.character, w.asset->ik_chains.count, &target);
  sbr_character_set_ik_target(w.world, w.character, UINT32_MAX, &target);
  sbr_character_set_ik_target(w.world, (sbr_character_id){w.character.value + 1}, FORE_CHAIN, &target);
  target.cookie = 0; /* as in a struct that was never initialised */
  sbr_character_set_ik_target(w.world, w.character, FORE_CHAIN, &target);
  ticks(&w, 30);
  ck_assert_float_le(separation(foot(&w), rest), 1e-3f);
  end(&w);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("ik_target");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_foot_moves_to_its_target_and_back);
  tcase_add_test(tests, weights_are_clamped_between_zero_and_one);
  tcase_add_test(tests, invalid_targets_are_ignored);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
