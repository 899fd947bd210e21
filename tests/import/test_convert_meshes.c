#include <math.h>
#include <string.h>

#include "conversions.h"
#include "sbfmt/mechanics.h"

static double volume_of(const sbf_polygon_mesh *mesh) {
  sbf_surface_measures measures;
  sbf_surface_measure(mesh, NULL, &measures);
  return measures.volume;
}

static sbf_vec3 corner_place(const sbf_polygon_mesh *mesh, uint32_t corner) {
  return mesh->positions.at[mesh->polygon_points.at[corner]];
}

/* Of every corner: the normal points along the face's middle from the box's, the coordinate is the point's.
 */
static void check_corners(const sbf_render_mesh *mesh, sbf_vec3 middle) {
  ck_assert_uint_eq(mesh->normal_corners.count, 24);
  ck_assert_uint_eq(mesh->uv_sets.count, 1);
  const sbf_uv_set *uvs = &mesh->uv_sets.at[0];
  for (uint32_t f = 0; f < 6; f++) {
    sbf_vec3 sum = {0, 0, 0};
    for (uint32_t k = 0; k < 4; k++) {
      sbf_vec3 p = corner_place(&mesh->mesh, 4 * f + k);
      sum = (sbf_vec3){sum.x + p.x / 4, sum.y + p.y / 4, sum.z + p.z / 4};
      uint32_t point = mesh->mesh.polygon_points.at[4 * f + k];
      ck_assert_float_eq(uvs->coordinates.at[uvs->corners.at[4 * f + k]].x, (float)point);
    }
    sbf_vec3 n = mesh->normals.at[mesh->normal_corners.at[4 * f]];
    sbf_vec3 out = {sum.x - middle.x, sum.y - middle.y, sum.z - middle.z};
    float length = sqrtf(out.x * out.x + out.y * out.y + out.z * out.z);
    ck_assert_float_gt((n.x * out.x + n.y * out.y + n.z * out.z) / length, 0.999f);
  }
}

/* A transform that mirrors and stretches: faces still look outwards, attributes stay at their corners. */
START_TEST(mirroring_reverses_polygons)
{
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t node = scene_node(&scene, "mirrored", SBF_NONE, false, 3, 0, 0);
  scene_local(&scene, node)->at[0][0] = -2;
  scene_local(&scene, node)->at[1][1] = 3;
  scene_box(&scene, node, 0.5, 0, 0, 0, false);
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, NULL, NULL);
  const sbf_soft_body *body = body_named(c.asset, "mirrored");
  ck_assert_double_eq_tol(volume_of(&body->surface), 6, 1e-5);
  check_near(body->surface.positions.at[1], 2, -1.5, -0.5, 1e-6);
  ck_assert_uint_eq(body->source_points.at[7], 7);
  ck_assert_uint_eq(body->surface.polygon_points.at[0], 1); /* a polygon still begins at its first corner */
  const sbf_render_mesh *mesh = mesh_named(c.asset, "mirrored");
  ck_assert_double_eq_tol(volume_of(&mesh->mesh), 6, 1e-5);
  check_corners(mesh, (sbf_vec3){3, 0, 0});
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_INSIDE_OUT), 0);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Drawn inside out, once with normals that point inwards too, once with normals that are right. */
START_TEST(closed_surfaces_are_turned_outwards)
{
  for (int i = 0; i < 2; i++) {
    sbfi_scene scene;
    scene_begin(&scene);
    int32_t node = scene_node(&scene, "leg", SBF_NONE, false, 0, 0, 0);
    sbfi_scene_mesh *mesh = scene_box(&scene, node, 1, 0, 0, 0, true);
    for (uint32_t k = 0; i == 1 && k < 6; k++) {
      sbf_vec3 *n = (sbf_vec3 *)(uintptr_t)&mesh->normals.at[k];
      *n = (sbf_vec3){-n->x, -n->y, -n->z};
    }
    scene_end(&scene);
    converted c;
    converted_scene(&c, &scene, NULL, NULL);
    ck_assert_double_eq_tol(volume_of(&body_named(c.asset, "leg")->surface), 8, 1e-5);
    check_corners(mesh_named(c.asset, "leg"), (sbf_vec3){0, 0, 0});
    ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_INSIDE_OUT), 1);
    ck_assert_ptr_nonnull(strstr(converted_note(&c, SBF_CODE_IMPORT_INSIDE_OUT)->message, "'leg'"));
    converted_free(&c);
    sbfi_scene_free(&scene);
  }
}
END_TEST

