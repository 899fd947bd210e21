#include "build/lattice/lattice_level.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"
#include "sbfmt/validate.h"
#include "shapes.h"

static sbf_asset *asset;

static void setup(void) {
  asset = sbf_asset_create(NULL);
}
static void teardown(void) {
  sbf_asset_free(asset);
}

static void print(void *user, const sbf_diagnostic *diagnostic) {
  (void)user;
  fprintf(stderr, "%s %s\n", diagnostic->path, diagnostic->message);
}

static sbf_diagnostic findings[16];
static int finding_count;
static void note(void *user, const sbf_diagnostic *diagnostic) {
  (void)user;
  if (finding_count < 16) findings[finding_count++] = *diagnostic;
}
static int count_noted(int code) {
  int count = 0;
  for (int i = 0; i < finding_count; i++) count += findings[i].code == code;
  return count;
}
static bool was_noted(int code) {
  return count_noted(code) > 0;
}
/* The first finding with that code; "" where there is none. */
static const char *message_of(int code) {
  for (int i = 0; i < finding_count; i++)
    if (findings[i].code == code) return findings[i].message;
  return "";
}

static sbf_asset *build(sbf_build_options options, sbf_build_report *report) {
  sbf_asset *built;
  sbf_diagnostic error;
  sbf_validate_result result;
  finding_count = 0;
  options.report = note;
  if (!options.interior) options.interior = SBF_BUILD_INTERIOR_TETRAHEDRA;
  sbf_status status = sbf_build(asset, &options, &built, report, &error);
  ck_assert_msg(status == SBF_OK, "%s (%s)", error.message, error.path);
  ck_assert_uint_eq(sbf_asset_check(built, print, NULL, 0), 0);
  ck_assert_int_eq(sbf_validate(built, &(sbf_validate_options){.report = print}, &result, NULL), SBF_OK);
  ck_assert_uint_eq(result.errors, 0);
  return built;
}

/* Adds a render mesh of the same surface. */
static void add_skin(const sbf_polygon_mesh *mesh) {
  sbf_render_mesh *skin = sbf_asset_allocate(asset, 1, sizeof *skin);
  sbf_render_mesh_init(skin);
  skin->id = skin->name = "skin";
  skin->mesh = *mesh;
  skin->mesh.target = SBF_MESH_TARGET_RENDERING;
  asset->render_meshes = (sbf_render_mesh_list){skin, 1};
}

static sbf_soft_body *add_cube(uint32_t n, bool with_bone) {
  sbf_polygon_mesh cube = shape_cube(asset, n, 0.4f, (sbf_vec3){0, 1, 0});
  add_skin(&cube);
  return shape_add_body(asset, "cube", &cube, with_bone);
}

/* Distance of the embedded vertices from their positions. */
static double misplaced(const sbf_level *level, const sbf_embedding *e, const sbf_vec3_list *positions) {
  double max = 0;
  ck_assert_uint_eq(e->points.count, positions->count);
  for (uint32_t i = 0; i < e->points.count; i++) {
    const float weights[4] = {e->weights.at[i].x, e->weights.at[i].y, e->weights.at[i].z, e->weights.at[i].w};
    double at[3] = {0, 0, 0};
    for (int k = 0; k < 4; k++) {
      sbf_vec3 p = level->positions.at[e->points.at[i].at[k]];
      at[0] += weights[k] * p.x, at[1] += weights[k] * p.y, at[2] += weights[k] * p.z;
    }
    sbf_vec3 p = positions->at[i];
    max = fmax(max, sqrt(pow(at[0] - p.x, 2) + pow(at[1] - p.y, 2) + pow(at[2] - p.z, 2)));
  }
  return max;
}

