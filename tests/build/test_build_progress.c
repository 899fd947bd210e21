/* A progress callback receives increasing progress, and can cancel the build at any call. */
#include <stdio.h>
#include <string.h>

#include "harness.h"
#include "sbfmt/build.h"
#include "shapes.h"
#include "skinned_limb.h"

typedef struct listener {
  int left; /* calls until it ends the build; below 0: never */
  int calls;
  double done;
  bool fell_back;
} listener;

static bool listen(void *user, const char *pass, double done) {
  listener *l = user;
  ck_assert_ptr_nonnull(pass);
  ck_assert(done >= 0 && done <= 1);
  l->fell_back |= done < l->done;
  l->done = done;
  l->calls++;
  return l->left < 0 || l->left-- > 0;
}

/* Cancels the build at its first call, then at the one `step` later, and so on. Each time the build reports
 * it and frees everything. */
static int end_everywhere(const sbf_asset *from, int step, sbf_build_options options) {
  for (int allowed = 0;; allowed += step) {
    listener l = {.left = allowed};
    harness_memory memory;
    harness_memory_init(&memory, SIZE_MAX);
    options.allocator = &memory.allocator;
    options.progress = listen;
    options.user = &l;
    sbf_asset *built;
    sbf_diagnostic error = {.code = SBF_CODE_NONE};
    sbf_status status = sbf_build(from, &options, &built, NULL, &error);
    if (status == SBF_OK) {
      ck_assert(l.done == 1);
      sbf_asset_free(built);
      return allowed;
    }
    ck_assert_int_eq(status, SBF_FAILED);
    ck_assert_int_eq(error.code, SBF_CODE_CANCELLED);
    ck_assert_ptr_null(built);
    ck_assert_uint_eq(memory.held_bytes, 0);
    ck_assert_int_eq(l.calls, allowed + 1); /* after a cancellation it does not call again */
  }
}

static sbf_asset *ball(void) {
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_polygon_mesh cube = shape_cube(asset, 8, 1, (sbf_vec3){0, 0, 0});
  shape_add_body(asset, "ball", &cube, false);
  sbf_render_mesh *mesh = sbf_asset_allocate(asset, 1, sizeof *mesh);
  sbf_render_mesh_init(mesh);
  mesh->id = mesh->name = "seen";
  mesh->mesh = cube;
  mesh->mesh.target = SBF_MESH_TARGET_RENDERING;
  asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  return asset;
}

START_TEST(springs_on_a_grid)
{
  sbf_asset *asset = ball();
  /* 4,600 nodes: each loop over them calls twice. */
  int calls = end_everywhere(asset, HARNESS_FEW(1, 5),
      (sbf_build_options){.interior = SBF_BUILD_INTERIOR_LATTICE, .cell_m = 0.075, .without_hulls = true});
  ck_assert_int_ge(calls, 24);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(tetrahedra_and_their_levels)
{
  sbf_asset *asset = ball();
  sbf_build_options options = {
      .interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = 400, .without_calibration = true};
  ck_assert_int_ge(end_everywhere(asset, HARNESS_FEW(1, 5), options), 30);
  /* The reference is slow: cancels while it is made, and while it is loaded. */
  options.without_calibration = false;
  options.levels = 3;
  ck_assert_int_ge(end_everywhere(asset, HARNESS_FEW(40, 200), options), 60);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(render_levels)
{
  sbf_asset *asset = ball();
  int without = end_everywhere(asset, 1, (sbf_build_options){.interior = SBF_BUILD_INTERIOR_NONE});
  int with =
      end_everywhere(asset, 1, (sbf_build_options){.interior = SBF_BUILD_INTERIOR_NONE, .render_levels = 2});
  ck_assert_int_ge(with, without + 10);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(sections_of_a_skin)
{
  sbf_asset *asset = skinned_limb_make(
      &(skinned_limb){.bones = 4, .sides = 8, .rings_a_bone = 4, .radius = 0.2f, .slope = 0.4f});
  int calls = end_everywhere(asset, HARNESS_FEW(1, 5), (sbf_build_options){0});
  ck_assert_int_ge(calls, 30); /* cuts, hulls, springs and embeddings of each */
  sbf_asset_free(asset);
}
END_TEST

START_TEST(progress_increases)
{
  sbf_asset *asset = ball();
  listener l = {.left = -1};
  sbf_asset *built;
  sbf_build_options options = {
      .interior = SBF_BUILD_INTERIOR_LATTICE, .progress = listen, .user = &l, .render_levels = 2};
  ck_assert_int_eq(sbf_build(asset, &options, &built, NULL, NULL), SBF_OK);
  ck_assert(!l.fell_back && l.done == 1);
  sbf_asset_free(built);
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("build_progress");
  TCase *c = tcase_create("build_progress");
  tcase_add_test(c, springs_on_a_grid);
  tcase_add_test(c, tetrahedra_and_their_levels);
  tcase_add_test(c, render_levels);
  tcase_add_test(c, sections_of_a_skin);
  tcase_add_test(c, progress_increases);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
