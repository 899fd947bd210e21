#include <math.h>

#include "harness.h"
#include "math/vec3.h"
#include "scenes.h"
#include "state/world.h"

/* Two bodies of four points each, a metre apart, and a mesh carried by both. */
static scene carried(const float *blends) {
  scene s = scene_begin();
  scene_bodies(&s, 2);
  static const sbf_vec3 corners[2][4] = {
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 0, 0}, {0, 2, 0}, {1, 0, 0}, {0, 0, 1}}};
  static const float masses[] = {1, 1, 1, 1};
  static const uint32_t pinned[] = {0, 1, 2, 3}, vertices[] = {1, 2};
  static const sbf_uint4 points[] = {{{0, 1, 2, 3}}, {{0, 1, 2, 3}}, {{3, 2, 1, 0}}};
  static const sbf_vec4 weights[] = {{1, 0, 0, 0}, {0.25f, 0.25f, 0.25f, 0.25f}, {-0.5f, 0.5f, 0.5f, 0.5f}};
  static const sbf_vec3 rest[] = {{7, 7, 7}, {7, 7, 7}, {7, 7, 7}, {2, 3, 4}};
  for (uint32_t b = 0; b < 2; b++) {
    sbf_level *level = scene_points(&s, b, corners[b], masses, 4);
    scene_pin(&s, level, -1, pinned, 4);
    sbf_embedding *e = sbf_asset_allocate(s.asset, 1, sizeof *e);
    sbf_embedding_init(e);
    e->render_mesh = 0;
    e->points = (sbf_uint4_list){points, b ? 2 : 3};
    e->weights = (sbf_vec4_list){weights, b ? 2 : 3};
    if (b) e->vertices = (sbf_u32_list){vertices, 2};
    e->blends = (sbf_f32_list){blends + 3 * b, b ? 2 : 3};
    level->embeddings = (sbf_embedding_list){e, 1};
  }
  sbf_render_mesh *mesh = sbf_asset_allocate(s.asset, 1, sizeof *mesh);
  sbf_render_mesh_init(mesh);
  mesh->id = "m";
  mesh->mesh.positions = (sbf_vec3_list){rest, 4};
  s.asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_flat(0);
  return s;
}

static void expect(sbf_vec3 p, float x, float y, float z) {
  ck_assert_float_eq_tol(p.x, x, 1e-6f);
  ck_assert_float_eq_tol(p.y, y, 1e-6f);
  ck_assert_float_eq_tol(p.z, z, 1e-6f);
}

START_TEST(vertices_blend_over_points_and_bodies)
{
  const float blends[] = {1, 0.5f, 1, 0.5f, 0};
  scene s = carried(blends);
  scene_start(&s);
  sbf_vec3 p[4];
  ck_assert_uint_eq(sbr_character_get_skin(s.world, s.character, 0, p, NULL, NULL, 4), 4);
  expect(p[0], 0, 0, 0);
  /* Mean of the first body's points, with half the weight, and the second's first point, with half. */
  expect(p[1], 0.125f, 0.125f, 0.125f);
  expect(p[2], 0.5f, 0.5f, -0.5f); /* weights outside 0..1; the second body's weight is 0 */
  expect(p[3], 2, 3, 4);           /* no body carries it: it moves with the character */
  scene_free(&s);
}
END_TEST

START_TEST(weights_are_normalized)
{
  const float blends[] = {0.5f, 0.2f, 1, 0.6f, 0};
  scene s = carried(blends);
  scene_start(&s);
  sbf_vec3 p[4];
  sbr_character_get_skin(s.world, s.character, 0, p, NULL, NULL, 4);
  expect(p[1], 0.25f * 0.25f, 0.25f * 0.25f, 0.25f * 0.25f);
  scene_free(&s);
}
END_TEST

