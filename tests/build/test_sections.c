#include "build/sections/sections.h"

#include <math.h>
#include <string.h>

#include "harness.h"
#include "promises.h"
#include "sbfmt/build.h"
#include "sbfmt/io.h"
#include "sbfmt/mechanics.h"
#include "sbfmt/validate.h"
#include "shapes.h"
#include "skin_bend.h"
#include "skinned_limb.h"

static const skinned_limb smooth = {
    .bones = 4, .sides = 12, .rings_a_bone = 8, .radius = 0.2f, .slope = 0.5f, .seam = true};
static const double SIXTY_DEG = 1.0471975511965976;

static uint32_t notes_of[1024];

static void take(void *user, const sbf_diagnostic *diagnostic) {
  (void)user;
  notes_of[diagnostic->code % 1024]++;
}

static uint32_t notes(sbf_code code) {
  return notes_of[code % 1024];
}

static sbf_asset *build(const sbf_asset *asset, sbf_build_options options) {
  sbf_asset *built;
  sbf_diagnostic error;
  memset(notes_of, 0, sizeof notes_of);
  options.report = take;
  ck_assert_msg(sbf_build(asset, &options, &built, NULL, &error) == SBF_OK, "%s", error.message);
  ck_assert_promises_kept(built);
  return built;
}

static void forbid(void *user, const sbf_diagnostic *diagnostic) {
  (void)user;
  ck_assert_msg(diagnostic->severity == SBF_SEVERITY_INFO, "%s at %s", diagnostic->message, diagnostic->path);
}

