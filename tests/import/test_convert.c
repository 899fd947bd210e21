#include "sbfmt/convert.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "conversions.h"
#include "sbfmt/io.h"

/* A path of shared data that stays; NULL where it is absent. */
#define shared(path, to, size) shared_for(__func__, (path), (to), (size))
static const char *shared_for(const char *function, const char *path, char *to, size_t size) {
  const char *found = harness_shared_for(function, path);
  if (!found) return NULL;
  snprintf(to, size, "%s", found);
  return to;
}

/* --- The lizards ------------------------------------------------------------------------------------- */

/* Section -> bone by the rig's node tree: three sections have the name of another bone. */
static const char *const bone_of_section[][2] = {{"Head", "Head"}, {"Body.001", "Body.002"},
    {"Body.002", "Body"}, {"Arm1.L", "Arm.001.L"}, {"Arm2.R", "Arm.002.R"}, {"Hand.L", "Arm.003.L"},
    {"Leg1.R", "Leg.001.R"}, {"Leg2.L", "Leg.002.L"}, {"Foot.R", "Leg.003.R"}, {"Tail1", "Tail.001"},
    {"Tail3", "Tail.003"}};

START_TEST(the_lizard_of_obj_and_rig)
{
  char obj[1024], fbx[1024];
  if (!shared("lizard/liz.obj", obj, sizeof obj) || !shared("lizard/liz.fbx", fbx, sizeof fbx)) return;
  sbf_convert_options options = {.rig = fbx};
  converted c;
  converted_file(&c, obj, &options);
  const sbf_asset *a = c.asset;
  ck_assert_uint_eq(a->soft_bodies.count, 18);
  ck_assert_uint_eq(a->render_meshes.count, 18);
  ck_assert_uint_eq(a->bones.count, 26);
  uint32_t points = 0, polygons = 0, ends = 0;
  float low = INFINITY, high = -INFINITY;
  for (uint32_t b = 0; b < 18; b++) {
    const sbf_soft_body *body = &a->soft_bodies.at[b];
    points += body->surface.positions.count;
    polygons += body->surface.polygon_sizes.count;
    ck_assert_uint_eq(body->source_points.count, body->surface.positions.count);
    for (uint32_t i = 0; i < body->surface.positions.count; i++) {
      low = fminf(low, body->surface.positions.at[i].y);
      high = fmaxf(high, body->surface.positions.at[i].y);
    }
  }
  ck_assert_uint_eq(points, 525);
  ck_assert_uint_eq(polygons, 489);
  ck_assert_float_eq_tol(high - low, 1.1005f, 1e-3f); /* the rig is in centimetres, the mesh in metres */
  for (uint32_t i = 0; i < 26; i++) ends += strstr(a->bones.at[i].name, "_end") != NULL;
  ck_assert_uint_eq(ends, 6);
  for (size_t i = 0; i < sizeof bone_of_section / sizeof *bone_of_section; i++)
    ck_assert_int_eq(body_named(a, bone_of_section[i][0])->bone, bone_named(a, bone_of_section[i][1]));
  check_near(a->bones.at[bone_named(a, "Arm.003.L")].head, 0.7349, 0.0527, 1.0976, 2e-4);
  ck_assert_uint_eq(a->info.sources.count, 2);
  ck_assert_str_eq(a->info.sources.at[0].path, "liz.obj");
  ck_assert_uint_eq(strlen(a->info.sources.at[1].sha256), 64);
  ck_assert_str_eq(a->info.title, "liz");
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_MATERIAL_GUESSED), 1);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_WEIGHTS), 1);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_GAIT_KIND), 1); /* and nothing else is said */
  ck_assert_uint_eq(c.note_count, 3);
  converted_free(&c);
}
END_TEST

