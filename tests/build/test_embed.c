#include "build/embed/embed.h"

#include <string.h>

#include "harness.h"
#include "promises.h"
#include "sbfmt/build.h"
#include "shapes.h"

/* Three cubes on bones 0 (root), 1 and 2, in a row along x; bone 3 is a leaf of 2, bone 4 another root. */
static sbf_asset *asset;
static sbf_bone bones[5];
static sbf_render_mesh mesh;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  for (int i = 0; i < 3; i++) {
    sbf_polygon_mesh cube = shape_cube(asset, 2, 1, (sbf_vec3){(float)i, 0, 0});
    shape_add_body(asset, "cube", &cube, true);
  }
  static const char *const ids[] = {"b0", "b1", "b2", "b3", "b4"};
  const int32_t parents[] = {SBF_NONE, 0, 1, 2, SBF_NONE};
  for (int i = 0; i < 5; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = ids[i];
    bones[i].parent = parents[i];
  }
  asset->bones = (sbf_bone_list){bones, 5};
  sbf_render_mesh_init(&mesh);
  mesh.id = "mesh";
  asset->render_meshes = (sbf_render_mesh_list){&mesh, 1};
}

static void teardown(void) {
  sbf_asset_free(asset);
}

static sbf_asset *build(sbf_build_report *report) {
  sbf_asset *built;
  sbf_diagnostic error;
  ck_assert_int_eq(sbf_build(asset, NULL, &built, report, &error), SBF_OK);
  ck_assert_promises_kept(built);
  return built;
}

/* The body's embedding of the mesh; NULL: none. */
static const sbf_embedding *embedding_of(const sbf_asset *built, uint32_t body) {
  const sbf_level *level = &built->soft_bodies.at[body].levels.at[0];
  for (uint32_t i = 0; i < level->embeddings.count; i++)
    if (level->embeddings.at[i].render_mesh == 0) return &level->embeddings.at[i];
  return NULL;
}

START_TEST(a_skin_follows_its_weights)
{
  const sbf_vec3 positions[] = {{0, 0.5f, 0}, {0.5f, 0.5f, 0}, {2.4f, 0.5f, 0}, {0.5f, 0, 0.5f}, {9, 9, 9}};
  const uint32_t counts[] = {1, 2, 2, 3, 1};
  /* 0: bone 0 alone. 1: bones 0 and 1. 2: bone 3, which has no body and so counts as bone 2, twice. 3: three
   * bones, one of them without a body on it or its parents. 4: that one alone. */
  const uint32_t pinned_by[] = {0, 0, 1, 3, 2, 0, 1, 4, 4};
  const float weights[] = {1, 0.25f, 0.75f, 0.4f, 0.6f, 0.3f, 0.3f, 0.4f, 1};
  sbf_skin skin = {{counts, 5}, {pinned_by, 9}, {weights, 9}};
  mesh.mesh.positions = (sbf_vec3_list){positions, 5};
  mesh.skin = &skin;
  sbf_build_report report;
  sbf_asset *built = build(&report);
  ck_assert_uint_eq(report.embedded_vertices, 4);
  const sbf_embedding *first = embedding_of(built, 0), *second = embedding_of(built, 1),
                      *third = embedding_of(built, 2);
  const uint32_t of_first[] = {0, 1, 3}, of_second[] = {1, 3};
  ck_assert_uint_eq(first->vertices.count, 3);
  ck_assert_mem_eq(first->vertices.at, of_first, sizeof of_first);
  ck_assert_float_eq(first->blends.at[0], 1);
  ck_assert_float_eq_tol(first->blends.at[1], 0.25f, 1e-6f);
  ck_assert_float_eq_tol(first->blends.at[2], 0.5f, 1e-6f);
  ck_assert_uint_eq(second->vertices.count, 2);
  ck_assert_mem_eq(second->vertices.at, of_second, sizeof of_second);
  ck_assert_float_eq_tol(second->blends.at[0], 0.75f, 1e-6f);
  ck_assert_uint_eq(third->vertices.count, 1);
  ck_assert_uint_eq(third->vertices.at[0], 2);
  ck_assert_uint_eq(third->blends.count, 0); /* it alone: 1 */
  sbf_asset_free(built);
}
END_TEST

