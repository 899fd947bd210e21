#include <math.h>
#include <string.h>

#include "harness.h"
#include "math/vec3.h"
#include "scenes.h"

static const sbf_vec3 middle = {0, 0.5f, 0}, size = {0.4f, 0.2f, 0.6f};

/* A box of 3 x 3 quads a side on a bone, and a level of its eight corners: twelve triangles. */
static scene box_with_level(uint32_t *corners_used) {
  static const uint32_t sides[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  scene s = scene_begin();
  scene_bone(&s, middle);
  scene_section(&s, 0, middle, size, 3);
  scene_skin(&s, 0);
  s.character_definition.position.y = 0;
  s.character_definition.hold_pose = true;
  s.world_definition.ground = sbr_ground_flat(0);
  sbf_render_mesh *mesh = (sbf_render_mesh *)(uintptr_t)s.asset->render_meshes.at;
  uint32_t point_of[8];
  for (uint32_t v = 0; v < mesh->mesh.positions.count; v++) {
    sbf_vec3 p = sbri_sub(mesh->mesh.positions.at[v], middle);
    bool corner = fabsf(p.x) > 0.19f && fabsf(p.y) > 0.09f && fabsf(p.z) > 0.29f;
    if (corner) point_of[(p.x > 0) + 2 * (p.y > 0) + 4 * (p.z > 0)] = v;
  }
  sbf_render_level *level = sbf_asset_allocate(s.asset, 1, sizeof *level);
  uint32_t *sizes = sbf_asset_allocate(s.asset, 12, sizeof *sizes);
  uint32_t *points = sbf_asset_allocate(s.asset, 36, sizeof *points);
  sbf_render_level_init(level);
  for (uint32_t t = 0; t < 12; t++) {
    sizes[t] = 3;
    for (int k = 0; k < 3; k++) points[3 * t + (uint32_t)k] = point_of[sides[t][k]];
  }
  level->polygon_sizes = (sbf_u32_list){sizes, 12};
  level->polygon_points = (sbf_u32_list){points, 36};
  mesh->levels = (sbf_render_level_list){level, 1};
  memcpy(corners_used, point_of, sizeof point_of);
  return s;
}

/* Each vertex of the level has the same bits as in the full skin. */
static void expect_same(const scene *s, const uint32_t *point_of) {
  enum { MAX = 64 };
  sbf_vec3 full[MAX], few[MAX], normals[MAX];
  uint32_t vertices[MAX];
  ck_assert_uint_eq(sbr_model_get_level_vertices(s->model, 0, 1, vertices, MAX), 8);
  uint32_t count = sbr_character_get_skin(s->world, s->character, 0, full, NULL, NULL, MAX);
  ck_assert_uint_eq(count, 56);
  memset(few, 0x55, sizeof few);
  ck_assert_uint_eq(sbr_character_get_level_skin(s->world, s->character, 0, 1, few, normals, NULL, MAX), 8);
  for (uint32_t i = 0; i < 8; i++) {
    bool known = false;
    for (int k = 0; k < 8; k++) known |= point_of[k] == vertices[i];
    ck_assert(known && (i == 0 || vertices[i] > vertices[i - 1]));
    ck_assert_mem_eq(&few[i], &full[vertices[i]], sizeof *few);
    ck_assert_float_eq_tol(sbri_length(normals[i]), 1, 1e-6f);
    ck_assert_float_gt(
        sbri_dot(normals[i], sbri_sub(s->asset->render_meshes.at[0].mesh.positions.at[vertices[i]], middle)),
        0);
  }
  sbf_vec3 untouched;
  memset(&untouched, 0x55, sizeof untouched);
  ck_assert_mem_eq(&few[8], &untouched, sizeof untouched);
}

START_TEST(carried_as_the_full_mesh_is)
{
  uint32_t point_of[8];
  scene s = box_with_level(point_of);
  scene_start(&s);
  expect_same(&s, point_of);
  scene_ticks(&s, 20);
  expect_same(&s, point_of);
  ck_assert_uint_eq(sbr_model_get_level_vertices(s.model, 0, 0, NULL, 0), 56);
  ck_assert_uint_eq(sbr_model_get_level_vertices(s.model, 0, 2, NULL, 0), 0);
  ck_assert_uint_eq(sbr_model_get_level_vertices(s.model, 1, 0, NULL, 0), 0);
  ck_assert_uint_eq(sbr_character_get_level_skin(s.world, s.character, 0, 2, NULL, NULL, NULL, 0), 0);
  ck_assert_uint_eq(sbr_character_get_level_corner_normals(s.world, s.character, 0, 1, NULL, 0), 36);
  ck_assert_uint_eq(sbr_character_get_level_corner_normals(s.world, s.character, 0, 2, NULL, 0), 0);
  scene_free(&s);
}
END_TEST

/* Vertices that no body carries follow the bones. */
START_TEST(skinned_as_the_full_mesh_is)
{
  uint32_t point_of[8];
  scene s = box_with_level(point_of);
  s.asset->soft_bodies.count = 0;
  sbf_render_mesh *mesh = (sbf_render_mesh *)(uintptr_t)s.asset->render_meshes.at;
  uint32_t count = mesh->mesh.positions.count;
  sbf_skin *skin = sbf_asset_allocate(s.asset, 1, sizeof *skin);
  uint32_t *counts = sbf_asset_allocate(s.asset, count, sizeof *counts);
  uint32_t *bones = sbf_asset_allocate(s.asset, count, sizeof *bones);
  float *weights = sbf_asset_allocate(s.asset, count, sizeof *weights);
  uint32_t pinned = 0;
  for (uint32_t v = 0; v < count; v++) {
    counts[v] = v % 3 != 0; /* the others hang on the root */
    if (counts[v]) weights[pinned++] = 1;
  }
  sbf_skin_init(skin);
  skin->influence_counts = (sbf_u32_list){counts, count};
  skin->bones = (sbf_u32_list){bones, pinned};
  skin->weights = (sbf_f32_list){weights, pinned};
  mesh->skin = skin;
  s.character_definition.heading = 0.7f;
  scene_start(&s);
  enum { MAX = 64 };
  sbf_vec3 full[MAX], few[MAX];
  uint32_t vertices[MAX];
  sbr_model_get_level_vertices(s.model, 0, 1, vertices, MAX);
  sbr_character_get_skin(s.world, s.character, 0, full, NULL, NULL, MAX);
  ck_assert_uint_eq(sbr_character_get_level_skin(s.world, s.character, 0, 1, few, NULL, NULL, MAX), 8);
  for (uint32_t i = 0; i < 8; i++) ck_assert_mem_eq(&few[i], &full[vertices[i]], sizeof *few);
  scene_free(&s);
}
END_TEST

/* A level's corners have the normals and texture coordinates of the corners that they name, with hard edges
 * and tangents. */
START_TEST(level_corners_have_normals_and_uvs_of_the_mesh)
{
  uint32_t point_of[8];
  scene s = box_with_level(point_of);
  sbf_render_mesh *mesh = (sbf_render_mesh *)(uintptr_t)s.asset->render_meshes.at;
  sbf_render_level *level = (sbf_render_level *)(uintptr_t)mesh->levels.at;
  uint32_t corner_count = mesh->mesh.polygon_points.count;
  sbf_vec3 *normals = sbf_asset_allocate(s.asset, corner_count, sizeof *normals);
  uint32_t *numbers = sbf_asset_allocate(s.asset, corner_count, sizeof *numbers);
  uint32_t *corners = sbf_asset_allocate(s.asset, 36, sizeof *corners);
  sbf_vec2 *coordinates = sbf_asset_allocate(s.asset, corner_count, sizeof *coordinates);
  sbf_uv_set *set = sbf_asset_allocate(s.asset, 1, sizeof *set);
  for (uint32_t c = 0; c < corner_count; c++) {
    const uint32_t *at = mesh->mesh.polygon_points.at + c / 4 * 4;
    sbf_vec3 a = sbri_sub(mesh->mesh.positions.at[at[2]], mesh->mesh.positions.at[at[0]]);
    sbf_vec3 b = sbri_sub(mesh->mesh.positions.at[at[3]], mesh->mesh.positions.at[at[1]]);
    normals[c] = sbri_normalize(sbri_cross(a, b), (sbf_vec3){0, 0, 0});
    numbers[c] = c;
    sbf_vec3 p = mesh->mesh.positions.at[mesh->mesh.polygon_points.at[c]];
    coordinates[c] = (sbf_vec2){p.z, p.y}; /* on the two sides across x, u runs along z */
  }
  /* Of the corners at the point, the one that faces like the level's triangle. */
  for (uint32_t i = 0; i < 36; i++) {
    const uint32_t *t = level->polygon_points.at + i / 3 * 3;
    const sbf_vec3 *at = mesh->mesh.positions.at;
    sbf_vec3 n = sbri_normalize(
        sbri_cross(sbri_sub(at[t[1]], at[t[0]]), sbri_sub(at[t[2]], at[t[0]])), (sbf_vec3){0, 0, 0});
    corners[i] = UINT32_MAX;
    for (uint32_t c = 0; c < corner_count; c++)
      if (mesh->mesh.polygon_points.at[c] == level->polygon_points.at[i] && sbri_dot(n, normals[c]) > 0.99f)
        corners[i] = c;
    ck_assert_uint_ne(corners[i], UINT32_MAX);
  }
  sbf_uv_set_init(set);
  set->coordinates = (sbf_vec2_list){coordinates, corner_count};
  set->corners = (sbf_u32_list){numbers, corner_count};
  mesh->uv_sets = (sbf_uv_set_list){set, 1};
  mesh->normals = (sbf_vec3_list){normals, corner_count};
  mesh->normal_corners = (sbf_u32_list){numbers, corner_count};
  level->corners = (sbf_u32_list){corners, 36};
  scene_start(&s);
  sbf_vec3 seen[36], smooth[8];
  sbf_vec4 tangents[8];
  ck_assert_uint_eq(sbr_character_get_level_corner_normals(s.world, s.character, 0, 1, seen, 36), 36);
  for (int i = 0; i < 36; i++) ck_assert_float_gt(sbri_dot(seen[i], normals[corners[i]]), 0.999f);
  ck_assert_uint_eq(sbr_character_get_level_skin(s.world, s.character, 0, 1, NULL, smooth, tangents, 8), 8);
  for (int i = 0; i < 8; i++) ck_assert_float_gt(tangents[i].z, 0.3f);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("level_skin");
  TCase *c = tcase_create("level_skin");
  tcase_add_test(c, carried_as_the_full_mesh_is);
  tcase_add_test(c, skinned_as_the_full_mesh_is);
  tcase_add_test(c, level_corners_have_normals_and_uvs_of_the_mesh);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