START_TEST(the_lizard_of_one_file)
{
  char path[1024];
  if (!shared("lizard/lizart.glb", path, sizeof path)) return;
  converted c;
  converted_file(&c, path, NULL);
  const sbf_asset *a = c.asset;
  ck_assert_uint_eq(a->bones.count, 20); /* a glTF has no tips */
  ck_assert_uint_eq(a->soft_bodies.count, 16);
  ck_assert_uint_eq(a->render_meshes.count, 17);
  const sbf_render_mesh *torso = mesh_named(a, "Body");
  ck_assert_uint_eq(torso->skin->influence_counts.count, torso->mesh.positions.count);
  ck_assert_int_eq(torso->bone, SBF_NONE);
  ck_assert_int_eq(body_named(a, "Hand.L")->bone, bone_named(a, "Arm.003.L"));
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_INSIDE_OUT), 4); /* the legs, drawn so */
  ck_assert_uint_eq(a->joints.count, 10);
  converted_free(&c);
}
END_TEST

/* The same animal in centimetres and in metres. */
START_TEST(units_are_those_of_the_file)
{
  char fbx[1024], glb[1024];
  if (!shared("lizard/lizart.fbx", fbx, sizeof fbx) || !shared("lizard/lizart.glb", glb, sizeof glb)) return;
  converted a, b;
  converted_file(&a, fbx, NULL);
  converted_file(&b, glb, NULL);
  for (uint32_t i = 0; i < b.asset->bones.count; i++) {
    const sbf_bone *bone = &b.asset->bones.at[i];
    const sbf_bone *same = &a.asset->bones.at[bone_named(a.asset, bone->name)];
    check_near(same->head, (double)bone->head.x, (double)bone->head.y, (double)bone->head.z, 1e-4);
    float dot = same->rotation.x * bone->rotation.x + same->rotation.y * bone->rotation.y +
                same->rotation.z * bone->rotation.z + same->rotation.w * bone->rotation.w;
    ck_assert_float_gt(fabsf(dot), 0.9999f);
  }
  converted_free(&a);
  converted_free(&b);
}
END_TEST

/* --- Half a character -------------------------------------------------------------------------------- */

START_TEST(bodies_without_a_rig_are_unattached)
{
  converted c;
  converted_file(&c, harness_source("examples/lizard/lizard.obj"), NULL);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_NO_RIG), 1);
  ck_assert_uint_eq(c.asset->soft_bodies.count, 22);
  ck_assert_uint_eq(c.asset->bones.count + c.asset->rigid_bodies.count + c.asset->gaits.count, 0);
  for (uint32_t i = 0; i < 22; i++) ck_assert_int_eq(c.asset->soft_bodies.at[i].bone, SBF_NONE);
  converted_free(&c);
}
END_TEST

START_TEST(named_objects_and_skins_mix)
{
  sbfi_scene mesh, rig;
  scene_begin(&rig);
  int32_t hips = scene_node(&rig, "hips", SBF_NONE, true, 0, 1, 0);
  int32_t arm = scene_node(&rig, "arm", hips, true, 1, 0, 0);
  scene_node(&rig, "hand", arm, true, 0.5, 0, 0);
  scene_box(&rig, scene_node(&rig, "Coat", hips, false, 0, 0, 0), 0.5, 0, 0, 0, false);
  scene_end(&rig);
  scene_begin(&mesh);
  scene_box(&mesh, scene_node(&mesh, "Coat_box", SBF_NONE, false, 0.9, 1, 0), 0.25, 0, 0, 0, false);
  scene_box(&mesh, scene_node(&mesh, "Glove", SBF_NONE, false, 1.25, 1, 0), 0.25, 0, 0, 0, false);
  scene_end(&mesh);
  converted c;
  converted_scene(&c, &mesh, &rig, NULL);
  ck_assert_int_eq(body_named(c.asset, "Coat")->bone, 0); /* by name, though the arm is nearer */
  const sbf_render_mesh *glove = mesh_named(c.asset, "Glove");
  ck_assert_ptr_nonnull(glove->skin);
  check_near(
      glove->mesh.positions.at[0], 1, 0.75, -0.25, 1e-6); /* a named object shows where the input lies */
  /* The arm moves it; beside the joint the hips have a share. */
  for (uint32_t i = 0; i < glove->skin->weights.count; i++)
    if (glove->skin->bones.at[i] != 1) ck_assert_float_lt(glove->skin->weights.at[i], 0.34f);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_WEIGHTS_COMPUTED), 1);
  converted_free(&c);
  sbfi_scene_free(&mesh);
  sbfi_scene_free(&rig);
}
END_TEST

