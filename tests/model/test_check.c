#include "model/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fill_asset.h"
#include "harness.h"

/* An asset to break, and the finding that the check then makes. */
typedef struct broken {
  sbf_asset *asset;
  sbf_diagnostic first;
  uint32_t count;
} broken;

static broken fresh(uint64_t seed) {
  return (broken){.asset = fill_asset(&(fill_options){.seed = seed})};
}

static void keep_first(void *user, const sbf_diagnostic *diagnostic) {
  broken *b = user;
  if (b->count++ == 0) b->first = *diagnostic;
}

static void expect(broken *b, sbf_code code, const char *path, int64_t index) {
  b->count = 0;
  uint32_t found = sbf_asset_check(b->asset, keep_first, b, 0);
  ck_assert_uint_eq(found, b->count);
  ck_assert_uint_gt(found, 0);
  ck_assert_msg(b->first.code == (int32_t)code, "code %d, not %d: %s: %s", b->first.code, (int)code,
      b->first.path, b->first.message);
  ck_assert_str_eq(b->first.path, path);
  ck_assert_int_eq(b->first.index, index);
  ck_assert_int_eq(b->first.severity, SBF_SEVERITY_ERROR);
  sbf_asset_free(b->asset);
}

/* Read-only by type, but the test made them. */
#define WRITABLE(type, list, i) (&((type *)(uintptr_t)(list).at)[i])

START_TEST(test_filled_assets_are_sound_and_complete)
{
  for (uint64_t seed = 0; seed < 20; seed++) {
    broken b = fresh(seed);
    char field[128] = "";
    ck_assert_msg(fill_is_complete(b.asset, field, sizeof field), "%s is never filled", field);
    uint32_t found = sbf_asset_check(b.asset, keep_first, &b, 0);
    ck_assert_msg(found == 0, "seed %d: %s: %s", (int)seed, b.first.path, b.first.message);
    sbf_asset_free(b.asset);
  }
}
END_TEST

START_TEST(test_empty_asset_is_sound)
{
  sbf_asset *asset = sbf_asset_create(NULL);
  ck_assert_uint_eq(sbf_asset_check(asset, NULL, NULL, 0), 0);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_numbers)
{
  broken b = fresh(1);
  b.asset->environment.gravity.y = NAN;
  expect(&b, SBF_CODE_VALUE_NOT_FINITE, "/sbf/environment/@gravity", -1);

  b = fresh(1);
  b.asset->environment.control_tick = 0; /* its range is open there */
  expect(&b, SBF_CODE_VALUE_OUT_OF_RANGE, "/sbf/environment/@control_tick", -1);

  b = fresh(1);
  b.asset->environment.control_tick = 1; /* and closed there */
  ck_assert_uint_eq(sbf_asset_check(b.asset, NULL, NULL, 0), 0);
  b.asset->environment.control_tick = nextafterf(1, 2);
  expect(&b, SBF_CODE_VALUE_OUT_OF_RANGE, "/sbf/environment/@control_tick", -1);

  b = fresh(1);
  WRITABLE(sbf_material, b.asset->materials, 1)->base_color.z = -0.25f;
  expect(&b, SBF_CODE_VALUE_OUT_OF_RANGE, "/sbf/materials/material[2]/@base_color", -1);

  b = fresh(1);
  WRITABLE(sbf_vec3, b.asset->soft_bodies.at[1].surface.positions, 5)->z = -INFINITY;
  expect(&b, SBF_CODE_VALUE_NOT_FINITE, "/sbf/soft_body[2]/polygon_mesh/positions", 5);

  b = fresh(1);
  WRITABLE(float, b.asset->render_meshes.at[0].skin->weights, 3)[0] = 1.5f;
  expect(&b, SBF_CODE_VALUE_OUT_OF_RANGE, "/sbf/render_mesh[1]/skin/weights", 3);

  b = fresh(1);
  const sbf_level *level = &b.asset->soft_bodies.at[0].levels.at[1];
  *WRITABLE(uint32_t, level->regions->sizes, 2) = 0;
  expect(&b, SBF_CODE_VALUE_OUT_OF_RANGE, "/sbf/soft_body[1]/level[2]/shape_regions/sizes", 2);
}
END_TEST

START_TEST(test_texts)
{
  broken b = fresh(2);
  b.asset->info.title = "caf\xe9";
  expect(&b, SBF_CODE_NOT_UTF8, "/sbf/asset/@title", -1);

  b = fresh(2);
  b.asset->info.title = "bell \a";
  expect(&b, SBF_CODE_BAD_TEXT, "/sbf/asset/@title", -1);

  b = fresh(2);
  b.asset->info.title = "not a character \xef\xbf\xbf";
  expect(&b, SBF_CODE_BAD_TEXT, "/sbf/asset/@title", -1);

  b = fresh(2);
  WRITABLE(sbf_extension, b.asset->extensions, 1)->data = "\x01";
  expect(&b, SBF_CODE_BAD_TEXT, "/sbf/extensions/extension[2]/data", -1);

  b = fresh(2);
  WRITABLE(sbf_author, b.asset->info.authors, 0)->name = "";
  expect(&b, SBF_CODE_REQUIRED_MISSING, "/sbf/asset/author[1]/@name", -1);
}
END_TEST