START_TEST(a_cube_of_tetrahedra)
{
  add_cube(2, false);
  sbf_build_report report;
  sbf_asset *built = build((sbf_build_options){.cell_m = 0.1}, &report);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_int_eq(level->model, SBF_ELASTIC_MODEL_TETRAHEDRA);
  ck_assert_float_eq(level->cell, 0.1f);
  ck_assert_uint_eq(level->lattice.tetrahedra.count, 12 * 64 + 12 * 16);
  ck_assert_uint_eq(report.lattices.tetrahedra, level->lattice.tetrahedra.count);
  ck_assert_double_eq_tol(report.lattices.volume, 0.064, 1e-6);
  ck_assert_double_ge(report.lattices.min_dihedral_deg, 44.9);
  uint64_t angles = 0;
  for (int i = 0; i < 18; i++) angles += report.lattices.dihedrals[i];
  ck_assert_uint_eq(angles, 6 * (uint64_t)report.lattices.tetrahedra);
  ck_assert_double_lt(report.lattices.farthest_m, 1e-6);
  ck_assert_uint_eq(level->springs.count + level->pins.count, 0);
  ck_assert_uint_eq(level->new_from_old.count, 26);
  ck_assert_uint_eq(level->new_from_old.at[25], UINT32_MAX);
  ck_assert_str_eq(built->derivations.at[0].settings,
      "cell_um=100000 embeddings=true flexion=true hulls=true interior=tetrahedra");
  float *masses = sbf_asset_allocate(built, level->positions.count, sizeof *masses);
  ck_assert_double_eq_tol(sbf_level_masses(&built->soft_bodies.at[0], level, NULL, masses), 64, 1e-3);
  ck_assert_uint_eq(level->embeddings.count, 2);
  for (int e = 0; e < 2; e++)
    ck_assert_double_lt(
        misplaced(level, &level->embeddings.at[e], &built->render_meshes.at[0].mesh.positions), 1e-6);
  sbf_asset *again = build((sbf_build_options){.cell_m = 0.1}, NULL);
  ck_assert(sbf_asset_equal(built, again, NULL, 0));
  sbf_asset_free(again);
  sbf_asset_free(built);
}
END_TEST

START_TEST(a_section_is_pinned_in_its_inner_half)
{
  add_cube(2, true);
  sbf_asset *built = build((sbf_build_options){.cell_m = 0.05}, NULL);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_uint_eq(level->pins.count, 1);
  const sbf_pin_set *pins = &level->pins.at[0];
  ck_assert_int_eq(pins->bone, 0);
  uint32_t within = 0;
  for (uint32_t i = 0; i < level->positions.count; i++) {
    sbf_vec3 p = level->positions.at[i];
    within += fmaxf(fabsf(p.x), fmaxf(fabsf(p.y - 1), fabsf(p.z))) < 0.1001f;
  }
  ck_assert_uint_eq(pins->points.count, within);
  sbf_asset_free(built);
}
END_TEST

START_TEST(pins_on_the_surface_are_transferred)
{
  sbf_soft_body *body = add_cube(4, false);
  uint32_t points[40], count = 0;
  for (uint32_t i = 0; i < body->surface.positions.count; i++)
    if (body->surface.positions.at[i].y > 1.19f) points[count++] = i;
  ck_assert_uint_eq(count, 25);
  const float weight = 0.5f;
  sbf_pin_set pins[2];
  sbf_pin_set_init(&pins[0]);
  pins[0].points = (sbf_u32_list){points, count};
  sbf_pin_set_init(&pins[1]);
  pins[1].points = (sbf_u32_list){points, 1}; /* taken already */
  pins[1].weights = (sbf_f32_list){&weight, 1};
  body->pins = (sbf_pin_set_list){pins, 2};
  sbf_asset *built = build((sbf_build_options){.cell_m = 0.1}, NULL);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_uint_eq(level->pins.count, 2);
  ck_assert_uint_eq(level->pins.at[1].points.count, 0);
  const sbf_pin_set *pinned = &level->pins.at[0];
  ck_assert_int_eq(pinned->derived, 0);
  ck_assert_uint_ge(pinned->points.count, 41); /* of the top's 25 corners and 16 middles */
  for (uint32_t i = 0; i < pinned->points.count; i++)
    ck_assert_float_gt(level->positions.at[pinned->points.at[i]].y, 1.1f);
  sbf_asset_free(built);
}
END_TEST

/* A vertex in no polygon, seven body sizes away, is reported. It moves with the body as far as bounded
 * weights allow. */
