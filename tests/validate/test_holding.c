#include "rules.h"
#include "validate/rules/pin_states.h"

START_TEST(test_weight_within_its_bounds)
{
  const float weights[] = {0.5f, 1, 0};
  sbf_pin_set set = {.weights = {weights, 3}, .minimum = 0.25f, .maximum = 0.75f};
  ck_assert(sbfi_pin_weight(&set, 0) == 0.5f);
  ck_assert(sbfi_pin_weight(&set, 1) == 0.75f);
  ck_assert(sbfi_pin_weight(&set, 2) == 0.25f);
  set.weights.count = 1; /* one for all */
  ck_assert(sbfi_pin_weight(&set, 7) == 0.5f);
  set.weights = (sbf_f32_list){NULL, 0};
  set.maximum = 1;
  ck_assert(sbfi_pin_weight(&set, 7) == 1);
}
END_TEST

START_TEST(test_the_strongest_pin_is_used)
{
  sbf_asset *asset =
      rules_load(BODY(LEVEL("", TETRA_POINTS,
                     "<pins><pin_set><points>0 1 2</points><weights>1 0.5 0</weights></pin_set>"
                     "<pin_set maximum=\"0.5\"><points>0 1</points></pin_set></pins>")),
          false);
  uint8_t holds[4];
  sbfi_find_pin_states(&asset->soft_bodies.at[0].levels.at[0], holds);
  ck_assert_int_eq(holds[0], SBFI_PINNED);
  ck_assert_int_eq(holds[1], SBFI_GOAL_PINNED);
  ck_assert_int_eq(holds[2], SBFI_FREE);
  ck_assert_int_eq(holds[3], SBFI_FREE);
  sbf_asset_free(asset);
}
END_TEST

RULES_MAIN("holding", test_weight_within_its_bounds, test_the_strongest_pin_is_used)