START_TEST(test_ids)
{
  broken b = fresh(3);
  WRITABLE(sbf_pose, b.asset->poses, 0)->id = "";
  expect(&b, SBF_CODE_ID_EMPTY, "/sbf/poses/pose[1]/@id", -1);

  b = fresh(3);
  char equal[200]; /* equal, not the same */
  snprintf(equal, sizeof equal, "%s", b.asset->joints.at[3].id);
  WRITABLE(sbf_pose, b.asset->poses, 0)->id = equal;
  expect(&b, SBF_CODE_ID_REPEATED, "/sbf/poses/pose[1]/@id", -1);
  ck_assert_ptr_nonnull(strstr(b.first.message, "/sbf/joints/spherical_joint[1]"));

  b = fresh(3); /* deeper than the collections of the root */
  WRITABLE(sbf_force_field, b.asset->environment.fields, 1)->id = b.asset->environment.fields.at[0].id;
  expect(&b, SBF_CODE_ID_REPEATED, "/sbf/environment/force_field[2]/@id", -1);
}
END_TEST

START_TEST(test_references)
{
  broken b = fresh(4);
  WRITABLE(sbf_render_mesh, b.asset->render_meshes, 0)->bone = (int32_t)b.asset->bones.count;
  expect(&b, SBF_CODE_INDEX_OUT_OF_RANGE, "/sbf/render_mesh[1]/@bone", -1);

  b = fresh(4);
  WRITABLE(sbf_render_mesh, b.asset->render_meshes, 0)->bone = -2;
  expect(&b, SBF_CODE_INDEX_OUT_OF_RANGE, "/sbf/render_mesh[1]/@bone", -1);

  b = fresh(4);
  WRITABLE(sbf_joint, b.asset->joints, 4)->body_b = SBF_NONE;
  expect(&b, SBF_CODE_REQUIRED_MISSING, "/sbf/joints/point_on_line_joint[1]/@body_b", -1);

  b = fresh(4);
  WRITABLE(sbf_bone, b.asset->bones, 1)->parent = 1; /* itself */
  expect(&b, SBF_CODE_BONE_ORDER, "/sbf/skeleton/bone[2]/@parent", -1);

  b = fresh(4);
  WRITABLE(sbf_bone, b.asset->bones, 0)->parent = 1; /* a cycle */
  expect(&b, SBF_CODE_BONE_ORDER, "/sbf/skeleton/bone[1]/@parent", -1);
}
END_TEST

START_TEST(test_enums_and_fixed_values)
{
  broken b = fresh(5);
  WRITABLE(sbf_material, b.asset->materials, 0)->alpha_mode = (sbf_alpha_mode)SBF_ALPHA_MODE_COUNT;
  expect(&b, SBF_CODE_ENUM_OUT_OF_RANGE, "/sbf/materials/material[1]/@alpha_mode", -1);

  b = fresh(5);
  WRITABLE(sbf_render_mesh, b.asset->render_meshes, 1)->mesh.target = SBF_MESH_TARGET_SURFACE;
  expect(&b, SBF_CODE_FIXED_VALUE, "/sbf/render_mesh[2]/polygon_mesh/@target", -1);
}
END_TEST

START_TEST(test_lengths)
{
  broken b = fresh(6);
  WRITABLE(sbf_soft_body, b.asset->soft_bodies, 0)->surface.polygon_points.count--;
  expect(&b, SBF_CODE_WRONG_LENGTH, "/sbf/soft_body[1]/polygon_mesh/polygon_points", -1);
  ck_assert_ptr_nonnull(strstr(b.first.message, "sum(polygon_sizes)"));

  b = fresh(6); /* a length that the parent's size gives */
  WRITABLE(sbf_weight_map, b.asset->soft_bodies.at[0].weight_maps, 1)->values.count--;
  expect(&b, SBF_CODE_WRONG_LENGTH, "/sbf/soft_body[1]/weight_map[2]/values", -1);

  b = fresh(6); /* one of several */
  sbf_spring_set *set = WRITABLE(sbf_spring_set, b.asset->soft_bodies.at[0].levels.at[0].springs, 0);
  set->stiffness.count = 0;
  set->damping.count = 1;
  set->damping.at = set->rest_lengths.at;
  ck_assert_uint_eq(sbf_asset_check(b.asset, NULL, NULL, 0), 0);
  set->damping.count = 2;
  expect(&b, SBF_CODE_WRONG_LENGTH, "/sbf/soft_body[1]/level[1]/spring_set[1]/damping", -1);

  b = fresh(6);
  WRITABLE(sbf_soft_body, b.asset->soft_bodies, 0)->interior.at = NULL;
  expect(&b, SBF_CODE_WRONG_LENGTH, "/sbf/soft_body[1]/interior", -1);
}
END_TEST