static sbf_status refused(const char *path, const sbf_convert_options *options, sbf_code code) {
  sbf_asset *asset = (sbf_asset *)&asset;
  sbf_diagnostic error = {0};
  sbf_status status = sbf_convert(path, options, &asset, &error);
  ck_assert_msg(error.code == (int32_t)code, "%s: %s", path, error.message);
  ck_assert_ptr_null(asset);
  return status;
}

START_TEST(wrong_calls)
{
  char lizard[1024];
  snprintf(lizard, sizeof lizard, "%s", harness_source("examples/lizard/lizard.obj"));
  const sbf_convert_options wrong[] = {
      {.struct_size = 3}, {.unit_m = -1}, {.unit_m = NAN}, {.unit_m = INFINITY}, {.up = 'x'}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    ck_assert_int_eq(refused(lizard, &wrong[i], SBF_CODE_BAD_CALL), SBF_FAILED);
  ck_assert_int_eq(refused("no/such/file.obj", NULL, SBF_CODE_IO_CANNOT_READ), SBF_FAILED);
  ck_assert_int_eq(
      refused(lizard, &(sbf_convert_options){.rig = "no/such/rig.fbx"}, SBF_CODE_IO_CANNOT_READ), SBF_FAILED);
  ck_assert_int_eq(
      refused(lizard, &(sbf_convert_options){.rig = lizard}, SBF_CODE_IMPORT_NO_BONES), SBF_BAD_INPUT);
  ck_assert_int_eq(
      sbf_convert("no/such/file.obj", NULL, &(sbf_asset *){NULL}, NULL), SBF_FAILED); /* no one listens */
}
END_TEST

/* --- Determinism and memory -------------------------------------------------------------------------- */

static sbf_buffer bytes_of(const char *path, const char *rig) {
  converted c;
  sbf_convert_options options = {.rig = rig};
  sbf_buffer buffer;
  converted_file(&c, path, &options);
  ck_assert_int_eq(sbf_xml_save_memory(c.asset, NULL, NULL, &buffer, NULL), SBF_OK);
  converted_free(&c);
  return buffer;
}

START_TEST(the_same_input_gives_the_same_bytes)
{
  char files[3][1024], rig[1024];
  snprintf(files[0], sizeof files[0], "%s", harness_source("examples/lizard/lizard.obj"));
  snprintf(rig, sizeof rig, "%s", harness_source("examples/lizard/lizard.glb"));
  bool more = shared("spider/spider.glb", files[1], sizeof files[1]) &&
              shared("walk-dae/walk.dae", files[2], sizeof files[2]);
  for (int i = 0; i < (more ? 3 : 1); i++) {
    sbf_buffer one = bytes_of(files[i], i ? NULL : rig), two = bytes_of(files[i], i ? NULL : rig);
    ck_assert_uint_eq(one.size, two.size);
    ck_assert_int_eq(memcmp(one.at, two.at, one.size), 0);
    sbf_buffer_free(&one);
    sbf_buffer_free(&two);
  }
}
END_TEST

/* A character with everything that the passes make: sections, a skin, shapes, materials, limits, clips, legs
 * that stand off the ground, a bone that is hung elsewhere. */
static void make_everything(sbfi_scene *scene) {
  static const float times[2] = {0, 1};
  static const sbf_vec3 moves[2] = {{0, 1, 0}, {0, 2, 0}}, delta[8] = {{1, 0, 0}};
  static const sbfi_scene_shape shape = {"smile", 0, delta};
  static const sbfi_scene_image image = {"skin", "skin.png", NULL, 0, ""};
  static const sbfi_scene_material material = {
      .name = "red", .base_color_image = 0, .metallic_roughness_image = SBF_NONE, .normal_image = SBF_NONE};
  static const int32_t red[6] = {0};
  static const uint32_t spread[8] = {0, 0, 0, 0, 1, 1, 1, 1};
  scene_begin(scene);
  scene->images = &image;
  scene->image_count = 1;
  scene->materials = &material;
  scene->material_count = 1;
  int32_t root = scene_node(scene, "root", SBF_NONE, true, 0, 0, 0);
  int32_t body = scene_node(scene, "body", root, true, 0, 3, 0);
  scene_box(scene, scene_node(scene, "trunk", body, false, 0, 0, 0), 0.5, 0, 0, 0, false)->polygon_materials =
      red;
  int32_t joints[2] = {0, 0};
  for (int side = 1; side >= -1; side -= 2) {
    int32_t bone = body;
    for (int i = 0; i < 3; i++) {
      static const char *const names[] = {"thigh", "shin", "foot"};
      bone = scene_node(scene, names[i], bone, true, i ? 0 : 0.5 * side, i ? 1 : 0, 0);
      if (i == 0) scene_local(scene, bone)->at[1][1] = scene_local(scene, bone)->at[0][0] = -1;
    }
    ((sbfi_scene_node *)(uintptr_t)scene->nodes)[bone].limits[0] = (sbfi_scene_limit){true, -1, 1};
    scene_box(scene, scene_node(scene, "boot", bone, false, 0, 0, 0), 0.25, 0, 0, 0, side < 0);
    joints[0] = bone;
  }
  joints[1] = scene_node(scene, "target", root, true, -0.5, 0.5, 0);
  int32_t tail = scene_node(scene, "tail", body, true, 0, 0, -1);
  scene_box(scene, scene_node(scene, "tail_box", tail, false, 0, 0, 0), 0.25, 0, 0, 0, false);
  sbfi_scene_mesh *skin =
      scene_box(scene, scene_node(scene, "skin", SBF_NONE, false, 0, 0, 0), 0.25, -0.5, 1, 0, false);
  scene_skin(scene, skin, 2, joints, spread);
  skin->shapes = &shape;
  skin->shape_count = 1;
  *scene_clip(scene, "jump", 1, 1) =
      (sbfi_scene_channel){.node = root, .position_count = 2, .position_times = times, .positions = moves};
  scene_end(scene);
}

START_TEST(every_allocation_may_fail)
{
  sbfi_scene scene;
  make_everything(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_uint_eq(c.asset->gaits.count, 1);
  ck_assert_uint_eq(c.asset->gaits.at[0].tails.count, 1);
  ck_assert_uint_eq(c.asset->joints.count, 3);
  ck_assert_uint_eq(c.asset->clips.at[0].tracks.count, 1);
  ck_assert_uint_eq(mesh_named(c.asset, "skin")->shape_keys.count, 1);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_RIG_BONE_REHUNG), 1);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_GROUND), 1);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_INSIDE_OUT), 1);
  converted_free(&c);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbf_convert_options options = {.allocator = &memory.allocator};
    sbf_diagnostic error = {0};
    sbf_asset *asset = NULL;
    sbf_status status = sbfi_convert_scenes(&scene, &scene, &options, &asset, &error);
    if (status == SBF_OK) {
      ck_assert_uint_gt(allowed, 10);
      sbf_asset_free(asset);
    } else {
      ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
      ck_assert_ptr_null(asset);
    }
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) break;
    ck_assert_uint_lt(allowed, 5000);
  }
  sbfi_scene_free(&scene);
}
END_TEST