START_TEST(a_stray_vertex)
{
  sbf_polygon_mesh cube = shape_cube(asset, 4, 0.4f, (sbf_vec3){0, 1, 0});
  uint32_t count = cube.positions.count;
  sbf_vec3 *positions = sbf_asset_allocate(asset, count + 1, sizeof *positions);
  memcpy(positions, cube.positions.at, count * sizeof *positions);
  positions[count] = (sbf_vec3){3, 1, 0.05f};
  cube.positions = (sbf_vec3_list){positions, count + 1};
  add_skin(&cube);
  shape_add_body(asset, "cube", &cube, false);
  sbf_asset *built = build((sbf_build_options){.cell_m = 0.1}, NULL);
  ck_assert_int_eq(count_noted(SBF_CODE_EMBEDDING_FAR), 1);
  const char *said = message_of(SBF_CODE_EMBEDDING_FAR);
  ck_assert_ptr_nonnull(strstr(said, "vertex 98 of render mesh \"skin\" lies more than a cell"));
  ck_assert_ptr_nonnull(strstr(said, "2.8 m from the lattice of soft body \"cube\": it is in no polygon"));
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  for (uint32_t e = 0; e < level->embeddings.count; e++) {
    sbf_vec4 w = level->embeddings.at[e].weights.at[count];
    ck_assert_float_ge(fminf(fminf(w.x, w.y), fminf(w.z, w.w)), -0.501f);
    ck_assert_float_le(fmaxf(fmaxf(w.x, w.y), fmaxf(w.z, w.w)), 1.501f);
    sbf_vec3_list others = {cube.positions.at, count};
    sbf_embedding without = level->embeddings.at[e];
    without.points.count = count;
    ck_assert_double_lt(misplaced(level, &without, &others), 1e-5);
  }
  sbf_asset_free(built);
}
END_TEST

/* A pyramid whose base is a corner of two thin arms. */
static void add_thin_corner(void) {
  const float w = 0.05f, h = 0.3f;
  const sbf_vec3 points[] = {
      {0, 0, 0}, {2, 0, 0}, {2, 0, w}, {w, 0, w}, {w, 0, 2}, {0, 0, 2}, {w / 2, h, w / 2}};
  static const uint32_t sizes[] = {6, 3, 3, 3, 3, 3, 3},
                        corners[] = {0, 1, 2, 3, 4, 5, 1, 0, 6, 2, 1, 6, 3, 2, 6, 4, 3, 6, 5, 4, 6, 0, 5, 6};
  sbf_vec3 *copy = sbf_asset_allocate(asset, 7, sizeof *copy);
  memcpy(copy, points, sizeof points);
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.positions = (sbf_vec3_list){copy, 7};
  mesh.polygon_sizes = (sbf_u32_list){sizes, 7};
  mesh.polygon_points = (sbf_u32_list){corners, 24};
  mesh.target = SBF_MESH_TARGET_SURFACE;
  shape_add_body(asset, "corner", &mesh, false);
}

START_TEST(a_lattice_that_misses_a_tip_is_refined)
{
  enum { OTHERS = 159 }; /* share the elements, so that the first body gets few */
  add_thin_corner();
  sbf_polygon_mesh other = shape_cube(asset, 1, 0.4f, (sbf_vec3){-9, 1, 0});
  for (int i = 0; i < OTHERS; i++) shape_add_body(asset, "other", &other, false);
  const sbf_vec3_list *positions = &asset->soft_bodies.at[0].surface.positions;
  sbf_asset *built = build((sbf_build_options){.without_calibration = true}, NULL);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0],
                  *of_cube = &built->soft_bodies.at[1].levels.at[0];
  ck_assert_uint_lt(of_cube->lattice.tetrahedra.count, 200);
  ck_assert_uint_gt(level->lattice.tetrahedra.count, 200);
  ck_assert_double_lt(misplaced(level, &level->embeddings.at[0], positions), 1e-5);
  sbf_asset_free(built);
  built = build((sbf_build_options){.without_calibration = true, .elements = 100}, NULL);
  ck_assert_uint_lt(built->soft_bodies.at[0].levels.at[0].lattice.tetrahedra.count, 200);
  sbf_asset_free(built);
}
END_TEST

START_TEST(sheets_become_cloth)
{
  sbf_polygon_mesh sheet = shape_sheet(asset, 4, 4);
  shape_add_body(asset, "sheet", &sheet, false);
  sbf_asset *built = build((sbf_build_options){.elements = 500}, NULL);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_int_eq(level->model, SBF_ELASTIC_MODEL_SPRINGS);
  ck_assert_uint_eq(level->lattice.tetrahedra.count, 0);
  ck_assert_uint_eq(level->positions.count, 25);
  sbf_asset_free(built);
}
END_TEST

