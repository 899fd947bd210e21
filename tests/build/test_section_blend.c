#include "build/sections/section_blend.h"

#include <math.h>
#include <string.h>

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
  double max = 0;
  sbfi_arena_init(&arena, NULL, 0);
  sbf_asset *asset = tube(slope, &skin, &arena), *other = tube(authored_slope, &authored, &arena);
  ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
  const sbfi_skin_union before = skin;
  ck_assert(sbfi_section_blend_smooth(&skin, &authored, &t, asset, NULL, NULL, &left, NULL, &arena));
  ck_assert_uint_eq(left, 0);
  for (uint32_t p = 0; p < skin.mesh.positions.count; p++) {
    double weights[2] = {0, 0}, old[2] = {0, 0};
    for (uint32_t h = skin.bone_weight_begins[p]; h < skin.bone_weight_begins[p + 1]; h++)
      weights[skin.bone_weights[h].bone] += (double)skin.bone_weights[h].weight;
    for (uint32_t h = before.bone_weight_begins[p]; h < before.bone_weight_begins[p + 1]; h++)
      old[before.bone_weights[h].bone] += (double)before.bone_weights[h].weight;
    ck_assert_double_eq_tol(weights[0] + weights[1], 1, 1e-5);
    max = fmax(max, fabs(weights[0] - old[0]));
    /* A smoothed step still changes from one bone to the other at the joint. */
    if (skin.mesh.positions.at[p].y < 0.5f) ck_assert_double_gt(weights[0], 0.9);
    if (skin.mesh.positions.at[p].y > 1.5f) ck_assert_double_gt(weights[1], 0.9);
  }
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
  sbf_asset_free(other);
  return max;
}

START_TEST(a_step_becomes_a_slope)
{ ck_assert_double_gt(smoothed(0, 0), 0.1); }
END_TEST

START_TEST(a_gentle_slope_is_unchanged)
{ ck_assert_double_eq(smoothed(0.6f, 0.6f), 0); }
END_TEST

/* Weights steeper than the skin's own may not stretch elements, and yet invert some that its own do not. */
START_TEST(flips_are_detected_with_the_authored_weights)
{
  ck_assert_double_eq(smoothed(0.22f, 0.22f), 0);
  ck_assert_double_gt(smoothed(0.22f, 0.6f), 0.05);
}
END_TEST

/* The same polygons in another order: every seventh, and again. */
static void reorder_polygons(sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  uint32_t count = mesh->polygon_sizes.count, corners = mesh->polygon_points.count;
  uint32_t *points = sbfi_arena_allocate(arena, corners, sizeof *points);
  uint32_t *sizes = sbfi_arena_allocate(arena, count, sizeof *sizes);
  ck_assert(points && sizes);
  uint32_t to = 0, corner = 0;
  for (uint32_t turn = 0; turn < 7; turn++)
    for (uint32_t p = 0, at = 0; p < count; at += mesh->polygon_sizes.at[p++]) {
      if (p % 7 != turn) continue;
      memcpy(points + corner, mesh->polygon_points.at + at, mesh->polygon_sizes.at[p] * sizeof *points);
      corner += sizes[to++] = mesh->polygon_sizes.at[p];
    }
  mesh->polygon_points.at = points;
  mesh->polygon_sizes.at = sizes;
}

