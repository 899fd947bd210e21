#include "build/sections/section_labels.h"

#include "harness.h"
#include "skinned_limb.h"

static sbf_asset *asset;
static sbfi_arena arena;
static sbfi_skin_union skin;
static sbfi_topology t;
static uint32_t *labels;

static void label(const skinned_limb *of) {
  uint8_t chosen[1];
  uint32_t count;
  asset = skinned_limb_make(of);
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_skins_choose(asset, chosen, &count, &arena));
  ck_assert(sbfi_skin_union_make(&skin, asset, chosen, &arena));
  ck_assert(sbfi_topology_build(&t, &skin.mesh, &arena));
  labels = sbfi_arena_allocate(&arena, t.polygon_count, sizeof *labels);
  ck_assert(sbfi_section_labels_make(labels, &skin, &t, asset->bones.count, &arena));
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

START_TEST(borders_follow_rings)
{
  /* Weights change from column to column half a ring up and down: the border still is one ring. */
  const skinned_limb of = {
      .bones = 3, .sides = 12, .rings_a_bone = 5, .radius = 0.2f, .slope = 0.6f, .rag = 0.06f};
  label(&of);
  for (uint32_t r = 0; r < 15; r++)
    for (uint32_t c = 1; c < 12; c++) ck_assert_uint_eq(labels[12 * r + c], labels[12 * r]);
  for (uint32_t r = 0; r < 15; r++) {
    /* A ring on either side of the joint may go to either. */
    if (r % 5 == 0 || r % 5 == 4) continue;
    ck_assert_uint_eq(labels[12 * r], r / 5);
  }
  ck_assert_uint_eq(labels[15 * 12], 0);
  ck_assert_uint_eq(labels[15 * 12 + 1], 2);
}
END_TEST

START_TEST(a_speck_joins_its_surroundings)
{
  const skinned_limb of = {.bones = 2, .sides = 12, .rings_a_bone = 8, .radius = 0.2f};
  label(&of);
  /* One vertex in the middle of the lower bone's part belongs to the upper one. */
  sbfi_bone_weight *holds = skin.bone_weights + skin.bone_weight_begins[12 * 4 + 3];
  ck_assert_uint_eq(skin.bone_weight_begins[12 * 4 + 4] - skin.bone_weight_begins[12 * 4 + 3], 1);
  ck_assert_uint_eq(holds[0].bone, 0);
  holds[0].bone = 1;
  ck_assert(sbfi_section_labels_make(labels, &skin, &t, asset->bones.count, &arena));
  for (uint32_t r = 0; r < 7; r++)
    for (uint32_t c = 0; c < 12; c++) ck_assert_uint_eq(labels[12 * r + c], 0);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("section_labels");
  TCase *c = tcase_create("section_labels");
  tcase_add_checked_fixture(c, NULL, teardown);
  tcase_add_test(c, borders_follow_rings);
  tcase_add_test(c, a_speck_joins_its_surroundings);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
