/* Bodies that may touch and do not: characters that walk far from each other move to the bit as in a world
 * without contacts between bodies, each island by steps of its own. */
#include <stdio.h>

#include "harness.h"
#include "sbfmt/build.h"
#include "sbfmt/convert.h"
#include "sbrun/collision.h"
#include "sbrun/debug.h"
#include "sbrun/sbrun.h"

/* One second, in which none of its legs comes near another. */
enum { TICKS = 60, CONTACTS = 512 };

static sbf_asset *built_pup(void) {
  sbf_asset *draft, *asset;
  sbf_diagnostic error;
  const char *path = harness_source("examples/pup/pup.glb");
  ck_assert_msg(sbf_convert(path, NULL, &draft, &error) == SBF_OK, "%s", error.message);
  ck_assert_msg(sbf_build(draft, NULL, &asset, NULL, &error) == SBF_OK, "%s", error.message);
  sbf_asset_free(draft);
  return asset;
}

/* Two that walk on the same way, `separation_m` from each other. */
static sbr_world *world_of(const sbr_model *model, bool contacts, double separation_m) {
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_world *world;
  ck_assert_int_eq(sbr_world_create(&definition, &world, NULL), SBF_OK);
  if (contacts) ck_assert_int_eq(sbr_world_enable_body_contacts(world, CONTACTS, NULL), SBF_OK);
  for (int i = 0; i < 2; i++) {
    sbr_character_definition standing = sbr_default_character_definition();
    sbr_character_id character;
    standing.position.x = separation_m * i;
    ck_assert_int_eq(sbr_character_create(world, model, &standing, &character, NULL), SBF_OK);
    sbr_character_set_drive(world, character, 0.2f, 0, 0);
  }
  return world;
}

START_TEST(characters_without_contact_move_as_alone)
{
  sbf_asset *asset = built_pup();
  sbr_model *model;
  ck_assert_int_eq(sbr_model_create(asset, NULL, &model, NULL), SBF_OK);
  sbr_world *without = world_of(model, false, 5), *with = world_of(model, true, 5);
  for (int i = 0; i < TICKS; i++) {
    sbr_world_tick(without);
    sbr_world_tick(with);
    ck_assert_msg(sbr_world_get_state_hash(with) == sbr_world_get_state_hash(without), "tick %d", i);
  }
  ck_assert_uint_eq(sbr_world_get_counters(with).body_contact_count, 0);
  sbr_world_destroy(without);
  sbr_world_destroy(with);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
}
END_TEST

/* Against a test that could not fail: side by side they do touch, and move otherwise. */
START_TEST(characters_in_contact_move_differently)
{
  sbf_asset *asset = built_pup();
  sbr_model *model;
  uint32_t touched = 0;
  ck_assert_int_eq(sbr_model_create(asset, NULL, &model, NULL), SBF_OK);
  sbr_world *without = world_of(model, false, 0.38), *with = world_of(model, true, 0.38);
  for (int i = 0; i < TICKS / 2; i++) {
    sbr_world_tick(without);
    sbr_world_tick(with);
    touched += sbr_world_get_counters(with).body_contact_count;
  }
  ck_assert_uint_gt(touched, 0);
  ck_assert(sbr_world_get_state_hash(with) != sbr_world_get_state_hash(without));
  sbr_world_destroy(without);
  sbr_world_destroy(with);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("apart");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, characters_without_contact_move_as_alone);
  tcase_add_test(tests, characters_in_contact_move_differently);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