/* Weights propagate from triangle to triangle: on a fine skin, sweeps alone leave thousands that tear. */
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
  reorder_polygons(&skin.mesh, &arena);
  const sbfi_skin_union authored = skin;
  ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
  ck_assert(sbfi_section_blend_smooth(&skin, &authored, &t, asset, NULL, NULL, &left, NULL, &arena));
  ck_assert_uint_eq(left, 0);
  /* As on the coarse tube: the slope is no longer than necessary. */
  for (uint32_t p = 0; p < skin.mesh.positions.count; p++) {
    double sum = 0;
    for (uint32_t h = skin.bone_weight_begins[p]; h < skin.bone_weight_begins[p + 1]; h++) {
      sum += (double)skin.bone_weights[h].weight;
      if (skin.mesh.positions.at[p].y < 0.5f) ck_assert_uint_eq(skin.bone_weights[h].bone, 0);
      if (skin.mesh.positions.at[p].y > 1.5f) ck_assert_uint_eq(skin.bone_weights[h].bone, 1);
    }
    ck_assert_double_eq_tol(sum, 1, 1e-5);
  }
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(the_order_of_polygons_changes_nothing)
{
  sbfi_arena arena;
  sbfi_skin_union skins[2];
  uint32_t left;
  sbfi_arena_init(&arena, NULL, 0);
  for (int i = 0; i < 2; i++) {
    sbfi_topology t;
    sbf_asset *asset = tube(0, &skins[i], &arena);
    if (i) reorder_polygons(&skins[i].mesh, &arena);
    const sbfi_skin_union authored = skins[i];
    ck_assert(sbfi_topology_build(&t, &skins[i].mesh, &arena));
    ck_assert(sbfi_section_blend_smooth(&skins[i], &authored, &t, asset, NULL, NULL, &left, NULL, &arena));
    sbf_asset_free(asset);
  }
  uint32_t points = skins[0].mesh.positions.count;
  for (uint32_t p = 0; p <= points; p++)
    ck_assert_uint_eq(skins[0].bone_weight_begins[p], skins[1].bone_weight_begins[p]);
  for (uint32_t h = 0; h < skins[0].bone_weight_begins[points]; h++) {
    ck_assert_uint_eq(skins[0].bone_weights[h].bone, skins[1].bone_weights[h].bone);
    ck_assert_float_eq(skins[0].bone_weights[h].weight, skins[1].bone_weights[h].weight);
  }
  sbfi_arena_free(&arena);
}
END_TEST

/* Points beside a joint that should retain their weights. On one side, the slope moves to the other side. On
 * both sides, there is no space for it, and their weights change. */
START_TEST(fixed_points_keep_their_weights_while_others_can_change)
{
  for (int both = 0; both < 2; both++) {
    sbfi_arena arena;
    sbfi_skin_union skin;
    sbfi_topology t;
    uint32_t left, changed = 0;
    sbfi_arena_init(&arena, NULL, 0);
    sbf_asset *asset = tube(0, &skin, &arena);
    const sbfi_skin_union authored = skin;
    uint32_t points = skin.mesh.positions.count;
    uint8_t *fixed = sbfi_arena_allocate(&arena, points, 1);
    ck_assert_ptr_nonnull(fixed);
    for (uint32_t p = 0; p < points; p++)
      fixed[p] = skin.mesh.positions.at[p].y < 0.95f || (both && skin.mesh.positions.at[p].y > 1.05f);
    ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
    ck_assert(sbfi_section_blend_smooth(&skin, &authored, &t, asset, NULL, fixed, &left, NULL, &arena));
    ck_assert_uint_eq(left, 0);
    for (uint32_t p = 0; p < points; p++)
      changed += fixed[p] && skin.bone_weight_begins[p + 1] - skin.bone_weight_begins[p] != 1;
    ck_assert(both ? changed > 0 : changed == 0);
    sbfi_arena_free(&arena);
    sbf_asset_free(asset);
  }
}
END_TEST

/* Of the steps between four bones, only those at what soft bones hold become slopes. */
START_TEST(vertices_without_soft_bones_keep_their_weights)
{
  sbfi_arena arena;
  sbfi_skin_union skin;
  sbfi_topology t;
  uint32_t left, chosen_count, slope = 0;
  uint8_t chosen[1];
  const uint8_t soft[] = {1, 0, 0, 0};
  sbfi_arena_init(&arena, NULL, 0);
  const skinned_limb of = {.bones = 4, .sides = 16, .rings_a_bone = 20, .radius = 0.1f};
  sbf_asset *asset = skinned_limb_make(&of);
  ck_assert(sbfi_skins_choose(asset, chosen, &chosen_count, &arena));
  ck_assert(sbfi_skin_union_make(&skin, asset, chosen, &arena));
  ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
  const sbfi_skin_union authored = skin;
  ck_assert(sbfi_section_blend_smooth(&skin, &authored, &t, asset, soft, NULL, &left, NULL, &arena));
  ck_assert_uint_eq(left, 0);
  for (uint32_t p = 0; p < skin.mesh.positions.count; p++) {
    uint32_t bones = skin.bone_weight_begins[p + 1] - skin.bone_weight_begins[p];
    if (skin.mesh.positions.at[p].y > 1.5f) ck_assert_uint_eq(bones, 1);
    slope += bones > 1;
  }
  ck_assert_uint_gt(slope, 0);
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
}
END_TEST

