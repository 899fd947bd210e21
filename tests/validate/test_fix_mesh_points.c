#include "rules.h"

#define PATH "/sbf/render_mesh[1]/polygon_mesh/positions"
#define STRAY(more)                                                                                          \
  "<render_mesh id=\"r\" name=\"R\">" MESH("rendering", "9 9 9 0 0 0 1 0 0 8 8 8 0 1 0", "3", "1 2 4") more  \
      "</render_mesh>"
#define EMBEDDED(more, points) BODY(TETRA LEVEL("", TETRA_POINTS, SPRINGS("", TETRA_EDGES, "") "<embedding render_mesh=\"r\">" more "<points>" points "</points><weights>"

START_TEST(test_all_lists_of_points)
{
  sbf_asset *asset = rules_expect_fix(
      ROOT_BONE STRAY(
          "<normals>1 0 0 0 1 0 0 0 1 1 0 0 0 1 0</normals>"
          "<uv_set><coordinates>0 0 1 1 2 2 3 3 4 4</coordinates></uv_set><uv_set><coordinates>0 0 1 "
          "1</coordinates><corners>0 1 1</corners></uv_set>"
          "<skin><influence_counts>1 2 1 0 1</influence_counts><bones>0 0 0 0 0</bones><weights>1 0.25 0.75 "
          "1 1</weights></skin>"
          "<shape_key name=\"k\"><points>0 4 1</points><offsets>1 1 1 2 2 2 3 3 3</offsets></shape_key>"
          "<source_points>50 51 52 53 54</source_points>"),
      "MESH_POINT_UNUSED " PATH " #0", "SKIN_BONE_REPEATED /sbf/render_mesh[1]/skin/bones #1");
  const sbf_render_mesh *mesh = &asset->render_meshes.at[0];
  ck_assert_uint_eq(mesh->mesh.positions.count, 3);
  ck_assert_mem_eq(mesh->mesh.polygon_points.at, ((uint32_t[]){0, 1, 2}), 3 * sizeof(uint32_t));
  ck_assert(mesh->normals.count == 3 && mesh->normals.at[0].y == 1 && mesh->normals.at[2].y == 1);
  ck_assert(mesh->uv_sets.at[0].coordinates.count == 3 && mesh->uv_sets.at[0].coordinates.at[2].x == 4);
  ck_assert_uint_eq(mesh->uv_sets.at[1].coordinates.count, 2);
  ck_assert_mem_eq(mesh->skin->influence_counts.at, ((uint32_t[]){2, 1, 1}), 3 * sizeof(uint32_t));
  ck_assert(mesh->skin->weights.count == 4 && mesh->skin->weights.at[0] == 0.25f);
  ck_assert_mem_eq(mesh->shape_keys.at[0].points.at, ((uint32_t[]){2, 0}), 2 * sizeof(uint32_t));
  ck_assert(mesh->shape_keys.at[0].offsets.at[0].x == 2);
  ck_assert_mem_eq(mesh->source_points.at, ((uint32_t[]){51, 52, 54}), 3 * sizeof(uint32_t));
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_points_of_coarser_levels_are_used)
{
  rules_expect(
      "<render_mesh id=\"r\" name=\"R\">" MESH("rendering", "0 0 0 1 0 0 0 1 0 1 1 0", "3 3",
          "0 1 2 0 2 1") "<render_level error=\"1\"><polygon_sizes>3</polygon_sizes><polygon_points>0 1 "
                         "3</polygon_points></render_level></render_mesh>",
      "");
}
END_TEST

START_TEST(test_embeddings)
{
  sbf_asset *asset = rules_load(STRAY("") EMBEDDED("", "3 3 3 3 0 0 0 0 1 1 1 1 3 3 3 3 2 2 2 2") "1 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0</weights></embedding>")), true), *fixed;
  ck_assert_int_eq(sbf_fix(asset, NULL, &fixed, NULL, NULL), SBF_OK);
  const sbf_embedding *e = &fixed->soft_bodies.at[0].levels.at[0].embeddings.at[0];
  ck_assert_uint_eq(e->points.count, 3);
  ck_assert_uint_eq(e->points.at[2].at[0], 2);
  sbf_asset_free(fixed);
  sbf_asset_free(asset);
  asset = rules_load(STRAY("") EMBEDDED("<vertices>4 3 1</vertices>", "2 2 2 2 3 3 3 3 0 0 0 0") "1 0 0 0 1 0 0 0 1 0 0 0</weights></embedding>")), true);
  ck_assert_int_eq(sbf_fix(asset, NULL, &fixed, NULL, NULL), SBF_OK);
  e = &fixed->soft_bodies.at[0].levels.at[0].embeddings.at[0];
  ck_assert_uint_eq(e->vertices.count, 2);
  ck_assert_mem_eq(e->vertices.at, ((uint32_t[]){2, 0}), 2 * sizeof(uint32_t));
  sbf_asset_free(fixed);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_broken_embeddings_do_not_change_the_mesh)
{
  sbf_asset *asset = rules_load(STRAY("") EMBEDDED("<vertices>9</vertices>", "0 0 0 0") "1 0 0 0</weights></embedding>")), true), *fixed;
  ck_assert_int_eq(sbf_fix(asset, NULL, &fixed, NULL, NULL), SBF_OK);
  ck_assert(sbf_asset_equal(asset, fixed, NULL, 0));
  sbf_asset_free(fixed);
  sbf_asset_free(asset);
}
END_TEST

RULES_MAIN("fix_mesh_points", test_all_lists_of_points, test_points_of_coarser_levels_are_used,
    test_embeddings, test_broken_embeddings_do_not_change_the_mesh)