/* The same from the file on, reader included. */
START_TEST(every_allocation_of_a_file_may_fail)
{
  char path[1024];
  snprintf(path, sizeof path, "%s", harness_source("examples/lizard/lizard.obj"));
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbf_convert_options options = {.allocator = &memory.allocator};
    sbf_diagnostic error = {0};
    sbf_asset *asset = NULL;
    sbf_status status = sbf_convert(path, &options, &asset, &error);
    if (status != SBF_OK) ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    sbf_asset_free(asset);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) break;
    ck_assert_uint_lt(allowed, 5000);
  }
}
END_TEST

/* --- Every file of the shared data ------------------------------------------------------------------- */

typedef struct known_file {
  const char *file;
  sbf_code error; /* 0: it converts, with the counts of its README */
  uint32_t meshes, points, polygons, triangles, bones, clips, tetrahedra;
} known_file;

/* Points of a glTF are its different places; an FBX loses points that no polygon uses. The md5mesh is
 * missing: in it assimp writes beyond its memory, and whether it dies of that is chance. */
static const known_file known_files[] = {
    {"armadillo/armadillo_1k.obj", 0, 1, 531, 1058, 1058, 0, 0, 0},
    {"armadillo/armadillo_25k.obj", 0, 1, 12602, 25200, 25200, 0, 0, 0},
    {"armadillo/armadillo_4k.ele", 0, 1, 1053, 2102, 2102, 0, 0, 3717},
    {"armadillo/armadillo_4k.node", 0, 1, 1053, 2102, 2102, 0, 0, 3717},
    {"bad/empty.obj", SBF_CODE_IMPORT_EMPTY, 0, 0, 0, 0, 0, 0, 0},
    {"bad/empty_init_from.dae", SBF_CODE_IMPORT_CRASHED, 0, 0, 0, 0, 0, 0, 0},
    {"bad/malformed.obj", SBF_CODE_IMPORT_INDEX, 0, 0, 0, 0, 0, 0, 0},
    {"bad/malformed2.obj", SBF_CODE_IMPORT_POLYGON, 0, 0, 0, 0, 0, 0, 0},
    {"bad/position_bad_count.dae", SBF_CODE_IMPORT_EMPTY, 0, 0, 0, 0, 0, 0, 0},
    {"bunny/bunny_902.obj", 0, 1, 453, 902, 902, 0, 0, 0},
    {"bunny/bunny_holes.obj", 0, 1, 2503, 4968, 4968, 0, 0, 0},
    {"cloth/cloth_25.obj", 0, 1, 25, 32, 32, 0, 0, 0},
    {"cloth/plane_30x30.obj", 0, 1, 961, 1800, 1800, 0, 0, 0},
    {"fox/fox.glb", 0, 1, 290, 576, 576, 24, 3, 0},
    {"greenman/greenman.glb", 0, 1, 180, 356, 356, 12, 4, 0},
    {"kenney-fbx/kenney_character.fbx", 0, 1, 804, 826, 1604, 58, 1, 0},
    {"letter-f/letter_f.dae", 0, 1, 32, 60, 60, 2, 1, 0},
    {"letter-f/letter_f_chain3.dae", 0, 1, 36, 68, 68, 3, 1, 0},
    {"lizard/liz.fbx", 0, 18, 524, 489, 977, 26, 0, 0},
    {"lizard/liz.obj", 0, 18, 525, 489, 977, 0, 0, 0},
    {"lizard/lizart.fbx", 0, 20, 592, 553, 1105, 26, 0, 0},
    {"lizard/lizart.glb", 0, 17, 514, 960, 960, 20, 0, 0},
    {"lizard/lizart.obj", 0, 20, 593, 553, 1105, 0, 0, 0},
    {"lizard/lizartRef.obj", 0, 20, 593, 553, 1105, 0, 0, 0},
    {"lizard-props/box.obj", 0, 1, 8, 6, 12, 0, 0, 0},
    {"lizard-props/icosphere.obj", 0, 1, 42, 80, 80, 0, 0, 0},
    {"lizard-props/lpBall.obj", 0, 1, 36, 34, 68, 0, 0, 0},
    {"lizard-props/sheet.obj", 0, 1, 16, 9, 18, 0, 0, 0},
    {"lizard-props/subcube.obj", 0, 1, 26, 24, 48, 0, 0, 0},
    {"lizard-props/test.obj", 0, 1, 24, 22, 44, 0, 0, 0},
    {"lizard-props/trapezoid.obj", 0, 1, 8, 6, 12, 0, 0, 0},
    {"mocap/cmu_01_01.bvh", 0, 0, 0, 0, 0, 31, 1, 0},
    {"multi/boxes156.obj", 0, 156, 1248, 936, 1872, 0, 0, 0},
    {"multi/suzanne_pair.obj", 0, 2, 1014, 1000, 1936, 0, 0, 0},
    {"ngon/concave_polygon.obj", 0, 1, 64, 1, 64, 0, 0, 0},
    {"ngon/maya_axes.obj", 0, 6, 128, 100, 220, 0, 0, 0},
    {"sausage/sausage_6100_unsupported.fbx", SBF_CODE_IMPORT_REFUSED, 0, 0, 0, 0, 0, 0, 0},
    {"sausage/sausage_7500_ascii.fbx", 0, 1, 24, 22, 44, 4, 0, 0},
    {"sausage/sausage_blender_7400.fbx", 0, 1, 290, 288, 576, 4, 3, 0},
    {"snake/snake.glb", 0, 1, 815, 1618, 1618, 15, 4, 0},
    {"soup/spider.obj", 0, 19, 762, 1368, 1368, 0, 0, 0},
    {"soup/suzanne.obj", 0, 1, 507, 500, 968, 0, 0, 0},
    {"spider/spider.glb", 0, 1, 1386, 2712, 2712, 39, 5, 0},
    {"spot/spot.obj", 0, 1, 2930, 5856, 5856, 0, 0, 0},
    {"tets/ball.vtk", 0, 1, 326, 648, 648, 0, 0, 2536},
    {"tets/cube_22_ascii.msh", 0, 1, 14, 24, 24, 0, 0, 24},
    {"tets/cube_22_binary.msh", 0, 1, 14, 24, 24, 0, 0, 24},
    {"tets/cube_41_ascii.msh", 0, 1, 14, 24, 24, 0, 0, 24},
    {"tets/cube_41_binary.msh", 0, 1, 14, 24, 24, 0, 0, 24},
    {"tets/liver_v1.msh", 0, 1, 140, 276, 276, 0, 0, 596},
    {"tube/cylinder.msh", 0, 1, 182, 360, 360, 0, 0, 2430},
    {"tube/cylinder.obj", 0, 1, 482, 512, 960, 0, 0, 0},
    {"tube/tube.vtk", 0, 1, 410, 816, 816, 0, 0, 2221},
    {"walk-dae/walk.dae", 0, 1, 7786, 7973, 15627, 31, 1, 0},
};

