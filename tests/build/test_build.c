#include "sbfmt/build.h"

#include <stdio.h>
#include <string.h>

#include "build/source_reading.h"
#include "fill_asset.h"
#include "harness.h"
#include "sbfmt/io.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

static sbf_asset *asset;

static void setup(void) {
  asset = sbf_asset_create(NULL);
}
static void teardown(void) {
  sbf_asset_free(asset);
}

static sbf_asset *build(const sbf_asset *from, const sbf_build_options *options, sbf_build_report *report) {
  sbf_asset *built = NULL;
  sbf_diagnostic error;
  sbf_status status = sbf_build(from, options, &built, report, &error);
  ck_assert_msg(status == SBF_OK, "%s (%s)", error.message, error.path);
  return built;
}

static void print(void *user, const sbf_diagnostic *diagnostic) {
  (void)user;
  fprintf(stderr, "%s %s\n", diagnostic->path, diagnostic->message);
}

static void check_structure(const sbf_asset *built) {
  ck_assert_uint_eq(sbf_asset_check(built, print, NULL, 0), 0);
}

START_TEST(reference_lizard)
{
  const char *path = harness_shared("lizard/liz.obj");
  if (!path) return;
  shape_sections_of_obj(asset, path);
  sbf_build_report report;
  sbf_asset *built = build(asset, NULL, &report);
  check_structure(built);
  ck_assert_uint_eq(report.bodies, 18);
  ck_assert_uint_eq(report.interior_points, 506);
  ck_assert_uint_eq(report.springs[SBF_SPRING_KIND_STRUCTURAL], 977);
  ck_assert_uint_eq(report.springs[SBF_SPRING_KIND_SHEAR], 976);
  ck_assert_uint_eq(report.springs[SBF_SPRING_KIND_INTERNAL], 2965 - 488);
  ck_assert_uint_eq(report.inert_springs, 488);
  ck_assert_uint_eq(report.pins, 506);
  ck_assert_uint_eq(report.hulls, 18);
  ck_assert_uint_eq(report.warnings, 0);
  uint32_t structural = 0, inert = 0, internal = 0;
  for (uint32_t i = 0; i < 18; i++) {
    const sbf_level *level = &built->soft_bodies.at[i].levels.at[0];
    for (uint32_t s = 0; s < level->springs.count; s++) {
      const sbf_spring_set *set = &level->springs.at[s];
      if (set->kind == SBF_SPRING_KIND_STRUCTURAL) structural += set->ends.count;
      if (set->kind == SBF_SPRING_KIND_INTERNAL) internal += set->ends.count;
      inert += set->inert_count;
      ck_assert_uint_eq(set->stiffness.count, set->ends.count);
      for (uint32_t k = 0; k < set->stiffness.count; k++) ck_assert_float_gt(set->stiffness.at[k], 0);
    }
    ck_assert_uint_eq(level->embeddings.count, 1); /* its own surface */
  }
  ck_assert_uint_eq(structural, 977);
  ck_assert_uint_eq(internal, 2477);
  ck_assert_uint_eq(inert, 488);
  sbf_asset_free(built);
}
END_TEST

static void add_skin_of(sbf_asset *to, const sbf_polygon_mesh *mesh, int32_t bone) {
  sbf_render_mesh *skin = sbf_asset_allocate(to, 1, sizeof *skin);
  sbf_render_mesh_init(skin);
  skin->id = skin->name = "skin";
  skin->bone = bone;
  skin->mesh = *mesh;
  skin->mesh.target = SBF_MESH_TARGET_RENDERING;
  to->render_meshes = (sbf_render_mesh_list){skin, 1};
}

static void add_cube(sbf_asset *to) {
  sbf_polygon_mesh cube = shape_cube(to, 2, 0.2f, (sbf_vec3){0, 1, 0});
  shape_add_body(to, "cube", &cube, true);
  add_skin_of(to, &cube, 0);
}

