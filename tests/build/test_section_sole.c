#include "build/sections/section_sole.h"

#include "harness.h"
#include "skinned_limb.h"

/* A tube of two bones that stands on the lower end of the first; the second moves half of that end too. */
static sbf_asset *standing(bool on_a_leg) {
  const skinned_limb of = {.bones = 2, .sides = 8, .rings_a_bone = 10, .radius = 0.2f, .slope = 3.8f};
  sbf_asset *asset = skinned_limb_make(&of);
  if (!on_a_leg) return asset;
  sbf_ik_chain *chain = sbf_asset_allocate(asset, 1, sizeof *chain);
  sbf_gait *gait = sbf_asset_allocate(asset, 1, sizeof *gait);
  sbf_leg *leg = sbf_asset_allocate(asset, 1, sizeof *leg);
  ck_assert(chain && gait && leg);
  sbf_ik_chain_init(chain);
  sbf_gait_init(gait);
  sbf_leg_init(leg);
  chain->root = chain->end = 0;
  gait->legs = (sbf_leg_list){leg, 1};
  leg->ik = 0;
  asset->ik_chains = (sbf_ik_chain_list){chain, 1};
  asset->gaits = (sbf_gait_list){gait, 1};
  /* So that the second bone is above the foot, not below it. */
  sbf_bone *bones = (sbf_bone *)(uintptr_t)asset->bones.at;
  bones[1].parent = SBF_NONE;
  return asset;
}

/* Least share of the first bone in the points up to a height, and how many points are marked as soles. */
static float min_fraction(bool on_a_leg, float height, uint32_t *marked) {
  sbf_asset *asset = standing(on_a_leg);
  sbfi_arena arena;
  sbfi_skin_union skin;
  uint8_t chosen[1];
  uint32_t count;
  float min = 1;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_skins_choose(asset, chosen, &count, &arena));
  ck_assert(sbfi_skin_union_make(&skin, asset, chosen, &arena));
  uint8_t *soles = sbfi_arena_allocate(&arena, skin.mesh.positions.count, 1);
  ck_assert(soles && sbfi_soles_gather(&skin, asset, soles, &arena));
  *marked = 0;
  for (uint32_t p = 0; p < skin.mesh.positions.count; p++) {
    float own = 0, sum = 0;
    for (uint32_t h = skin.bone_weight_begins[p]; h < skin.bone_weight_begins[p + 1]; h++) {
      sum += skin.bone_weights[h].weight;
      if (skin.bone_weights[h].bone == 0) own += skin.bone_weights[h].weight;
    }
    ck_assert_float_eq_tol(sum, 1, 1e-5f);
    *marked += soles[p];
    if (skin.mesh.positions.at[p].y <= height && own < min) min = own;
  }
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
  return min;
}

START_TEST(a_sole_is_its_foots_alone)
{
  uint32_t marked;
  ck_assert_float_eq_tol(min_fraction(true, 0.1f, &marked), 1, 1e-6f);
  ck_assert_uint_gt(marked, 0);
  ck_assert_float_lt(min_fraction(true, 0.9f, &marked), 0.7f); /* above it all is as it was */
}
END_TEST

START_TEST(sections_without_legs_are_unchanged)
{
  uint32_t marked;
  ck_assert_float_lt(min_fraction(false, 0.1f, &marked), 0.99f);
  ck_assert_uint_eq(marked, 0);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("section_sole");
  TCase *c = tcase_create("section_sole");
  tcase_add_test(c, a_sole_is_its_foots_alone);
  tcase_add_test(c, sections_without_legs_are_unchanged);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