/* Points of a scan are noisy: some of its triangles are thin, and contract without end. */
START_TEST(a_noisy_scan_takes_few_checks)
{
  sbfi_arena arena;
  sbfi_skin_union skin;
  sbfi_topology t;
  uint32_t left, chosen_count, random = 1;
  uint8_t chosen[1];
  sbfi_arena_init(&arena, NULL, 0);
  const skinned_limb of = {.bones = 2, .sides = 256, .rings_a_bone = 520, .radius = 0.2f};
  sbf_asset *asset = skinned_limb_make(&of);
  ck_assert(sbfi_skins_choose(asset, chosen, &chosen_count, &arena));
  ck_assert(sbfi_skin_union_make(&skin, asset, chosen, &arena));
  float *coordinates = (float *)(uintptr_t)skin.mesh.positions.at;
  for (uint32_t i = 0; i < 3 * skin.mesh.positions.count; i++) {
    random = 1664525u * random + 1013904223u;
    coordinates[i] += 0.0006f * ((float)(random >> 8) / (float)(1 << 23) - 1);
  }
  ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
  const sbfi_skin_union authored = skin;
  uint64_t checks;
  ck_assert(sbfi_section_blend_smooth(&skin, &authored, &t, asset, NULL, NULL, &left, &checks, &arena));
  uint32_t triangles = 2 * skin.mesh.polygon_sizes.count;
  ck_assert_uint_lt(checks, UINT64_C(16) * triangles); /* without a limit of contractions 34 */
  ck_assert_uint_lt(left, triangles / 400);
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
}
END_TEST

/* 3,000 bones on a skin of 24,000 points: memory grows with the number of influences, not with bones times
 * points. */
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
  ck_assert(sbfi_section_blend_smooth(&skin, &authored, &t, asset, NULL, NULL, &left, NULL, &arena));
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
}
END_TEST

/* As in a damaged file: at this distance single precision cannot tell the weights of bones apart. */
START_TEST(bones_far_from_the_skin_stop_the_iteration_early)
{
  sbfi_arena arena;
  sbfi_skin_union skin;
  sbfi_topology t;
  uint32_t left, chosen_count;
  uint8_t chosen[1];
  sbfi_arena_init(&arena, NULL, 0);
  const skinned_limb of = {.bones = 6, .sides = 32, .rings_a_bone = 20, .radius = 0.2f};
  sbf_asset *asset = skinned_limb_make(&of);
  sbf_bone *bones = (sbf_bone *)(uintptr_t)asset->bones.at;
  for (uint32_t b = 1; b < asset->bones.count; b++) bones[b].head.x = 1e12f * (float)b;
  ck_assert(sbfi_skins_choose(asset, chosen, &chosen_count, &arena));
  ck_assert(sbfi_skin_union_make(&skin, asset, chosen, &arena));
  ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
  const sbfi_skin_union authored = skin;
  uint64_t checks;
  ck_assert(sbfi_section_blend_smooth(&skin, &authored, &t, asset, NULL, NULL, &left, &checks, &arena));
  ck_assert_uint_gt(left, 0);
  /* Without a limit: 1,000 sweeps over most triangles. */
  ck_assert_uint_lt(checks, UINT64_C(100) * t.corner_count);
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("section_blend");
  TCase *c = tcase_create("section_blend");
  tcase_add_test(c, a_step_becomes_a_slope);
  tcase_add_test(c, a_gentle_slope_is_unchanged);
  tcase_add_test(c, flips_are_detected_with_the_authored_weights);
  tcase_add_test(c, a_step_on_a_fine_skin_becomes_a_slope);
  tcase_add_test(c, the_order_of_polygons_changes_nothing);
  tcase_add_test(c, fixed_points_keep_their_weights_while_others_can_change);
  tcase_add_test(c, vertices_without_soft_bones_keep_their_weights);
  tcase_add_test(c, a_noisy_scan_takes_few_checks);
  tcase_add_test(c, memory_does_not_grow_with_bones_times_points);
  tcase_add_test(c, bones_far_from_the_skin_stop_the_iteration_early);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