START_TEST(a_cube_in_full)
{
  add_cube(asset);
  sbf_build_report report;
  sbf_asset *built = build(asset, NULL, &report);
  check_structure(built);
  ck_assert_uint_eq(built->derivations.count, 1);
  ck_assert_str_eq(
      built->derivations.at[0].settings, "embeddings=true flexion=true hulls=true interior=automatic");
  ck_assert_uint_eq(report.interior_points, 25);
  ck_assert_uint_eq(report.springs[SBF_SPRING_KIND_STRUCTURAL], 48);
  ck_assert_uint_eq(report.springs[SBF_SPRING_KIND_SHEAR], 48);
  ck_assert_uint_eq(report.springs[SBF_SPRING_KIND_INTERNAL], 26 + 96);
  ck_assert_uint_eq(report.inert_springs, 24);
  ck_assert_uint_eq(report.embedded_vertices, 26);
  ck_assert_uint_eq(built->rigid_bodies.count, 1);
  const sbf_rigid_body *box = &built->rigid_bodies.at[0];
  ck_assert_str_eq(box->id, "hull_body0");
  ck_assert_uint_eq(box->hull->polygon_sizes.count, 6);
  ck_assert_float_eq_tol(box->mass, 8, 1e-4f);
  ck_assert_float_eq_tol(box->center.y, 1, 1e-5f);
  ck_assert_float_eq_tol(box->inertia.x, 8 * 0.04f / 6, 1e-5f);
  /* Pins are at the positions given in the bone's frame. */
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_uint_eq(level->pins.count, 1);
  const sbf_pin_set *pins = &level->pins.at[0];
  ck_assert_int_eq(pins->bone, 0);
  sbf_vec3 head = built->bones.at[0].head, at = level->positions.at[pins->points.at[3]],
           offset = pins->offsets.at[3];
  /* The bone's rotation takes x to y, y to z and z to x. */
  ck_assert_float_eq_tol(head.x + offset.z, at.x, 1e-6f);
  ck_assert_float_eq_tol(head.y + offset.x, at.y, 1e-6f);
  ck_assert_float_eq_tol(head.z + offset.y, at.z, 1e-6f);
  sbf_asset_free(built);
}
END_TEST

START_TEST(building_twice_changes_nothing)
{
  add_cube(asset);
  sbf_polygon_mesh sheet = shape_sheet(asset, 3, 3);
  shape_add_body(asset, "sheet", &sheet, false);
  sbf_asset *once = build(asset, NULL, NULL), *twice = build(once, NULL, NULL),
            *again = build(asset, NULL, NULL);
  char path[256] = "";
  ck_assert_msg(sbf_asset_equal(once, again, path, sizeof path), "%s", path);
  ck_assert_msg(sbf_asset_equal(once, twice, path, sizeof path), "%s", path);
  sbf_asset_free(once);
  sbf_asset_free(twice);
  sbf_asset_free(again);
}
END_TEST

START_TEST(the_hash_covers_the_source_that_was_read)
{
  add_cube(asset);
  sbf_asset *built = build(asset, NULL, NULL);
  char first[65], hash[65];
  snprintf(first, sizeof first, "%s", built->derivations.at[0].source_hash);
  ck_assert_uint_eq(strlen(first), 64);
  ck_assert_int_eq(sbfi_build_source_hash(built, hash, NULL), SBF_OK);
  ck_assert_str_eq(hash, first);
  built->environment.gravity.y = -1; /* not read */
  ck_assert_int_eq(sbfi_build_source_hash(built, hash, NULL), SBF_OK);
  ck_assert_str_eq(hash, first);
  sbf_soft_body body = built->soft_bodies.at[0];
  body.attributes.density = 999;
  built->soft_bodies.at = &body;
  ck_assert_int_eq(sbfi_build_source_hash(built, hash, NULL), SBF_OK);
  ck_assert_str_ne(hash, first);
  sbf_asset_free(built);
}
END_TEST