START_TEST(faults_are_reported)
{
  sbf_soft_body *body = add_cube(2, false);
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)body->surface.positions.at;
  for (uint32_t i = 0; i < body->surface.positions.count; i++) at[i].x *= 0.1f;
  sbf_asset *built = build((sbf_build_options){.cell_m = 0.11}, NULL);
  ck_assert(was_noted(SBF_CODE_LATTICE_THIN) || was_noted(SBF_CODE_LATTICE_EMPTY));
  sbf_asset_free(built);
  built = build((sbf_build_options){.cell_m = 0.015}, NULL);
  ck_assert_int_eq(finding_count, 0);
  sbf_asset_free(built);
  sbf_diagnostic error;
  sbf_build_options fine = {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .cell_m = 1e-5};
  ck_assert_int_eq(sbf_build(asset, &fine, &built, NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_LATTICE_TOO_FINE);
  /* Neither is too fine by itself. */
  sbf_soft_body *more = add_cube(2, false);
  ck_assert_ptr_nonnull(more);
  fine.cell_m = 0;
  fine.elements = 9000000;
  ck_assert_int_eq(sbf_build(asset, &fine, &built, NULL, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_LATTICE_TOO_FINE);
  ck_assert_ptr_nonnull(strstr(error.message, "for all bodies"));
  fine.elements = 0;
  fine.cell_m = -1;
  ck_assert_int_eq(sbf_build(asset, &fine, &built, NULL, &error), SBF_FAILED);
}
END_TEST

/* Real surfaces at 20,000 tetrahedra: recorded values, so that a change shows. No tetrahedra: a flat
 * sheet. */
static const struct {
  const char *name;
  uint32_t tetrahedra, points, thickened;
  double min_deg, max_deg, volume, farthest_cells;
  bool closed, thin; /* thin: reported in parts */
} real[] = {
    {"spot/spot.obj", 19841, 4446, 8, 12.3, 152.9, 0.7122, 0.525, true, false},
    {"bunny/bunny_902.obj", 19433, 4473, 67, 12.9, 151.9, 0.8286, 0.690, true, true},
    {"armadillo/armadillo_25k.obj", 19671, 4885, 74, 12.9, 150.7, 235.5, 0.702, true, true},
    {"soup/suzanne.obj", 19996, 4466, 94, 14.1, 149.4, 2.167, 0.563, false, true},
    {"soup/spider.obj", 20380, 6325, 392, 11.9, 154.6, 143900, 0.797, false, true},
    {"bunny/bunny_holes.obj", 19854, 4428, 43, 14.1, 151.8, 0.0007441, 0.664, false, true},
    {"ngon/concave_polygon.obj", 0, 64, 0, 0, 0, 0, 0, false, false},
    {"cloth/cloth_25.obj", 0, 25, 0, 0, 0, 0, 0, false, false},
    {"cloth/plane_30x30.obj", 0, 961, 0, 0, 0, 0, 0, false, false},
};

/* `build` has validated it: no element is inverted, repeated or overlaps its neighbours. */
static void check_shape(const sbf_level *level, const sbf_build_report *report) {
  sbf_lattice_measures shape;
  sbf_lattice_measure(
      level->positions.at, level->lattice.tetrahedra.at, level->lattice.tetrahedra.count, &shape);
  ck_assert_uint_eq(shape.inverted_count, 0);
  ck_assert_double_ge(shape.min_dihedral_deg, 10);
  ck_assert_double_le(shape.max_dihedral_deg, 165);
  ck_assert_mem_eq(shape.dihedrals, report->lattices.dihedrals, sizeof shape.dihedrals);
  ck_assert_uint_eq(shape.dihedrals[0] + shape.dihedrals[17], 0);
}

static void check_cloth(const sbf_soft_body *body) {
  const sbf_level *level = &body->levels.at[0];
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  ck_assert(measures.sheet);
  ck_assert_int_eq(level->model, SBF_ELASTIC_MODEL_SPRINGS);
  ck_assert_uint_eq(level->positions.count, body->surface.positions.count);
  ck_assert_double_eq_tol(measures.mass,
      measures.area * body->attributes.density * body->attributes.thickness, 1e-6 * measures.mass);
}

START_TEST(real_surfaces)
{
  const char *path = harness_shared(real[_i].name);
  if (!path) return;
  sbf_polygon_mesh mesh = shape_of_obj(asset, path);
  shape_add_body(asset, "body", &mesh, false);
  add_skin(&mesh);
  sbf_build_report report;
  sbf_asset *built = build((sbf_build_options){.elements = 20000}, &report);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  double cell = (double)level->cell;
  ck_assert_uint_eq(report.lattices.tetrahedra, real[_i].tetrahedra);
  if (real[_i].tetrahedra == 0) {
    check_cloth(&built->soft_bodies.at[0]);
  } else {
    check_shape(level, &report);
    ck_assert_uint_eq(level->positions.count, real[_i].points);
    ck_assert_uint_eq(report.lattices.thickened_points, real[_i].thickened);
    ck_assert_double_eq_tol(report.lattices.min_dihedral_deg, real[_i].min_deg, 0.06);
    ck_assert_double_eq_tol(report.lattices.max_dihedral_deg, real[_i].max_deg, 0.06);
    ck_assert_double_eq_tol(report.lattices.volume / real[_i].volume, 1, 1e-3);
    ck_assert_double_eq_tol(report.lattices.farthest_m / cell, real[_i].farthest_cells, 1e-3);
    ck_assert_int_eq(was_noted(SBF_CODE_LATTICE_THIN), real[_i].thin);
    ck_assert_int_eq(was_noted(SBF_CODE_EMBEDDING_FAR), real[_i].farthest_cells > 1);
    ck_assert_double_lt(misplaced(level, &level->embeddings.at[1], &mesh.positions), 1e-5 * 20 * cell);
    sbf_surface_measures surface;
    sbf_surface_measure(&mesh, NULL, &surface);
    float *masses = sbf_asset_allocate(built, level->positions.count, sizeof *masses);
    double mass = sbf_level_masses(&built->soft_bodies.at[0], level, NULL, masses);
    ck_assert_int_eq(surface.opening < 1e-3, real[_i].closed);
    if (real[_i].closed) ck_assert_double_eq_tol(mass / (1000 * surface.volume), 1, 1e-4);
  }
  sbf_asset_free(built);
}
END_TEST

static bool stop_at(void *user, const char *pass, double done) {
  (void)pass;
  int *left = user;
  ck_assert(done >= 0 && done <= 1);
  return --*left >= 0;
}

START_TEST(cancelling_and_failed_allocations_free_everything)
{
  add_cube(1, true);
  sbf_build_options options = {
      .interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .cell_m = 0.2, .without_calibration = true};
  for (int what = 0; what < 2; what++) {
    for (int allowed = 0;; allowed++) {
      int left = allowed;
      harness_memory memory;
      harness_memory_init(&memory, what ? (size_t)allowed : SIZE_MAX);
      options.allocator = &memory.allocator;
      options.progress = what ? NULL : stop_at;
      options.user = &left;
      sbf_asset *built;
      sbf_diagnostic error;
      sbf_status status = sbf_build(asset, &options, &built, NULL, &error);
      if (status == SBF_OK) sbf_asset_free(built);
      ck_assert_uint_eq(memory.held_bytes, 0);
      if (status == SBF_OK) break;
      ck_assert_int_eq(error.code, what ? SBF_CODE_OUT_OF_MEMORY : SBF_CODE_CANCELLED);
      ck_assert_int_lt(allowed, 400);
    }
  }
}
END_TEST

int main(void) {
  Suite *s = suite_create("lattice_level");
  TCase *c = tcase_create("lattice_level");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_cube_of_tetrahedra);
  tcase_add_test(c, a_section_is_pinned_in_its_inner_half);
  tcase_add_test(c, pins_on_the_surface_are_transferred);
  tcase_add_test(c, a_stray_vertex);
  tcase_add_test(c, a_lattice_that_misses_a_tip_is_refined);
  tcase_add_test(c, sheets_become_cloth);
  tcase_add_test(c, faults_are_reported);
  tcase_add_loop_test(c, real_surfaces, 0, (int)(sizeof real / sizeof *real));
  tcase_add_test(c, cancelling_and_failed_allocations_free_everything);
  suite_add_tcase(s, c);
  return harness_run(s);
}
