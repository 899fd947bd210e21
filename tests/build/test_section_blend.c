#include "build/sections/section_blend.h"

#include <math.h>

#include "harness.h"
#include "skinned_limb.h"

/* A tube of two bones, and its union in `arena`. */
static sbf_asset *tube(float slope, sbfi_skin_union *skin, sbfi_arena *arena) {
  const skinned_limb of = {.bones = 2, .sides = 8, .rings_a_bone = 10, .radius = 0.2f, .slope = slope};
  sbf_asset *asset = skinned_limb_make(&of);
  uint8_t chosen[1];
  uint32_t count;
  ck_assert(sbfi_skins_choose(asset, chosen, &count, arena));
  ck_assert(sbfi_skin_union_make(skin, asset, chosen, arena));
  return asset;
}

/* Smooths a tube that was authored with another slope; the greatest change of a weight. */
static double smoothed(float slope, float authored_slope) {
  sbfi_arena arena;
  sbfi_skin_union skin, authored;
  sbfi_topology t;
  uint32_t left;
  double most = 0;
  sbfi_arena_init(&arena, NULL, 0);
  sbf_asset *asset = tube(slope, &skin, &arena), *other = tube(authored_slope, &authored, &arena);
  ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
  const sbfi_skin_union before = skin;
  ck_assert(sbfi_section_blend_smooth(&skin, &authored, &t, asset, NULL, &left, &arena));
  ck_assert_uint_eq(left, 0);
  for (uint32_t p = 0; p < skin.mesh.positions.count; p++) {
    double weights[2] = {0, 0}, old[2] = {0, 0};
    for (uint32_t h = skin.hold_begins[p]; h < skin.hold_begins[p + 1]; h++)
      weights[skin.holds[h].bone] += (double)skin.holds[h].weight;
    for (uint32_t h = before.hold_begins[p]; h < before.hold_begins[p + 1]; h++)
      old[before.holds[h].bone] += (double)before.holds[h].weight;
    ck_assert_double_eq_tol(weights[0] + weights[1], 1, 1e-5);
    most = fmax(most, fabs(weights[0] - old[0]));
    /* A smoothed step still goes over from one bone to the other about the joint. */
    if (skin.mesh.positions.at[p].y < 0.5f) ck_assert_double_gt(weights[0], 0.9);
    if (skin.mesh.positions.at[p].y > 1.5f) ck_assert_double_gt(weights[1], 0.9);
  }
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
  sbf_asset_free(other);
  return most;
}

START_TEST(a_step_becomes_a_slope)
{ ck_assert_double_gt(smoothed(0, 0), 0.1); }
END_TEST

START_TEST(a_gentle_slope_stays)
{ ck_assert_double_eq(smoothed(0.6f, 0.6f), 0); }
END_TEST

/* Steeper weights than the skin's own may stretch nothing and yet turn over what its own do not. */
START_TEST(flips_are_judged_by_the_weights_as_authored)
{
  ck_assert_double_eq(smoothed(0.22f, 0.22f), 0);
  ck_assert_double_gt(smoothed(0.22f, 0.6f), 0.05);
}
END_TEST

/* Weights go from triangle to triangle: on a fine skin sweeps alone leave thousands that tear. */
START_TEST(a_step_on_a_fine_skin_becomes_a_slope)
{
  sbfi_arena arena;
  sbfi_skin_union skin;
  sbfi_topology t;
  uint32_t left, chosen_count;
  uint8_t chosen[1];
  sbfi_arena_init(&arena, NULL, 0);
  const skinned_limb of = {.bones = 2, .sides = 128, .rings_a_bone = 400, .radius = 0.2f};
  sbf_asset *asset = skinned_limb_make(&of);
  ck_assert(sbfi_skins_choose(asset, chosen, &chosen_count, &arena));
  ck_assert(sbfi_skin_union_make(&skin, asset, chosen, &arena));
  ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
  const sbfi_skin_union authored = skin;
  ck_assert(sbfi_section_blend_smooth(&skin, &authored, &t, asset, NULL, &left, &arena));
  ck_assert_uint_eq(left, 0);
  /* As on the coarse tube: the slope is no longer than it has to be. */
  for (uint32_t p = 0; p < skin.mesh.positions.count; p++) {
    double sum = 0;
    for (uint32_t h = skin.hold_begins[p]; h < skin.hold_begins[p + 1]; h++) {
      sum += (double)skin.holds[h].weight;
      if (skin.mesh.positions.at[p].y < 0.5f) ck_assert_uint_eq(skin.holds[h].bone, 0);
      if (skin.mesh.positions.at[p].y > 1.5f) ck_assert_uint_eq(skin.holds[h].bone, 1);
    }
    ck_assert_double_eq_tol(sum, 1, 1e-5);
  }
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
}
END_TEST

/* 3,000 bones on a skin of 24,000 points: memory grows with what holds them, not with bones times points. */
START_TEST(memory_does_not_grow_with_bones_times_points)
{
  sbfi_arena arena;
  sbfi_skin_union skin;
  sbfi_topology t;
  uint32_t left, chosen_count;
  uint8_t chosen[1];
  sbfi_arena_init(&arena, NULL, 64 << 20);
  const skinned_limb of = {.bones = 3000, .sides = 4, .rings_a_bone = 2, .radius = 0.2f, .slope = 1};
  sbf_asset *asset = skinned_limb_make(&of);
  ck_assert(sbfi_skins_choose(asset, chosen, &chosen_count, &arena));
  ck_assert(sbfi_skin_union_make(&skin, asset, chosen, &arena));
  ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
  const sbfi_skin_union authored = skin;
  ck_assert(sbfi_section_blend_smooth(&skin, &authored, &t, asset, NULL, &left, &arena));
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("section_blend");
  TCase *c = tcase_create("section_blend");
  tcase_add_test(c, a_step_becomes_a_slope);
  tcase_add_test(c, a_gentle_slope_stays);
  tcase_add_test(c, flips_are_judged_by_the_weights_as_authored);
  tcase_add_test(c, a_step_on_a_fine_skin_becomes_a_slope);
  tcase_add_test(c, memory_does_not_grow_with_bones_times_points);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