START_TEST(settings_are_applied)
{
  add_cube(asset);
  sbf_build_options options = {.without_flexion = true,
      .without_hulls = true,
      .without_embeddings = true,
      .interior = SBF_BUILD_INTERIOR_NONE,
      .tool = "a test"};
  sbf_build_report report;
  sbf_asset *built = build(asset, &options, &report);
  ck_assert_str_eq(built->derivations.at[0].tool, "a test");
  ck_assert_uint_eq(report.interior_points + report.hulls + report.embedded_vertices + report.pins, 0);
  ck_assert_uint_eq(report.springs[SBF_SPRING_KIND_FLEXION], 0);
  ck_assert_uint_eq(built->soft_bodies.at[0].levels.at[0].springs.count, 2);
  ck_assert_uint_eq(built->rigid_bodies.count, 0);
  sbf_asset_free(built);
}
END_TEST

START_TEST(sheets_and_free_bodies)
{
  sbf_polygon_mesh sheet = shape_sheet(asset, 4, 4), cube = shape_cube(asset, 2, 0.2f, (sbf_vec3){0, 0, 0});
  shape_add_body(asset, "sheet", &sheet, false);
  shape_add_body(asset, "cube", &cube, false);
  sbf_asset *built = build(asset, NULL, NULL);
  check_structure(built);
  const sbf_level *cloth = &built->soft_bodies.at[0].levels.at[0],
                  *ball = &built->soft_bodies.at[1].levels.at[0];
  ck_assert_uint_eq(cloth->positions.count, 25);
  ck_assert_uint_eq(cloth->pins.count, 0);
  ck_assert_int_eq(cloth->model, SBF_ELASTIC_MODEL_SPRINGS);
  /* A body without bones is filled with about 2000 tetrahedra. */
  ck_assert_int_eq(ball->model, SBF_ELASTIC_MODEL_TETRAHEDRA);
  ck_assert_uint_gt(ball->lattice.tetrahedra.count, 1000);
  ck_assert_uint_lt(ball->lattice.tetrahedra.count, 4000);
  ck_assert_uint_eq(ball->pins.count, 0);
  ck_assert_uint_eq(built->rigid_bodies.count, 0); /* no bones, no hulls */
  float masses[4096];
  ck_assert_uint_le(ball->positions.count, 4096);
  ck_assert_double_eq_tol(sbf_level_masses(&built->soft_bodies.at[1], ball, NULL, masses), 8, 1e-3);
  sbf_asset_free(built);
}
END_TEST

START_TEST(authored_parts_are_kept)
{
  add_cube(asset);
  sbf_polygon_mesh second = shape_cube(asset, 1, 0.3f, (sbf_vec3){1, 1, 0});
  sbf_soft_body *body = shape_add_body(asset, "own", &second, true);
  sbf_level level;
  sbf_level_init(&level);
  level.positions = second.positions;
  body->levels = (sbf_level_list){&level, 1};
  const uint32_t points[] = {1, 4};
  sbf_pin_set pins;
  sbf_pin_set_init(&pins);
  pins.points = (sbf_u32_list){points, 2};
  body->pins = (sbf_pin_set_list){&pins, 1};
  sbf_rigid_body rigid;
  sbf_rigid_body_init(&rigid);
  rigid.id = "mine";
  rigid.bone = 1;
  rigid.mass = 5;
  asset->rigid_bodies = (sbf_rigid_body_list){&rigid, 1};
  sbf_asset *built = build(asset, NULL, NULL), *twice = build(built, NULL, NULL);
  check_structure(built);
  const sbf_level *kept = &built->soft_bodies.at[1].levels.at[0];
  ck_assert_int_eq(kept->derived, SBF_NONE);
  ck_assert_uint_eq(kept->springs.count, 0);
  ck_assert_uint_eq(kept->pins.count, 1);
  ck_assert_int_eq(kept->pins.at[0].derived, 0);
  ck_assert_uint_eq(kept->embeddings.count, 1);
  ck_assert_uint_eq(built->rigid_bodies.count, 2);
  ck_assert_str_eq(built->rigid_bodies.at[0].id, "mine");
  ck_assert_float_eq(built->rigid_bodies.at[0].mass, 5);
  ck_assert_int_eq(built->rigid_bodies.at[0].derived, SBF_NONE);
  ck_assert_int_eq(built->rigid_bodies.at[0].hull_derived, 0);
  ck_assert(sbf_asset_equal(built, twice, NULL, 0));
  sbf_asset_free(built);
  sbf_asset_free(twice);
}
END_TEST

