#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "sbfmt/codes.h"
#include "sbfmt/convert.h"
#include "sbfmt/export.h"
#include "sbfmt/io.h"

static sbf_asset *bar(void) {
  sbf_asset *asset;
  ck_assert_int_eq(
      sbf_convert(harness_source("spec/samples/dialect2012/bar.xml"), NULL, &asset, NULL), SBF_OK);
  return asset;
}

START_TEST(the_2012_dialect_round_trips)
{
  sbf_asset *asset = bar();
  const char *path = harness_scratch("round.xml");
  size_t size, expected_size;
  ck_assert_int_eq(sbf_export(asset, path, NULL, NULL), SBF_OK);
  char *written = harness_read(path, &size);
  char *expected = harness_read(harness_source("spec/samples/dialect2012/bar.xml"), &expected_size);
  ck_assert_ptr_nonnull(written);
  ck_assert_ptr_nonnull(expected);
  ck_assert_uint_eq(size, expected_size);
  ck_assert(memcmp(written, expected, size) == 0);
  free(written);
  free(expected);
  sbf_asset_free(asset);
}
END_TEST

static void keep(void *user, const sbf_diagnostic *diagnostic) {
  *(sbf_diagnostic *)user = *diagnostic;
}

static void keep_first(void *user, const sbf_diagnostic *diagnostic) {
  sbf_diagnostic *first = user;
  if (first->code == 0) *first = *diagnostic;
}

START_TEST(omissions_are_reported)
{
  sbf_asset *asset = bar();
  sbf_diagnostic warning = {0};
  const sbf_export_options options = {.report = keep, .user = &warning};
  ck_assert_int_eq(sbf_export(asset, harness_scratch("bar.tet"), &options, NULL), SBF_OK);
  ck_assert_int_eq(warning.code, SBF_CODE_EXPORT_LEFT_OUT);
  ck_assert_ptr_nonnull(strstr(warning.message, "rigid bodies: 2"));
  sbf_asset_free(asset);
}
END_TEST

/* MJCF's keyframes would need the velocities of all joints and points. */
START_TEST(mjcf_reports_initial_velocities)
{
  sbf_asset *asset = bar();
  sbf_rigid_body *bodies = (sbf_rigid_body *)(uintptr_t)asset->rigid_bodies.at;
  sbf_diagnostic warning = {0};
  const sbf_export_options options = {.report = keep_first, .user = &warning};
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++) {
    bodies[i].motion = i ? SBF_BODY_MOTION_DYNAMIC : SBF_BODY_MOTION_KINEMATIC;
    bodies[i].angular_velocity.y = 1;
  }
  ck_assert_int_eq(sbf_export(asset, harness_scratch("bar.mjcf"), &options, NULL), SBF_OK);
  ck_assert_int_eq(warning.code, SBF_CODE_EXPORT_LEFT_OUT);
  ck_assert_ptr_nonnull(strstr(warning.message, "initial velocities: 1"));
  sbf_asset_free(asset);
}
END_TEST