/* What has no area could have no mass: with something else it is left out and said, alone it is refused. */
START_TEST(objects_without_area_are_left_out)
{
  enum { WITH_A_BOX, ALONE, SKINNED, CASES };
  for (int which = 0; which < CASES; which++) {
    bool alone = which != WITH_A_BOX;
    sbfi_scene scene;
    scene_begin(&scene);
    int32_t line = scene_node(&scene, "line", SBF_NONE, false, 3, 0, 0);
    sbfi_scene_mesh *mesh = scene_box(&scene, line, 1, 0, 0, 0, false);
    for (uint32_t i = 0; i < mesh->point_count; i++) {
      sbf_vec3 *p = (sbf_vec3 *)(uintptr_t)&mesh->points[i];
      *p = (sbf_vec3){0.1f * (float)i, 0.3f * (float)i, 0.7f * (float)i};
    }
    if (which == SKINNED) {
      int32_t bone = scene_node(&scene, "bone", SBF_NONE, true, 0, 0, 0);
      scene_skin(&scene, mesh, 1, &bone, (const uint32_t[8]){0});
    }
    if (!alone) scene_box(&scene, scene_node(&scene, "box", SBF_NONE, false, 0, 0, 0), 1, 0, 0, 0, false);
    scene_end(&scene);
    if (alone) {
      sbf_asset *asset = NULL;
      sbf_diagnostic d;
      ck_assert_int_eq(sbfi_convert_scenes(&scene, which == SKINNED ? &scene : NULL,
                           &(sbf_convert_options){.unit_m = 1}, &asset, &d),
          SBF_BAD_INPUT);
      ck_assert_int_eq(d.code, SBF_CODE_IMPORT_EMPTY);
      ck_assert_ptr_null(asset);
    } else {
      converted c;
      converted_scene(&c, &scene, NULL, NULL);
      ck_assert_uint_eq(c.asset->soft_bodies.count, 1);
      ck_assert_uint_eq(c.asset->render_meshes.count, 1);
      ck_assert_ptr_nonnull(body_named(c.asset, "box"));
      ck_assert_ptr_nonnull(strstr(converted_note(&c, SBF_CODE_IMPORT_IGNORED)->message, "'line'"));
      converted_free(&c);
    }
    sbfi_scene_free(&scene);
  }
}
END_TEST

/* Without a face there is no inside to be sure of. */
START_TEST(open_surfaces_are_unchanged)
{
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t node = scene_node(&scene, "bowl", SBF_NONE, false, 0, 0, 0);
  sbfi_scene_mesh *mesh = scene_box(&scene, node, 1, 0, 0, 0, true);
  mesh->polygon_count = 5;
  mesh->corner_count = 20;
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, NULL, NULL);
  const sbf_soft_body *body = body_named(c.asset, "bowl");
  ck_assert_uint_eq(body->surface.polygon_sizes.count, 5);
  for (uint32_t k = 0; k < 20; k++)
    ck_assert_uint_eq(body->surface.polygon_points.at[k], mesh->corner_points[k]);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_INSIDE_OUT), 0);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(slots_are_the_materials_in_use)
{
  sbfi_scene scene;
  scene_begin(&scene);
  static const sbfi_scene_image images[] = {
      {"skin", "textures/skin.png", NULL, 0, ""}, {"eye", NULL, (const uint8_t *)"image", 5, "png"}};
  static const sbfi_scene_material materials[] = {{.name = "unused",
                                                      .base_color_image = SBF_NONE,
                                                      .metallic_roughness_image = SBF_NONE,
                                                      .normal_image = SBF_NONE},
      {.name = "red",
          .base_color = {1, 0, 0, 1},
          .roughness = 0.25f,
          .base_color_image = 0,
          .metallic_roughness_image = SBF_NONE,
          .normal_image = 1},
      {.name = "glass",
          .base_color = {0, 0, 1, 0.5f},
          .alpha_mode = SBFI_ALPHA_BLEND,
          .double_sided = true,
          .base_color_image = SBF_NONE,
          .metallic_roughness_image = SBF_NONE,
          .normal_image = SBF_NONE}};
  scene.images = images;
  scene.image_count = 2;
  scene.materials = materials;
  scene.material_count = 3;
  int32_t a = scene_node(&scene, "two", SBF_NONE, false, 0, 0, 0);
  int32_t b = scene_node(&scene, "one", SBF_NONE, false, 5, 0, 0);
  static const int32_t both[6] = {2, 2, 1, 2, SBF_NONE, 1}, red[6] = {1, 1, 1, 1, 1, 1};
  scene_box(&scene, a, 0.5, 0, 0, 0, false)->polygon_materials = both;
  scene_box(&scene, b, 0.5, 0, 0, 0, false)->polygon_materials = red;
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, NULL, NULL);
  ck_assert_uint_eq(c.asset->materials.count, 3);
  ck_assert_uint_eq(c.asset->textures.count, 2);
  ck_assert_str_eq(c.asset->textures.at[0].path, "textures/skin.png");
  ck_assert_uint_eq(c.asset->textures.at[1].bytes.count, 5);
  ck_assert_str_eq(c.asset->textures.at[1].media_type, "image/png");
  const sbf_material *m = c.asset->materials.at;
  ck_assert(m[1].base_color_texture == 0 && m[1].normal_texture == 1 && m[1].roughness == 0.25f);
  ck_assert(m[2].alpha_mode == SBF_ALPHA_MODE_BLEND && m[2].double_sided && m[2].base_color.w == 0.5f);
  const sbf_render_mesh *two = mesh_named(c.asset, "two");
  static const int32_t slots[3] = {2, 1, SBF_NONE};
  static const uint32_t of_polygons[6] = {0, 0, 1, 0, 2, 1};
  ck_assert_uint_eq(two->material_slots.count, 3);
  for (int i = 0; i < 3; i++) ck_assert_int_eq(two->material_slots.at[i].material, slots[i]);
  ck_assert_int_eq(memcmp(two->polygon_materials.at, of_polygons, sizeof of_polygons), 0);
  const sbf_render_mesh *one = mesh_named(c.asset, "one");
  ck_assert_uint_eq(one->material_slots.count, 1);
  ck_assert_uint_eq(one->polygon_materials.count, 0);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(uvs_that_leave_corners_out_are_dropped)
{
  sbfi_scene scene;
  scene_begin(&scene);
  sbfi_scene_mesh *mesh =
      scene_box(&scene, scene_node(&scene, "box", SBF_NONE, false, 0, 0, 0), 1, 0, 0, 0, false);
  ((int32_t *)(uintptr_t)mesh->uv_sets[0].corner)[7] = SBF_NONE;
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, NULL, NULL);
  ck_assert_uint_eq(mesh_named(c.asset, "box")->uv_sets.count, 0);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_PARTIAL_UVS), 1);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Sums of 0.5, 2 and nothing become 1; a point of no bone goes with the bone its mesh hangs on. */