START_TEST(references_to_derived_parts_are_found_again)
{
  add_cube(asset);
  sbf_polygon_mesh second = shape_cube(asset, 1, 0.3f, (sbf_vec3){1, 1, 0});
  shape_add_body(asset, "second", &second, true);
  sbf_asset *built = build(asset, NULL, NULL);
  ck_assert_uint_eq(built->rigid_bodies.count, 2);
  sbf_joint joint;
  sbf_joint_init(&joint);
  joint.id = "joint";
  joint.body_b = 1;
  built->joints = (sbf_joint_list){&joint, 1};
  /* An authored rigid body without a bone is listed before the hulls. */
  sbf_rigid_body rigid[3] = {{0}};
  sbf_rigid_body_init(&rigid[0]);
  rigid[0].id = "mine";
  memcpy(rigid + 1, built->rigid_bodies.at, 2 * sizeof *rigid);
  built->rigid_bodies = (sbf_rigid_body_list){rigid, 3};
  joint.body_b = 2;
  sbf_asset *twice = build(built, NULL, NULL);
  check_structure(twice);
  ck_assert_str_eq(twice->rigid_bodies.at[twice->joints.at[0].body_b].id, "hull_body1");

  sbf_build_options options = {.without_hulls = true};
  sbf_asset *none = NULL;
  sbf_diagnostic error;
  ck_assert_int_eq(sbf_build(built, &options, &none, NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_DERIVED_LOST);
  ck_assert_ptr_nonnull(strstr(error.path, "joint"));
  ck_assert_ptr_null(none);
  sbf_asset_free(built);
  sbf_asset_free(twice);
}
END_TEST

START_TEST(any_sound_asset_builds)
{
  for (uint64_t seed = 1; seed <= 12; seed++) {
    sbf_asset *filled = fill_asset(&(fill_options){.seed = seed}), *built;
    sbf_diagnostic error;
    sbf_status status = sbf_build(filled, NULL, &built, NULL, &error);
    if (status == SBF_OK)
      check_structure(built);
    else
      ck_assert_int_eq(error.code, SBF_CODE_DERIVED_LOST);
    sbf_asset_free(built);
    sbf_asset_free(filled);
  }
}
END_TEST

START_TEST(excessive_sizes_are_refused)
{
  sbf_polygon_mesh cube = shape_cube(asset, 2, 1e30f, (sbf_vec3){0, 0, 0});
  shape_add_body(asset, "huge", &cube, true);
  sbf_asset *built;
  sbf_diagnostic error;
  ck_assert_int_eq(sbf_build(asset, NULL, &built, NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_VALUE_NOT_FINITE);
  ck_assert_str_ne(error.path, "");
  ck_assert_ptr_null(built);
}
END_TEST

static int warnings[8], warning_count;
static void note(void *user, const sbf_diagnostic *diagnostic) {
  (void)user;
  if (warning_count < 8) warnings[warning_count++] = diagnostic->code;
}

START_TEST(warnings_name_missing_parts)
{
  sbf_polygon_mesh sheet = shape_sheet(asset, 2, 2), nothing;
  sbf_polygon_mesh_init(&nothing);
  nothing.target = SBF_MESH_TARGET_SURFACE;
  shape_add_body(asset, "flat", &sheet, true);
  shape_add_body(asset, "empty", &nothing, true);
  sbf_polygon_mesh cube = shape_cube(asset, 1, 1, (sbf_vec3){1, 1, 1});
  add_skin_of(asset, &cube, 0);
  sbf_build_options options = {.report = note};
  sbf_build_report report;
  warning_count = 0;
  sbf_asset *built = build(asset, &options, &report);
  check_structure(built);
  ck_assert_uint_eq(report.warnings, 3);
  ck_assert_int_eq(warnings[0], SBF_CODE_HULL_FLAT);
  ck_assert_int_eq(warnings[1], SBF_CODE_BODY_WITHOUT_POINTS);
  ck_assert_int_eq(warnings[2], SBF_CODE_EMBEDDING_FLAT);
  sbf_asset_free(built);
}
END_TEST

static bool stop_at(void *user, const char *pass, double done) {
  (void)pass;
  ck_assert(done >= 0 && done <= 1);
  int *left = user;
  return --*left >= 0;
}

START_TEST(cancelling_frees_everything)
{
  add_cube(asset);
  for (int allowed = 0;; allowed += HARNESS_FEW(1, 5)) {
    int left = allowed;
    harness_memory memory;
    harness_memory_init(&memory, SIZE_MAX);
    sbf_build_options options = {.allocator = &memory.allocator, .progress = stop_at, .user = &left};
    sbf_asset *built;
    sbf_diagnostic error;
    sbf_status status = sbf_build(asset, &options, &built, NULL, &error);
    if (status == SBF_OK) {
      ck_assert_int_gt(allowed, 4);
      sbf_asset_free(built);
      break;
    }
    ck_assert_int_eq(error.code, SBF_CODE_CANCELLED);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  add_cube(asset);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbf_build_options options = {.allocator = &memory.allocator};
    sbf_asset *built;
    sbf_diagnostic error;
    sbf_status status = sbf_build(asset, &options, &built, NULL, &error);
    if (status == SBF_OK) {
      sbf_asset_free(built);
      ck_assert_uint_eq(memory.held_bytes, 0);
      ck_assert_uint_gt(allowed, 5);
      break;
    }
    ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    ck_assert_ptr_null(built);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

/* The cost of a scene of many bodies is less than proportional to their number. */
START_TEST(bodies_without_a_stated_size_divide_the_default)
{
  enum { BODIES = 40 };
  const uint32_t alone[] = {1, BODIES};
  uint32_t tetrahedra[2];
  for (uint32_t k = 0; k < 2; k++) {
    teardown();
    setup();
    for (uint32_t i = 0; i < alone[k]; i++) {
      sbf_polygon_mesh cube = shape_cube(asset, 2, 0.2f, (sbf_vec3){(float)i, 1, 0});
      char *name = sbf_asset_allocate(asset, 16, 1);
      snprintf(name, 16, "c%u", (unsigned)i);
      shape_add_body(asset, name, &cube, false);
    }
    sbf_build_report report;
    sbf_build_options options = {.without_calibration = true};
    sbf_asset *built = build(asset, &options, &report);
    tetrahedra[k] = report.lattices.tetrahedra;
    sbf_asset_free(built);
  }
  ck_assert_uint_gt(tetrahedra[0], 1000);
  ck_assert_uint_lt(tetrahedra[1], BODIES * tetrahedra[0] / 3);
  ck_assert_uint_gt(tetrahedra[1], 100 * BODIES / 2);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("build");
  TCase *c = tcase_create("build");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, reference_lizard);
  tcase_add_test(c, bodies_without_a_stated_size_divide_the_default);
  tcase_add_test(c, a_cube_in_full);
  tcase_add_test(c, building_twice_changes_nothing);
  tcase_add_test(c, the_hash_covers_the_source_that_was_read);
  tcase_add_test(c, settings_are_applied);
  tcase_add_test(c, sheets_and_free_bodies);
  tcase_add_test(c, authored_parts_are_kept);
  tcase_add_test(c, references_to_derived_parts_are_found_again);
  tcase_add_test(c, any_sound_asset_builds);
  tcase_add_test(c, excessive_sizes_are_refused);
  tcase_add_test(c, warnings_name_missing_parts);
  tcase_add_test(c, cancelling_frees_everything);
  tcase_add_test(c, every_allocation_may_fail);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