START_TEST(a_mesh_on_a_bone_is_embedded_in_one_body)
{
  mesh.mesh = asset->soft_bodies.at[1].surface;
  mesh.mesh.target = SBF_MESH_TARGET_RENDERING;
  mesh.bone = 1;
  sbf_build_report report;
  sbf_asset *built = build(&report);
  ck_assert_uint_eq(report.embedded_vertices, 26);
  ck_assert_ptr_null(embedding_of(built, 0));
  const sbf_embedding *embedding = embedding_of(built, 1);
  ck_assert_uint_eq(embedding->vertices.count, 0);
  ck_assert_uint_eq(embedding->blends.count, 0);
  ck_assert_uint_eq(embedding->points.count, 26);
  ck_assert_int_eq(embedding->derived, 0);
  for (uint32_t i = 0; i < 26; i++) {
    for (int k = 0; k < 4; k++) ck_assert_uint_eq(embedding->points.at[i].at[k], i);
    ck_assert(embedding->weights.at[i].x == 1);
  }
  sbf_asset_free(built);
}
END_TEST

START_TEST(a_mesh_on_a_leaf_bone_embeds_in_its_ancestors_body)
{
  mesh.mesh.positions = asset->soft_bodies.at[2].surface.positions;
  mesh.bone = 3;
  sbf_asset *built = build(NULL);
  ck_assert_ptr_nonnull(embedding_of(built, 2));
  sbf_asset_free(built);
}
END_TEST

START_TEST(a_mesh_without_bones_embeds_in_the_nearest_body)
{
  const sbf_vec3 positions[] = {{-0.6f, 0, 0}, {2.6f, 0, 0}, {1, 0.6f, 0}, {0, 0.7f, 0}};
  mesh.mesh.positions = (sbf_vec3_list){positions, 4};
  sbf_asset *built = build(NULL);
  const uint32_t of_first[] = {0, 3};
  ck_assert_uint_eq(embedding_of(built, 0)->vertices.count, 2);
  ck_assert_mem_eq(embedding_of(built, 0)->vertices.at, of_first, sizeof of_first);
  ck_assert_uint_eq(embedding_of(built, 1)->vertices.at[0], 2);
  ck_assert_uint_eq(embedding_of(built, 2)->vertices.at[0], 1);
  sbf_asset_free(built);
}
END_TEST

START_TEST(a_body_carries_its_own_render_mesh)
{
  /* Two cubes that share a face: the second's mesh goes to the second, also where they touch. */
  mesh.mesh = asset->soft_bodies.at[1].surface;
  mesh.mesh.target = SBF_MESH_TARGET_RENDERING;
  sbf_asset *built = build(NULL);
  ck_assert_ptr_null(embedding_of(built, 0));
  ck_assert_ptr_null(embedding_of(built, 2));
  ck_assert_uint_eq(embedding_of(built, 1)->points.count, 26);
  sbf_asset_free(built);
}
END_TEST

START_TEST(a_mesh_outside_all_bodies_is_not_embedded)
{
  const sbf_vec3 position = {0, 0, 0};
  mesh.mesh.positions = (sbf_vec3_list){&position, 1};
  mesh.bone = 4;
  sbf_build_report report;
  sbf_asset *built = build(&report);
  ck_assert_uint_eq(report.embedded_vertices, 0);
  ck_assert_uint_eq(report.warnings, 1);
  sbf_asset_free(built);
}
END_TEST

START_TEST(authored_embeddings_are_kept)
{
  sbf_level level;
  sbf_level_init(&level);
  level.positions = asset->soft_bodies.at[0].surface.positions;
  const sbf_uint4 points = {{4, 5, 6, 7}};
  const sbf_vec4 weights = {0.25f, 0.25f, 0.25f, 0.25f};
  const uint32_t vertex = 0;
  sbf_embedding own;
  sbf_embedding_init(&own);
  own.render_mesh = 0;
  own.vertices = (sbf_u32_list){&vertex, 1};
  own.points = (sbf_uint4_list){&points, 1};
  own.weights = (sbf_vec4_list){&weights, 1};
  level.embeddings = (sbf_embedding_list){&own, 1};
  sbf_soft_body bodies[3];
  memcpy(bodies, asset->soft_bodies.at, sizeof bodies);
  bodies[0].levels = (sbf_level_list){&level, 1};
  asset->soft_bodies.at = bodies;
  mesh.mesh.positions = bodies[0].surface.positions;
  mesh.bone = 0;
  sbf_asset *built = build(NULL);
  const sbf_embedding *embedding = embedding_of(built, 0);
  ck_assert_int_eq(embedding->derived, SBF_NONE);
  ck_assert_uint_eq(embedding->points.count, 1);
  ck_assert_uint_eq(built->soft_bodies.at[0].levels.at[0].embeddings.count, 2); /* and the surface's */
  sbf_asset_free(built);
}
END_TEST