START_TEST(test_indices)
{
  broken b = fresh(7);
  sbf_level *level = WRITABLE(sbf_level, b.asset->soft_bodies.at[1].levels, 0);
  WRITABLE(sbf_uint2, level->springs.at[1].ends, 4)->at[1] = level->positions.count;
  expect(&b, SBF_CODE_INDEX_OUT_OF_RANGE, "/sbf/soft_body[2]/level[1]/spring_set[2]/ends", 4);

  b = fresh(7); /* into the root */
  *WRITABLE(uint32_t, b.asset->bone_masks.at[0].bones, 6) = UINT32_MAX;
  expect(&b, SBF_CODE_INDEX_OUT_OF_RANGE, "/sbf/bone_masks/bone_mask[1]/bones", 6);

  b = fresh(7); /* into nothing */
  WRITABLE(sbf_render_mesh, b.asset->render_meshes, 0)->material_slots.count = 0;
  expect(&b, SBF_CODE_INDEX_OUT_OF_RANGE, "/sbf/render_mesh[1]/polygon_materials", 0);
}
END_TEST

START_TEST(test_tetrahedra)
{
  broken b = fresh(8);
  sbf_level *level = WRITABLE(sbf_level, b.asset->soft_bodies.at[1].levels, 1);
  sbf_uint4 *p = WRITABLE(sbf_uint4, level->lattice.tetrahedra, 3);
  uint32_t kept = p->at[0];
  p->at[0] = p->at[1];
  p->at[1] = kept;
  expect(&b, SBF_CODE_TETRAHEDRON_INVERTED, "/sbf/soft_body[2]/level[2]/tetrahedron_mesh/tetrahedra", 3);

  b = fresh(8);
  p = WRITABLE(sbf_uint4, b.asset->soft_bodies.at[1].levels.at[1].lattice.tetrahedra, 0);
  p->at[2] = p->at[3];
  expect(&b, SBF_CODE_TETRAHEDRON_INVERTED, "/sbf/soft_body[2]/level[2]/tetrahedron_mesh/tetrahedra", 0);
}
END_TEST

START_TEST(test_version)
{
  broken b = fresh(9);
  b.asset->version = "2.0";
  expect(&b, SBF_CODE_VERSION_TOO_NEW, "/sbf/@version", -1);
  b = fresh(9);
  b.asset->version = "one";
  expect(&b, SBF_CODE_VALUE_OUT_OF_RANGE, "/sbf/@version", -1);
}
END_TEST

START_TEST(test_all_faults_or_the_first_few)
{
  broken b = fresh(10);
  b.asset->environment.gravity.y = NAN;
  b.asset->environment.wind.x = INFINITY;
  b.asset->info.title = "\xff";
  ck_assert_uint_eq(sbf_asset_check(b.asset, keep_first, &b, 0), 3);
  ck_assert_uint_eq(b.count, 3);
  ck_assert_uint_eq(sbf_asset_check(b.asset, keep_first, &b, 2), 2);
  ck_assert_uint_eq(b.count, 5);
  sbf_asset_free(b.asset);
}
END_TEST

START_TEST(test_first_fault_gives_the_status)
{
  broken b = fresh(11);
  sbf_load_options options = fill_load_options(b.asset);
  sbf_diagnostic error = {0};
  ck_assert_int_eq(sbfi_check_saved(b.asset, &error), SBF_OK);
  ck_assert_int_eq(sbfi_check_loaded(b.asset, &options, &error), SBF_OK);
  ck_assert_int_eq(sbfi_check_loaded(b.asset, NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_EXTENSION_REQUIRED);
  ck_assert_str_eq(error.path, "/sbf/extensions/extension[1]");
  b.asset->environment.gravity.y = NAN;
  ck_assert_int_eq(sbfi_check_saved(b.asset, NULL), SBF_BAD_INPUT);
  sbf_asset_free(b.asset);
}
END_TEST

START_TEST(test_memory_runs_out)
{
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, SIZE_MAX);
    broken b = {.asset = fill_asset(&(fill_options){.seed = 12, .allocator = &memory.allocator})};
    size_t pinned = memory.held_bytes;
    memory.allowed = memory.calls + allowed;
    uint32_t found = sbf_asset_check(b.asset, keep_first, &b, 0);
    ck_assert_uint_eq(memory.held_bytes, pinned);
    if (found) ck_assert_int_eq(b.first.code, SBF_CODE_OUT_OF_MEMORY);
    memory.allowed = SIZE_MAX;
    sbf_asset_free(b.asset);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (!found) break;
    ck_assert_uint_lt(allowed, 100);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("check");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_filled_assets_are_sound_and_complete);
  tcase_add_test(all, test_empty_asset_is_sound);
  tcase_add_test(all, test_numbers);
  tcase_add_test(all, test_texts);
  tcase_add_test(all, test_ids);
  tcase_add_test(all, test_references);
  tcase_add_test(all, test_enums_and_fixed_values);
  tcase_add_test(all, test_lengths);
  tcase_add_test(all, test_indices);
  tcase_add_test(all, test_tetrahedra);
  tcase_add_test(all, test_version);
  tcase_add_test(all, test_all_faults_or_the_first_few);
  tcase_add_test(all, test_first_fault_gives_the_status);
  tcase_add_test(all, test_memory_runs_out);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