START_TEST(skins_are_normalised)
{
  static const uint32_t starts[9] = {0, 2, 3, 3, 4, 5, 6, 7, 8}, joints[8] = {0, 1, 1, 0, 0, 0, 1, 1};
  static const float weights[8] = {0.375f, 0.125f, 2, 1, 1, 1, 1, 1};
  static const uint32_t any[8] = {0};
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t bones[2];
  bones[0] = scene_node(&scene, "hips", SBF_NONE, true, 0, 1, 0);
  bones[1] = scene_node(&scene, "chest", bones[0], true, 0, 1, 0);
  int32_t node = scene_node(&scene, "skin", bones[1], false, 0, -2, 0);
  sbfi_scene_mesh *mesh = scene_box(&scene, node, 1, 0, 1.5, 0, false);
  scene_skin(&scene, mesh, 2, bones, any);
  mesh->skin.starts = starts;
  mesh->skin.joint_index = joints;
  mesh->skin.weights = weights;
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_uint_eq(c.asset->soft_bodies.count, 0);
  const sbf_skin *skin = mesh_named(c.asset, "skin")->skin;
  ck_assert_uint_eq(skin->influence_counts.at[0], 2);
  ck_assert_float_eq(skin->weights.at[0], 0.75f);
  ck_assert_float_eq(skin->weights.at[1], 0.25f);
  ck_assert_float_eq(skin->weights.at[2], 1);
  ck_assert_uint_eq(skin->influence_counts.at[2], 1);
  ck_assert_uint_eq(skin->bones.at[3], 1);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_UNWEIGHTED_POINTS), 1);
  ck_assert_ptr_nonnull(strstr(converted_note(&c, SBF_CODE_RIG_UNWEIGHTED_POINTS)->message, "joints"));
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_WEIGHTS_LOST), 2); /* too little, and too much */
  ck_assert_ptr_nonnull(strstr(converted_note(&c, SBF_CODE_RIG_WEIGHTS_LOST)->message, "of 1 points"));
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_NO_SECTIONS), 1);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* A section inside a skin is simulated but not drawn; one that sticks out is. */
START_TEST(covered_sections_are_not_rendered)
{
  static const uint32_t all_first[8] = {0};
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t hips = scene_node(&scene, "hips", SBF_NONE, true, 0, 0, 0);
  int32_t tail = scene_node(&scene, "tail", hips, true, 0, 1, 0);
  int32_t inside = scene_node(&scene, "inside", hips, false, 0, 0, 0);
  int32_t outside = scene_node(&scene, "outside", tail, false, 0, 0, 0);
  int32_t skin = scene_node(&scene, "skin", SBF_NONE, false, 0, 0, 0);
  scene_box(&scene, inside, 0.9, 0, 0, 0, false);
  scene_box(&scene, outside, 0.5, 0, 0.5, 0, false);
  scene_skin(&scene, scene_box(&scene, skin, 1, 0, 0, 0, false), 1, &hips, all_first);
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_uint_eq(c.asset->soft_bodies.count, 2);
  ck_assert_uint_eq(c.asset->render_meshes.count, 2);
  ck_assert_int_eq(body_named(c.asset, "inside")->bone, 0);
  ck_assert_int_eq(mesh_named(c.asset, "outside")->bone, 1);
  ck_assert_ptr_nonnull(mesh_named(c.asset, "skin")->skin);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* A cape that lies close to the back, and legs under a skirt that is open below, show: each is drawn. */
START_TEST(visible_meshes_beside_a_skin_are_rendered)
{
  static const uint32_t all_first[8] = {0};
  static const struct { double half, y, z; } worn[] = {{0.9, 0, -1.91}, {0.9, 0, 0.12}, {0.7, 0, -0.2}};
  for (int i = 0; i < 3; i++) {
    sbfi_scene scene;
    scene_begin(&scene);
    int32_t hips = scene_node(&scene, "hips", SBF_NONE, true, 0, 0, 0);
    int32_t node = scene_node(&scene, "worn", hips, false, 0, 0, 0);
    int32_t skin = scene_node(&scene, "skin", SBF_NONE, false, 0, 0, 0);
    scene_box(&scene, node, worn[i].half, 0, worn[i].y, worn[i].z, false);
    sbfi_scene_mesh *mesh = scene_box(&scene, skin, 1, 0, 0, 0, false);
    scene_skin(&scene, mesh, 1, &hips, all_first);
    if (i == 2) mesh->polygon_count = 5, mesh->corner_count = 20; /* without its last side, the one at -z */
    scene_end(&scene);
    converted c;
    converted_scene(&c, &scene, &scene, NULL);
    ck_assert_uint_eq(c.asset->render_meshes.count, 2);
    ck_assert_int_eq(mesh_named(c.asset, "worn")->bone, 0);
    converted_free(&c);
    sbfi_scene_free(&scene);
  }
}
END_TEST

START_TEST(shapes_move_with_the_mesh)
{
  static const sbf_vec3 delta[8] = {[3] = {0, 0, 0.5f}};
  static const sbfi_scene_shape shape = {"smile", 0, delta};
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t node = scene_node(&scene, "face", SBF_NONE, false, 7, 0, 0);
  sbfi_matrix *m = scene_local(&scene, node);
  m->at[0][0] = m->at[2][2] = 0; /* +Z to +X, and twice as large */
  m->at[0][2] = 2;
  m->at[1][1] = 2;
  m->at[2][0] = -2;
  sbfi_scene_mesh *mesh = scene_box(&scene, node, 1, 0, 0, 0, false);
  mesh->shapes = &shape;
  mesh->shape_count = 1;
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, NULL, NULL);
  const sbf_render_mesh *face = mesh_named(c.asset, "face");
  ck_assert_uint_eq(face->shape_keys.count, 1);
  ck_assert_str_eq(face->shape_keys.at[0].name, "smile");
  ck_assert_uint_eq(face->shape_keys.at[0].points.count, 1);
  ck_assert_uint_eq(face->shape_keys.at[0].points.at[0], 3);
  check_near(face->shape_keys.at[0].offsets.at[0], 1, 0, 0, 1e-6);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("convert_meshes");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, mirroring_reverses_polygons);
  tcase_add_test(tests, closed_surfaces_are_turned_outwards);
  tcase_add_test(tests, objects_without_area_are_left_out);
  tcase_add_test(tests, open_surfaces_are_unchanged);
  tcase_add_test(tests, slots_are_the_materials_in_use);
  tcase_add_test(tests, uvs_that_leave_corners_out_are_dropped);
  tcase_add_test(tests, skins_are_normalised);
  tcase_add_test(tests, covered_sections_are_not_rendered);
  tcase_add_test(tests, visible_meshes_beside_a_skin_are_rendered);
  tcase_add_test(tests, shapes_move_with_the_mesh);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