START_TEST(of_two_bodies_on_a_bone_the_nearer)
{
  sbf_soft_body bodies[3];
  memcpy(bodies, asset->soft_bodies.at, sizeof bodies);
  bodies[2].bone = 0;
  asset->soft_bodies.at = bodies;
  const sbf_vec3 positions[] = {{0, 0.6f, 0}, {2, 0.6f, 0}};
  mesh.mesh.positions = (sbf_vec3_list){positions, 2};
  mesh.bone = 0;
  sbf_asset *built = build(NULL);
  ck_assert_uint_eq(embedding_of(built, 0)->vertices.at[0], 0);
  ck_assert_uint_eq(embedding_of(built, 2)->vertices.at[0], 1);
  sbf_asset_free(built);
}
END_TEST

static void check_place(const sbf_level *level, const sbf_embedding *embedding, uint32_t i, sbf_vec3 p) {
  const float w[4] = {embedding->weights.at[i].x, embedding->weights.at[i].y, embedding->weights.at[i].z,
      embedding->weights.at[i].w};
  float at[3] = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    sbf_vec3 q = level->positions.at[embedding->points.at[i].at[k]];
    ck_assert_float_ge(w[k], -0.501f);
    ck_assert_float_le(w[k], 1.501f);
    at[0] += w[k] * q.x, at[1] += w[k] * q.y, at[2] += w[k] * q.z;
  }
  ck_assert_float_eq_tol(at[0], p.x, 1e-4f);
  ck_assert_float_eq_tol(at[1], p.y, 1e-4f);
  ck_assert_float_eq_tol(at[2], p.z, 1e-4f);
}

static bool is_pinned_to(const sbf_level *level, uint32_t point, int32_t bone) {
  for (uint32_t s = 0; s < level->pins.count; s++)
    for (uint32_t i = 0; i < level->pins.at[s].points.count; i++)
      if (level->pins.at[s].points.at[i] == point && level->pins.at[s].bone == bone) return true;
  return false;
}

/* A sword in the hand: its tip is twenty hands away. */
START_TEST(vertices_far_from_a_pinned_body_follow_its_bone)
{
  const sbf_vec3 positions[] = {{1, 0.6f, 0}, {1, 20, 0}, {4, 12, -7}};
  mesh.mesh.positions = (sbf_vec3_list){positions, 3};
  mesh.bone = 1;
  sbf_asset *built = build(NULL);
  const sbf_level *level = &built->soft_bodies.at[1].levels.at[0];
  const sbf_embedding *embedding = embedding_of(built, 1);
  for (uint32_t i = 0; i < 3; i++) check_place(level, embedding, i, positions[i]);
  for (uint32_t i = 1; i < 3; i++)
    for (int k = 0; k < 4; k++) ck_assert(is_pinned_to(level, embedding->points.at[i].at[k], 1));
  sbf_asset_free(built);
}
END_TEST

START_TEST(embedding_adds_no_pins)
{
  const sbf_vec3 positions[] = {{1, 0.6f, 0}, {1, 20, 0}};
  mesh.mesh.positions = (sbf_vec3_list){positions, 2};
  mesh.bone = 1;
  sbf_asset *built;
  sbf_diagnostic error;
  sbf_build_report report;
  const sbf_build_options options = {.interior = SBF_BUILD_INTERIOR_NONE};
  ck_assert_int_eq(sbf_build(asset, &options, &built, &report, &error), SBF_OK);
  const sbf_level *level = &built->soft_bodies.at[1].levels.at[0];
  ck_assert_uint_eq(level->pins.count, 0);
  ck_assert_uint_eq(level->positions.count, 26);
  check_place(level, embedding_of(built, 1), 0, positions[0]);
  ck_assert_uint_ge(report.warnings, 1);
  sbf_asset_free(built);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("embed");
  TCase *c = tcase_create("embed");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_skin_follows_its_weights);
  tcase_add_test(c, a_mesh_on_a_bone_is_embedded_in_one_body);
  tcase_add_test(c, a_mesh_on_a_leaf_bone_embeds_in_its_ancestors_body);
  tcase_add_test(c, a_mesh_without_bones_embeds_in_the_nearest_body);
  tcase_add_test(c, a_body_carries_its_own_render_mesh);
  tcase_add_test(c, a_mesh_outside_all_bodies_is_not_embedded);
  tcase_add_test(c, authored_embeddings_are_kept);
  tcase_add_test(c, of_two_bodies_on_a_bone_the_nearer);
  tcase_add_test(c, vertices_far_from_a_pinned_body_follow_its_bone);
  tcase_add_test(c, embedding_adds_no_pins);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