START_TEST(every_shared_file_converts_or_is_refused)
{
  const known_file *known = &known_files[_i];
  char path[1024];
  if (!shared(known->file, path, sizeof path)) return;
  if (known->error) {
    ck_assert_int_eq(refused(path, NULL, known->error), SBF_BAD_INPUT);
    return;
  }
  converted c;
  converted_file(&c, path, NULL);
  uint32_t points = 0, polygons = 0, triangles = 0, tetrahedra = 0;
  for (uint32_t m = 0; m < c.asset->render_meshes.count; m++) {
    const sbf_polygon_mesh *mesh = &c.asset->render_meshes.at[m].mesh;
    points += mesh->positions.count;
    polygons += mesh->polygon_sizes.count;
    triangles += mesh->polygon_points.count - 2 * mesh->polygon_sizes.count;
  }
  for (uint32_t b = 0; b < c.asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < c.asset->soft_bodies.at[b].levels.count; l++)
      tetrahedra += c.asset->soft_bodies.at[b].levels.at[l].lattice.tetrahedra.count;
  ck_assert_uint_eq(c.asset->render_meshes.count, known->meshes);
  ck_assert_uint_eq(points, known->points);
  ck_assert_uint_eq(polygons, known->polygons);
  ck_assert_uint_eq(triangles, known->triangles);
  ck_assert_uint_eq(c.asset->bones.count, known->bones);
  ck_assert_uint_eq(c.asset->clips.count, known->clips);
  ck_assert_uint_eq(tetrahedra, known->tetrahedra);
  converted_free(&c);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("convert");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, the_lizard_of_obj_and_rig);
  tcase_add_test(tests, the_lizard_of_one_file);
  tcase_add_test(tests, units_are_those_of_the_file);
  tcase_add_test(tests, bodies_without_a_rig_are_unattached);
  tcase_add_test(tests, named_objects_and_skins_mix);
  tcase_add_test(tests, wrong_calls);
  tcase_add_test(tests, the_same_input_gives_the_same_bytes);
  tcase_add_test(tests, every_allocation_may_fail);
  tcase_add_test(tests, every_allocation_of_a_file_may_fail);
  tcase_add_loop_test(
      tests, every_shared_file_converts_or_is_refused, 0, sizeof known_files / sizeof *known_files);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
