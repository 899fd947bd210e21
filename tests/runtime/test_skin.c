#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "math/quat.h"
#include "math/trig.h"
#include "scenes.h"

static float distance(sbf_vec3 a, sbf_vec3 b) {
  return sbri_length(sbri_sub(a, b));
}

static sbf_render_mesh *skin_of(scene *s) {
  return (sbf_render_mesh *)(uintptr_t)s->asset->render_meshes.at;
}

static scene box(uint32_t cells) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0.5f, 0});
  scene_section(&s, 0, (sbf_vec3){0, 0.5f, 0}, (sbf_vec3){0.4f, 0.2f, 0.6f}, cells);
  scene_skin(&s, 0);
  s.character_definition.position.y = 0;
  s.character_definition.hold_pose = true;
  s.world_definition.ground = sbr_ground_flat(0);
  return s;
}

START_TEST(the_skin_starts_at_rest)
{
  scene s = box(3);
  scene_start(&s);
  enum { MAX = 128 };
  sbf_vec3 positions[MAX], normals[MAX];
  const sbf_vec3_list *rest = &s.asset->render_meshes.at[0].mesh.positions;
  ck_assert_uint_eq(
      sbr_character_get_skin(s.world, s.character, 0, positions, normals, NULL, MAX), rest->count);
  for (uint32_t i = 0; i < rest->count; i++) {
    ck_assert_float_le(distance(positions[i], rest->at[i]), 1e-6f);
    ck_assert_float_eq_tol(sbri_length(normals[i]), 1, 1e-6f);
    sbf_vec3 out = sbri_sub(rest->at[i], (sbf_vec3){0, 0.5f, 0});
    ck_assert_float_gt(sbri_dot(normals[i], out), 0);
  }
  scene_free(&s);
}
END_TEST

/* All corners' normals of a face of the box, against the face's own. */
static float worst_corner(scene *s, const sbf_vec3 *normals) {
  const sbf_polygon_mesh *mesh = &s->asset->render_meshes.at[0].mesh;
  float worst = 1;
  for (uint32_t corner = 0; corner < mesh->polygon_points.count; corner++) {
    const uint32_t *at = mesh->polygon_points.at + corner / 4 * 4;
    sbf_vec3 a = sbri_sub(mesh->positions.at[at[2]], mesh->positions.at[at[0]]);
    sbf_vec3 b = sbri_sub(mesh->positions.at[at[3]], mesh->positions.at[at[1]]);
    sbf_vec3 face = sbri_normalize(sbri_cross(a, b), (sbf_vec3){0, 0, 0});
    float dot = sbri_dot(face, normals[corner]);
    worst = dot < worst ? dot : worst;
  }
  return worst;
}

START_TEST(hard_edges_stay_hard_and_soft_ones_soft)
{
  static const sbf_vec3 six[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int hard = 0; hard < 2; hard++) {
    scene s = box(2);
    sbf_render_mesh *mesh = skin_of(&s);
    uint32_t corner_count = mesh->mesh.polygon_points.count;
    uint32_t *corners = sbf_asset_allocate(s.asset, corner_count, sizeof *corners);
    for (uint32_t c = 0; c < corner_count;
         c++) { /* one normal for each side of the box, shared by its faces */
      const uint32_t *at = mesh->mesh.polygon_points.at + c / 4 * 4;
      sbf_vec3 a = sbri_sub(mesh->mesh.positions.at[at[2]], mesh->mesh.positions.at[at[0]]);
      sbf_vec3 b = sbri_sub(mesh->mesh.positions.at[at[3]], mesh->mesh.positions.at[at[1]]);
      sbf_vec3 n = sbri_cross(a, b);
      for (uint32_t k = 0; k < 6; k++)
        if (sbri_dot(n, six[k]) > 0.9f * sbri_length(n)) corners[c] = k;
    }
    if (hard) {
      mesh->normals = (sbf_vec3_list){six, 6};
      mesh->normal_corners = (sbf_u32_list){corners, corner_count};
    }
    scene_start(&s);
    sbf_vec3 *normals = calloc(corner_count, sizeof *normals);
    ck_assert_uint_eq(
        sbr_character_get_corner_normals(s.world, s.character, 0, normals, corner_count), corner_count);
    if (hard)
      ck_assert_float_gt(worst_corner(&s, normals), 0.9999f);
    else
      ck_assert_float_lt(worst_corner(&s, normals), 0.8f);
    free(normals);
    mesh->normals.count = 0; /* `six` is not the asset's */
    scene_free(&s);
  }
}
END_TEST

/* A sheet of two quads, its middle edge doubled as at a seam of the texture. */
static void make_seam(scene *s, sbf_vec3_list normals) {
  static const sbf_vec3 positions[] = {
      {-1, 0, 0}, {0, 0.5f, 0}, {0, 0.5f, 1}, {-1, 0, 1}, {0, 0.5f, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0.5f, 1}};
  static const uint32_t sizes[] = {4, 4}, points[] = {0, 3, 2, 1, 4, 7, 6, 5};
  sbf_render_mesh *mesh = sbf_asset_allocate(s->asset, 1, sizeof *mesh);
  sbf_render_mesh_init(mesh);
  mesh->id = "seam";
  mesh->mesh.positions = (sbf_vec3_list){positions, 8};
  mesh->mesh.polygon_sizes = (sbf_u32_list){sizes, 2};
  mesh->mesh.polygon_points = (sbf_u32_list){points, 8};
  mesh->normals = normals;
  s->asset->render_meshes = (sbf_render_mesh_list){mesh, 1};
}