START_TEST(a_limb_becomes_sections)
{
  sbf_asset *asset = skinned_limb_make(&smooth), *built = build(asset, (sbf_build_options){0});
  ck_assert_uint_eq(notes(SBF_CODE_MATERIAL_GUESSED), 1);
  ck_assert_uint_eq(built->soft_bodies.count, 4);
  ck_assert_uint_eq(built->rigid_bodies.count, 4);
  ck_assert_uint_eq(built->joints.count, 3);
  double volume = 0;
  for (uint32_t i = 0; i < 4; i++) {
    const sbf_soft_body *body = &built->soft_bodies.at[i];
    ck_assert_int_eq(body->bone, (int32_t)i);
    ck_assert_int_eq(body->derived, 0);
    sbf_surface_measures whole;
    sbf_surface_measure(&body->surface, NULL, &whole);
    ck_assert_double_lt(whole.opening, 1e-6);
    volume += whole.volume;
    ck_assert_uint_eq(body->levels.count, 1);
    ck_assert_uint_eq(body->levels.at[0].lattice.tetrahedra.count, 0);
  }
  /* The tube's own, and an overlap of half a radius on both sides of three cuts. */
  double area = 12 * 0.5 * 0.2 * 0.2 * 0.5;
  ck_assert_double_ge(volume, 4 * area);
  ck_assert_double_le(volume, (4 + 6 * 0.126) * area);
  sbf_validate(built, &(sbf_validate_options){.report = forbid}, NULL, NULL);
  ck_assert(sbf_asset_equal(asset, asset, NULL, 0));
  sbf_asset_free(built);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(one_skin_over_all)
{
  static const float slopes[] = {0.5f, 0.1f, 0};
  skinned_limb of = smooth;
  of.slope = slopes[_i];
  sbf_asset *asset = skinned_limb_make(&of), *built = build(asset, (sbf_build_options){0});
  skin_bend r;
  skin_bend_measure(built, 0, SIXTY_DEG, &r);
  ck_assert_double_le(r.rest_error, 1e-6);
  ck_assert_double_le(r.crack, 1e-6);
  ck_assert_double_le(r.seam_stretch, 2);
  ck_assert_uint_eq(r.worse_poses, 0);
  ck_assert_uint_gt(r.seam_count, 100);
  ck_assert_uint_eq(notes(SBF_CODE_SECTION_STRETCHED), 0);
  /* A gentle slope is unchanged. A step is detected. */
  if (_i == 0) ck_assert_double_le(r.lbs_distance, 1e-6);
  if (_i == 2) ck_assert_double_gt(r.lbs_stretch, 2);
  sbf_asset_free(built);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(a_second_build_changes_nothing)
{
  sbf_asset *asset = skinned_limb_make(&smooth), *first = build(asset, (sbf_build_options){0});
  sbf_asset *again = build(asset, (sbf_build_options){0}), *rebuilt = build(first, (sbf_build_options){0});
  char where[256] = "";
  ck_assert_msg(sbf_asset_equal(first, again, where, sizeof where), "%s", where);
  ck_assert_msg(sbf_asset_equal(first, rebuilt, where, sizeof where), "%s", where);
  sbf_asset_free(rebuilt);
  sbf_asset_free(again);
  sbf_asset_free(first);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(no_sections_without_the_request)
{
  sbf_asset *asset = skinned_limb_make(&smooth);
  sbf_asset *built = build(asset, (sbf_build_options){.sections = SBF_BUILD_SECTIONS_NONE});
  ck_assert_uint_eq(built->soft_bodies.count, 0);
  ck_assert_str_eq(
      built->derivations.at[0].settings + strlen(built->derivations.at[0].settings) - 13, "sections=none");
  sbf_asset_free(built);
  /* Authored bodies also stay whole: their surfaces lie along the skin. */
  sbf_soft_body *body = sbf_asset_allocate(asset, 1, sizeof *body);
  sbf_soft_body_init(body);
  body->id = "own";
  body->bone = 0;
  body->surface = asset->render_meshes.at[0].mesh;
  body->surface.target = SBF_MESH_TARGET_SURFACE;
  asset->soft_bodies = (sbf_soft_body_list){body, 1};
  built = build(asset, (sbf_build_options){0});
  ck_assert_uint_eq(built->soft_bodies.count, 1);
  sbf_asset_free(built);
  sbf_asset_free(asset);
}
END_TEST

/* A hat is no section: the limb is cut as without it, and no part of the limb's skin is bound to the hat. */
START_TEST(clothes_do_not_cut_the_skin)
{
  sbf_asset *asset = skinned_limb_make(&smooth);
  sbf_asset *bare = build(asset, (sbf_build_options){0});
  sbf_soft_body *hat = sbf_asset_allocate(asset, 1, sizeof *hat);
  sbf_soft_body_init(hat);
  hat->id = hat->name = "hat";
  hat->bone = 0;
  hat->surface = shape_cube(asset, 2, 0.05f, asset->render_meshes.at[0].mesh.positions.at[0]);
  asset->soft_bodies = (sbf_soft_body_list){hat, 1};
  static const sbf_build_sections directions[] = {SBF_BUILD_SECTIONS_AUTOMATIC, SBF_BUILD_SECTIONS_NONE};
  for (int i = 0; i < 2; i++) {
    sbf_asset *built = build(asset, (sbf_build_options){.sections = directions[i]});
    ck_assert_uint_eq(built->soft_bodies.count, 1 + (i == 0 ? bare->soft_bodies.count : 0));
    const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
    for (uint32_t e = 0; e < level->embeddings.count; e++)
      ck_assert_int_eq(level->embeddings.at[e].render_mesh, SBF_NONE);
    sbf_asset_free(built);
  }
  sbf_asset_free(bare);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(a_sliver_joins_and_still_moves)
{
  /* The part that the middle bone pins is compressed to a hundredth of its length. */
  skinned_limb of = smooth;
  of.bones = 3;
  of.slope = 0;
  sbf_asset *asset = skinned_limb_make(&of);
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)asset->render_meshes.at[0].mesh.positions.at;
  for (uint32_t v = 0; v < asset->render_meshes.at[0].mesh.positions.count; v++)
    at[v].y = at[v].y > 2.13f ? at[v].y - 1.125f * 0.99f : at[v].y > 1 ? 1 + 0.01f * (at[v].y - 1) : at[v].y;
  sbf_bone *bones = (sbf_bone *)(uintptr_t)asset->bones.at;
  bones[2].head.y = 1.01f;
  bones[1].length = 0.01f;
  sbf_asset *built = build(asset, (sbf_build_options){0});
  ck_assert_uint_eq(notes(SBF_CODE_SECTION_MERGED), 1);
  ck_assert_uint_eq(built->soft_bodies.count, 2);
  ck_assert_int_eq(built->soft_bodies.at[0].bone, 0);
  ck_assert_int_eq(built->soft_bodies.at[1].bone, 2);
  skin_bend r;
  skin_bend_measure(built, 0, SIXTY_DEG, &r);
  ck_assert_double_le(r.rest_error, 1e-6);
  ck_assert_double_le(r.seam_stretch, 2);
  ck_assert_uint_eq(r.worse_poses, 0);
  sbf_asset_free(built);
  sbf_asset_free(asset);
}
END_TEST

static uint32_t springs_of(const sbf_asset *built, uint32_t body) {
  return built->soft_bodies.at[body].levels.at[0].springs.at[0].ends.count;
}

START_TEST(recipes_state_elements)
{
  sbf_asset *asset = skinned_limb_make(&smooth), *usual = build(asset, (sbf_build_options){0});
  sbf_section_recipe recipes[2];
  for (int i = 0; i < 2; i++) sbf_section_recipe_init(&recipes[i]);
  recipes[0].elements = 40; /* of all without a recipe */
  recipes[1].elements = 1000, recipes[1].bone = 2;
  asset->section_recipes = (sbf_section_recipe_list){recipes, 2};
  sbf_asset *stated = build(asset, (sbf_build_options){0}), *again = build(stated, (sbf_build_options){0});
  sbf_asset *asked = build(asset, (sbf_build_options){.elements = 40}),
            *cells = build(asset, (sbf_build_options){.cell_m = 0.09});
  for (uint32_t i = 0; i < 4; i++) {
    if (i == 2)
      ck_assert_uint_gt(springs_of(stated, i), 2 * springs_of(usual, i));
    else
      ck_assert_uint_lt(3 * springs_of(stated, i), 2 * springs_of(usual, i));
    ck_assert_uint_eq(springs_of(asked, i) == springs_of(stated, i), i != 2); /* options come first */
    ck_assert_float_eq_tol(cells->soft_bodies.at[i].levels.at[0].cell, 0.09f, 1e-6f);
  }
  char where[256] = "";
  ck_assert_msg(sbf_asset_equal(stated, again, where, sizeof where), "%s", where);
  sbf_asset *built;
  sbf_diagnostic error;
  recipes[0].elements = 4000000000;
  ck_assert_int_eq(sbf_build(asset, NULL, &built, NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_LATTICE_TOO_FINE);
  sbf_asset *const all[] = {usual, stated, again, asked, cells, asset};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) sbf_asset_free(all[i]);
}
END_TEST

START_TEST(memory_may_run_out)
{
  skinned_limb of = smooth;
  of.bones = 2;
  of.sides = 6;
  of.rings_a_bone = 3;
  sbf_asset *asset = skinned_limb_make(&of);
  sbf_status status = SBF_FAILED;
  for (size_t allowed = 0; allowed < 4000 && status != SBF_OK; allowed += 1 + allowed / 16) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbf_asset *built;
    sbf_diagnostic error;
    status = sbf_build(asset, &(sbf_build_options){.allocator = &memory.allocator}, &built, NULL, &error);
    if (status == SBF_OK) {
      sbf_asset_free(built);
    } else {
      ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    }
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
  ck_assert_int_eq(status, SBF_OK);
  sbf_asset_free(asset);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("sections");
  TCase *c = tcase_create("sections");
  tcase_add_test(c, a_limb_becomes_sections);
  tcase_add_loop_test(c, one_skin_over_all, 0, 3);
  tcase_add_test(c, a_second_build_changes_nothing);
  tcase_add_test(c, no_sections_without_the_request);
  tcase_add_test(c, clothes_do_not_cut_the_skin);
  tcase_add_test(c, a_sliver_joins_and_still_moves);
  tcase_add_test(c, recipes_state_elements);
  tcase_add_test(c, memory_may_run_out);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
