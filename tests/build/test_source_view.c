#include "build/source_view.h"

#include <stddef.h>
#include <string.h>

#include "fill_asset.h"
#include "harness.h"
#include "model/element_path.h"

/* How many elements below a place are marked derived. */
static uint32_t count_derived(const sbfi_element_path *path) {
  uint32_t count = 0;
  for (uint32_t f = 0; f < path->element->field_count; f++) {
    const sbfi_field *field = &path->element->fields[f];
    if (field->type == SBFI_REF && strstr(field->name, "derived"))
      count += sbfi_get_integer(path->object, field) != SBF_NONE;
    for (uint32_t i = 0; i < sbfi_child_count(path->object, field); i++) {
      sbfi_element_path child = sbfi_element_path_child(path, field, i);
      count += count_derived(&child);
    }
  }
  return count;
}

START_TEST(a_source_view_has_no_derived_parts)
{
  uint32_t before = 0;
  for (uint64_t seed = 1; seed < 6; seed++) {
    sbf_asset *filled = fill_asset(&(fill_options){.seed = seed});
    sbfi_arena arena;
    sbfi_arena_init(&arena, NULL, 0);
    sbf_asset view;
    ck_assert(sbfi_source_view(filled, &arena, &view));
    sbfi_element_path root = sbfi_element_path_root(filled), seen = sbfi_element_path_root(&view);
    before += count_derived(&root);
    ck_assert_uint_eq(count_derived(&seen), 0);
    ck_assert_uint_eq(view.derivations.count, 0);
    ck_assert_uint_eq(view.bones.count, filled->bones.count);
    ck_assert_uint_eq(view.clips.count, filled->clips.count);
    sbfi_arena_free(&arena);
    sbf_asset_free(filled);
  }
  ck_assert_uint_gt(before, 0);
}
END_TEST

START_TEST(a_source_view_has_all_source_parts)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_rigid_body rigid[2];
  sbf_polygon_mesh hull;
  sbf_polygon_mesh_init(&hull);
  for (int i = 0; i < 2; i++) {
    sbf_rigid_body_init(&rigid[i]);
    rigid[i].id = i ? "b" : "a";
    rigid[i].hull = &hull;
  }
  asset->rigid_bodies = (sbf_rigid_body_list){rigid, 2};
  sbfi_arena arena;
  sbfi_arena_init(&arena, NULL, 0);
  sbf_asset view;
  ck_assert(sbfi_source_view(asset, &arena, &view));
  ck_assert(sbf_asset_equal(asset, &view, NULL, 0));
  rigid[1].hull_derived = 0; /* authored, its hull derived */
  ck_assert(sbfi_source_view(asset, &arena, &view));
  ck_assert_uint_eq(view.rigid_bodies.count, 2);
  ck_assert_ptr_nonnull(view.rigid_bodies.at[0].hull);
  ck_assert_ptr_null(view.rigid_bodies.at[1].hull);
  ck_assert_ptr_nonnull(asset->rigid_bodies.at[1].hull);
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(references_follow)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_joint joint;
  sbf_joint_init(&joint);
  joint.id = "joint";
  joint.body_a = 0;
  joint.body_b = 2;
  asset->joints = (sbf_joint_list){&joint, 1};
  const int32_t derived[] = {0, SBF_NONE, SBF_NONE};
  int32_t indices[3];
  sbfi_find_source_indices(derived, 3, sizeof *derived, 0, indices);
  ck_assert_int_eq(indices[0], SBF_NONE);
  ck_assert_int_eq(indices[1], 0);
  ck_assert_int_eq(indices[2], 1);
  sbfi_renumbering by = {offsetof(sbf_asset, rigid_bodies), indices, 3};
  sbfi_lost_reference lost;
  ck_assert(sbfi_references_renumber(asset, &by, 1, &lost));
  ck_assert_int_eq(joint.body_a, SBF_NONE); /* may be absent */
  ck_assert_int_eq(joint.body_b, 1);
  joint.body_b = 0; /* may not */
  ck_assert(!sbfi_references_renumber(asset, &by, 1, &lost));
  ck_assert_ptr_nonnull(strstr(lost.path, "joint"));
  ck_assert_str_eq(lost.collection, "rigid_bodies");
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("source_view");
  TCase *c = tcase_create("source_view");
  tcase_add_test(c, a_source_view_has_no_derived_parts);
  tcase_add_test(c, a_source_view_has_all_source_parts);
  tcase_add_test(c, references_follow);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