START_TEST(empty_exports_and_unknown_extensions_are_errors)
{
  sbf_asset *empty = sbf_asset_create(NULL);
  sbf_diagnostic error;
  static const char *const names[] = {"empty.obj", "empty.tet", "empty.xml", "empty.glb", "empty.node",
      "empty.msh", "empty.vtu", "empty.mjcf", "empty.usda"};
  for (int i = 0; i < 9; i++) {
    const char *path = harness_scratch(names[i]);
    size_t size;
    ck_assert_int_eq(sbf_export(empty, path, NULL, &error), SBF_BAD_INPUT);
    ck_assert_int_eq(error.code, SBF_CODE_EXPORT_EMPTY);
    ck_assert_ptr_null(harness_read(path, &size));
  }
  ck_assert_int_eq(sbf_export(empty, "no_ending", NULL, &error), SBF_FAILED);
  ck_assert_int_eq(sbf_export(empty, "a.stl", NULL, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_BAD_CALL);
  const sbf_export_options wrong = {.struct_size = 3};
  ck_assert_int_eq(sbf_export(empty, "a.obj", &wrong, &error), SBF_FAILED);
  sbf_asset_free(empty);
}
END_TEST

/* One render mesh with its own bones, keys, images and clips, and two frames of a motion. */
static sbf_asset *everything(void) {
  sbf_asset *asset;
  ck_assert_int_eq(
      sbf_load_file(harness_source("spec/samples/valid/everything.sbf"), NULL, &asset, NULL), SBF_OK);
  return asset;
}

typedef struct moved {
  sbf_export_motion motion;
  sbf_vec3 skin[2000], heads[100];
  sbf_quat turns[100];
} moved;

/* Frame 0 at rest, frame 1 all of it `by_m` higher. */
static void move(const sbf_asset *asset, float by_m, moved *to) {
  uint32_t points = 0, bones = asset->bones.count;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    points += asset->render_meshes.at[i].mesh.positions.count;
  ck_assert_uint_le(2 * points, 2000);
  ck_assert_uint_le(2 * bones, 100);
  for (uint32_t f = 0; f < 2; f++) {
    uint32_t at = f * points;
    for (uint32_t i = 0; i < asset->render_meshes.count; i++) {
      sbf_vec3_list rest = asset->render_meshes.at[i].mesh.positions;
      for (uint32_t p = 0; p < rest.count; p++, at++) {
        to->skin[at] = rest.at[p];
        to->skin[at].y += (float)f * by_m;
      }
    }
    for (uint32_t b = 0; b < bones; b++) {
      to->heads[f * bones + b] = asset->bones.at[b].head;
      to->heads[f * bones + b].y += (float)f * by_m;
      to->turns[f * bones + b] = asset->bones.at[b].rotation;
    }
  }
  to->motion = (sbf_export_motion){2, 0.5, to->skin, to->heads, to->turns};
}

START_TEST(vertices_that_move_rigidly_need_no_offsets)
{
  /* The file with the motion has two more targets, all zero where bones carry everything. */
  sbf_asset *asset = everything();
  moved m;
  size_t size;
  move(asset, 0.25f, &m);
  const sbf_export_options options = {.motion = &m.motion};
  ck_assert_int_eq(sbf_export(asset, harness_scratch("moved.glb"), &options, NULL), SBF_OK);
  char *bytes = harness_read(harness_scratch("moved.glb"), &size);
  ck_assert_ptr_nonnull(bytes);
  ck_assert(memcmp(bytes, "glTF", 4) == 0);
  uint32_t json = (uint8_t)bytes[12] | (uint32_t)(uint8_t)bytes[13] << 8 | (uint32_t)(uint8_t)bytes[14] << 16;
  bytes[20 + json] = 0;
  ck_assert_ptr_nonnull(strstr(bytes + 20, "\"frame 1\""));
  ck_assert_ptr_null(strstr(bytes + 20, "\"frame 2\""));
  ck_assert_ptr_nonnull(strstr(bytes + 20, "\"path\":\"weights\""));
  free(bytes);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(failed_allocations_are_reported)
{
  sbf_asset *bars = bar(), *all = everything();
  static const char *const names[] = {"memory.obj", "memory.tet", "memory.xml", "memory.glb", "memory.ele",
      "memory.msh", "memory.vtu", "memory.mjcf", "memory.usda"};
  moved m;
  move(all, 0.25f, &m);
  for (int i = 0; i < 9; i++)
    for (size_t allowed = 0;; allowed++) {
      harness_memory memory;
      sbf_diagnostic error;
      harness_memory_init(&memory, allowed);
      const sbf_export_options options = {.allocator = &memory.allocator,
          .motion = &m.motion,
          .folder = harness_source("spec/samples/valid")};
      sbf_status status =
          sbf_export(i == 3 || i >= 7 ? all : bars, harness_scratch(names[i]), &options, &error);
      ck_assert_uint_eq(memory.held_bytes, 0);
      if (status == SBF_OK) break;
      ck_assert_int_eq(status, SBF_FAILED);
      ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
      ck_assert_uint_lt(allowed, 1000);
    }
  sbf_asset_free(bars);
  sbf_asset_free(all);
}
END_TEST

START_TEST(mjcf_is_rotated_and_nests_jointed_bodies)
{
  sbf_asset *asset = bar();
  size_t size;
  ck_assert_int_eq(sbf_export(asset, harness_scratch("bar.mjcf"), NULL, NULL), SBF_OK);
  char *text = harness_read(harness_scratch("bar.mjcf"), &size);
  ck_assert_ptr_nonnull(text);
  text[size - 1] = 0;
  ck_assert_ptr_nonnull(strstr(text, "gravity=\"0 0 -9.81\""));
  ck_assert_ptr_nonnull(strstr(text, ":twist\" type=\"hinge\""));
  ck_assert_ptr_nonnull(strstr(text, "range=\"-0.21816616 0.21816616\""));
  ck_assert_ptr_nonnull(strstr(text, " dim=\"3\""));
  ck_assert_ptr_nonnull(strstr(text, "<freejoint name=\"rigid.1:free\"/>"));
  free(text);
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("export");
  TCase *c = tcase_create("forms");
  tcase_add_test(c, the_2012_dialect_round_trips);
  tcase_add_test(c, omissions_are_reported);
  tcase_add_test(c, mjcf_reports_initial_velocities);
  tcase_add_test(c, empty_exports_and_unknown_extensions_are_errors);
  tcase_add_test(c, vertices_that_move_rigidly_need_no_offsets);
  tcase_add_test(c, mjcf_is_rotated_and_nests_jointed_bodies);
  tcase_add_test(c, failed_allocations_are_reported);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