START_TEST(seams_are_shaded_as_authored)
{
  static const sbf_vec3 smooth[] = {{-0.44721f, 0.89443f, 0}, {0, 1, 0}, {0, 1, 0}, {-0.44721f, 0.89443f, 0},
      {0, 1, 0}, {0.44721f, 0.89443f, 0}, {0.44721f, 0.89443f, 0}, {0, 1, 0}};
  static const sbf_vec3 hard[] = {{-0.44721f, 0.89443f, 0}, {-0.44721f, 0.89443f, 0},
      {-0.44721f, 0.89443f, 0}, {-0.44721f, 0.89443f, 0}, {0.44721f, 0.89443f, 0}, {0.44721f, 0.89443f, 0},
      {0.44721f, 0.89443f, 0}, {0.44721f, 0.89443f, 0}};
  const sbf_vec3_list authored[] = {{smooth, 8}, {hard, 8}};
  for (int k = 0; k < 2; k++) {
    scene s = scene_begin();
    s.asset->soft_bodies.count = 0;
    make_seam(&s, authored[k]);
    scene_start(&s);
    sbf_vec3 normals[8];
    ck_assert_uint_eq(sbr_character_get_skin(s.world, s.character, 0, NULL, normals, NULL, 8), 8);
    for (int i = 0; i < 8; i++) ck_assert_float_le(distance(normals[i], authored[k].at[i]), 1e-4f);
    scene_free(&s);
  }
}
END_TEST

START_TEST(tangents_follow_the_texture)
{
  scene s = scene_begin();
  s.asset->soft_bodies.count = 0;
  make_seam(&s, (sbf_vec3_list){NULL, 0});
  static const sbf_vec2 uv[] = {
      {0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 0}, {1, 1}, {2, 1}}; /* mirrored */
  sbf_uv_set *set = sbf_asset_allocate(s.asset, 1, sizeof *set);
  sbf_uv_set_init(set);
  set->coordinates = (sbf_vec2_list){uv, 8};
  skin_of(&s)->uv_sets = (sbf_uv_set_list){set, 1};
  scene_start(&s);
  sbf_vec3 normals[8];
  sbf_vec4 tangents[8];
  sbr_character_get_skin(s.world, s.character, 0, NULL, normals, tangents, 8);
  for (int i = 0; i < 8; i++) {
    sbf_vec3 t = {tangents[i].x, tangents[i].y, tangents[i].z};
    ck_assert_float_eq_tol(sbri_length(t), 1, 1e-5f);
    ck_assert_float_eq_tol(sbri_dot(t, normals[i]), 0, 1e-5f);
    ck_assert_float_gt(i < 4 ? t.x : -t.x, 0.8f); /* along growing u */
    sbf_vec3 bitangent = sbri_scale(sbri_cross(normals[i], t), tangents[i].w);
    ck_assert_float_gt(bitangent.z, 0.8f); /* along growing v */
  }
  scene_free(&s);
}
END_TEST

START_TEST(without_texture_tangents_are_zero)
{
  scene s = box(1);
  scene_start(&s);
  sbf_vec4 tangents[8], zero = {0, 0, 0, 0};
  sbf_vec3 normals[8];
  memset(tangents, 0x55, sizeof tangents);
  sbr_character_get_skin(s.world, s.character, 0, NULL, normals, tangents, 8);
  for (int i = 0; i < 8; i++) ck_assert_mem_eq(&tangents[i], &zero, sizeof zero);
  scene_free(&s);
}
END_TEST

START_TEST(normals_rotate_with_the_body)
{
  scene s = box(2);
  s.character_definition.heading = 1.2f;
  scene_start(&s);
  scene straight = box(2);
  scene_start(&straight);
  sbf_vec3 turned[26], normals[26];
  sbr_character_get_skin(s.world, s.character, 0, NULL, turned, NULL, 26);
  sbr_character_get_skin(straight.world, straight.character, 0, NULL, normals, NULL, 26);
  float sine, cosine;
  sbri_sincos(0.6f, &sine, &cosine);
  for (int i = 0; i < 26; i++)
    ck_assert_float_le(distance(turned[i], sbri_rotate((sbf_quat){0, sine, 0, cosine}, normals[i])), 1e-5f);
  scene_free(&s);
  scene_free(&straight);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("skin");
  TCase *c = tcase_create("skin");
  tcase_add_test(c, the_skin_starts_at_rest);
  tcase_add_test(c, hard_edges_stay_hard_and_soft_ones_soft);
  tcase_add_test(c, seams_are_shaded_as_authored);
  tcase_add_test(c, tangents_follow_the_texture);
  tcase_add_test(c, without_texture_tangents_are_zero);
  tcase_add_test(c, normals_rotate_with_the_body);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