START_TEST(skins_follow_bones_where_no_body_carries_them)
{
  scene s = scene_begin();
  s.asset->soft_bodies.count = 0;
  sbf_bone *bones = sbf_asset_allocate(s.asset, 2, sizeof *bones);
  for (int i = 0; i < 2; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = i ? "b" : "a";
    bones[i].rotation = (sbf_quat){0, 0, 0, 1};
    bones[i].head = (sbf_vec3){(float)i, 0, 0};
  }
  s.asset->bones = (sbf_bone_list){bones, 2};
  static const sbf_vec3 rest[] = {{0, 0, 1}, {1, 0, 1}, {0.5f, 0, 2}};
  static const uint32_t counts[] = {1, 2, 0}, of[] = {0, 0, 1};
  static const float weights[] = {1, 0.25f, 0.75f};
  sbf_skin *skin = sbf_asset_allocate(s.asset, 1, sizeof *skin);
  sbf_skin_init(skin);
  skin->influence_counts = (sbf_u32_list){counts, 3};
  skin->bones = (sbf_u32_list){of, 3};
  skin->weights = (sbf_f32_list){weights, 3};
  sbf_render_mesh *mesh = sbf_asset_allocate(s.asset, 1, sizeof *mesh);
  sbf_render_mesh_init(mesh);
  mesh->id = "m";
  mesh->bone = 1;
  mesh->skin = skin;
  mesh->mesh.positions = (sbf_vec3_list){rest, 3};
  s.asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  s.character_definition.position = (sbr_double3){0, 0, 10};
  s.character_definition.heading = 1.5707963f; /* +Z turned to +X */
  s.character_definition.scale = 2;
  s.world_definition.ground = sbr_ground_flat(0);
  scene_start(&s);
  sbf_vec3 p[3];
  ck_assert_uint_eq(sbr_character_get_skin(s.world, s.character, 0, p, NULL, NULL, 3), 3);
  sbr_double3 o = sbr_character_get_origin(s.world, s.character);
  for (int i = 0; i < 3; i++) {
    ck_assert_double_eq_tol(o.x + (double)p[i].x, 2.0 * (double)rest[i].z, 1e-5);
    ck_assert_double_eq_tol(o.z + (double)p[i].z, 10 - 2.0 * (double)rest[i].x, 1e-5);
  }
  scene_free(&s);
}
END_TEST

START_TEST(a_body_without_levels_follows_its_bone)
{
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0, 0});
  static const sbf_vec3 positions[] = {{1, 2, 3}};
  scene_body(&s, 0)->bone = 0;
  scene_body(&s, 0)->surface.positions = (sbf_vec3_list){positions, 1};
  s.character_definition.position.y = 5;
  s.world_definition.ground = sbr_ground_flat(0);
  scene_start(&s);
  scene_ticks(&s, 3);
  sbf_vec3 p;
  ck_assert_uint_eq(sbr_character_get_surface(s.world, s.character, 0, &p, 1), 1);
  ck_assert_double_eq_tol(sbr_character_get_origin(s.world, s.character).y + (double)p.y, 7, 1e-6);
  ck_assert_uint_eq(sbr_character_get_points(s.world, s.character, 0, &p, 1), 0);
  ck_assert_float_eq(sbr_character_get_body_health(s.world, s.character, 0).volume_ratio, 1);
  scene_free(&s);
}
END_TEST

/* A valid embedding may name one point four times, and two points twice: an element that may tear carries it.
 */
START_TEST(points_named_several_times_carry_once)
{
  static const sbf_vec4 weights[] = {{1, 0, 0, 0}, {0.1f, 0.2f, 0.3f, 0.4f}, {0.25f, 0.25f, 0.25f, 0.25f}};
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1, 1, 1, 1000, 1e5f, 0.3f);
  scene s = scene_begin();
  sbf_level *level = scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->attributes.tear_strain = 0.5f;
  const uint32_t *corners = box.tetrahedra[2].at, last = corners[3];
  const sbf_uint4 points[] = {
      {{last, last, last, last}}, {{last, last, last, last}}, {{corners[0], last, corners[0], last}}};
  sbf_embedding *e = sbf_asset_allocate(s.asset, 1, sizeof *e);
  sbf_embedding_init(e);
  e->render_mesh = 0;
  e->points = (sbf_uint4_list){points, 3};
  e->weights = (sbf_vec4_list){weights, 3};
  level->embeddings = (sbf_embedding_list){e, 1};
  sbf_vec3 a = box.positions[last], b = box.positions[corners[0]];
  const sbf_vec3 rest[] = {a, a, sbri_scale(sbri_add(a, b), 0.5f)};
  sbf_render_mesh *mesh = sbf_asset_allocate(s.asset, 1, sizeof *mesh);
  sbf_render_mesh_init(mesh);
  mesh->id = "m";
  mesh->mesh.positions = (sbf_vec3_list){rest, 3};
  s.asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
  s.character_definition.position.y = 0;
  scene_start(&s);
  const sbri_skin *skin = &s.model->skins.at[0];
  ck_assert_uint_eq(skin->binding_count, 3);
  sbf_vec3 p[3];
  sbr_character_get_skin(s.world, s.character, 0, p, NULL, NULL, 3);
  for (int i = 0; i < 3; i++) expect(p[i], rest[i].x, rest[i].y, rest[i].z);
  scene_free(&s);
  lattice_box_free(&box);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("skin_binding");
  TCase *c = tcase_create("skin carry");
  tcase_add_test(c, vertices_blend_over_points_and_bodies);
  tcase_add_test(c, weights_are_normalized);
  tcase_add_test(c, skins_follow_bones_where_no_body_carries_them);
  tcase_add_test(c, a_body_without_levels_follows_its_bone);
  tcase_add_test(c, points_named_several_times_carry_once);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
