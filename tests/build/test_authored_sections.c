/* Bodies authored along a skin, beside bodies that a part of a skin only touches. */
#include "build/sections/authored_sections.h"

#include "harness.h"
#include "sbfmt/asset.h"

enum { SIDE = 8, POINTS = SIDE * SIDE };

typedef struct patch {
  sbf_vec3 positions[POINTS];
  uint32_t counts[POINTS], bones[POINTS];
  float weights[POINTS];
  sbf_skin skin;
} patch;

static sbf_asset *asset;
static sbfi_arena scratch;
static sbf_bone bones[2];
static sbf_soft_body body;
static sbf_render_mesh meshes[2];
static patch patches[2];

/* A skin of so many points in the plane z = `z`, between 0 and 1 m, on one bone. */
static void make_patch(uint32_t m, uint32_t count, float z, uint32_t bone) {
  patch *p = &patches[m];
  for (uint32_t i = 0; i < count; i++) {
    p->positions[i] = (sbf_vec3){(float)(i % SIDE) / (SIDE - 1), (float)(i / SIDE) / (SIDE - 1), z};
    p->counts[i] = 1, p->bones[i] = bone, p->weights[i] = 1;
  }
  sbf_skin_init(&p->skin);
  p->skin.influence_counts = (sbf_u32_list){p->counts, count};
  p->skin.bones = (sbf_u32_list){p->bones, count};
  p->skin.weights = (sbf_f32_list){p->weights, count};
  sbf_render_mesh_init(&meshes[m]);
  meshes[m].mesh.positions = (sbf_vec3_list){p->positions, count};
  meshes[m].skin = &p->skin;
}

/* A sheet of one square at z = 0 on the first bone. */
static void setup(void) {
  static const sbf_vec3 corners[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  static const uint32_t sizes[] = {4}, points[] = {0, 1, 2, 3};
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&scratch, NULL, 0);
  for (int i = 0; i < 2; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = bones[i].name = i ? "other" : "bone";
  }
  sbf_soft_body_init(&body);
  body.id = body.name = "square";
  body.bone = 0;
  body.surface.positions = (sbf_vec3_list){corners, 4};
  body.surface.polygon_sizes = (sbf_u32_list){sizes, 1};
  body.surface.polygon_points = (sbf_u32_list){points, 4};
  asset->bones = (sbf_bone_list){bones, 2};
  asset->soft_bodies = (sbf_soft_body_list){&body, 1};
}

static void teardown(void) {
  asset->bones = (sbf_bone_list){NULL, 0};
  asset->soft_bodies = (sbf_soft_body_list){NULL, 0};
  asset->render_meshes = (sbf_render_mesh_list){NULL, 0};
  sbf_asset_free(asset);
  sbfi_arena_free(&scratch);
}

static bool is_sectioned(uint32_t mesh_count, uint32_t mesh) {
  uint8_t sectioned[2];
  asset->render_meshes = (sbf_render_mesh_list){meshes, mesh_count};
  ck_assert(sbfi_authored_sections_find(asset, 1, sectioned, &scratch));
  return sectioned[mesh];
}

START_TEST(a_skin_along_a_body_has_sections)
{
  make_patch(0, POINTS, 0, 0);
  ck_assert(is_sectioned(1, 0));
  make_patch(0, POINTS, 0.2f, 0); /* beside it */
  ck_assert(!is_sectioned(1, 0));
}
END_TEST

/* A head's skin, divided by materials: one of them is the base of the antlers, which are a body. */
START_TEST(a_small_part_of_the_skins_does_not_decide)
{
  make_patch(0, 8, 0, 0);
  make_patch(1, POINTS, 0.5f, 0);
  ck_assert(!is_sectioned(2, 0));
  ck_assert(!is_sectioned(2, 1));
  make_patch(0, 32, 0, 0); /* a third of all */
  ck_assert(is_sectioned(2, 0));
}
END_TEST

START_TEST(another_skeleton_is_ignored)
{
  make_patch(0, 8, 0, 0);
  make_patch(1, POINTS, 0.5f, 1);
  ck_assert(is_sectioned(2, 0));
  ck_assert(!is_sectioned(2, 1));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("authored_sections");
  TCase *tests = tcase_create("all");
  tcase_add_checked_fixture(tests, setup, teardown);
  tcase_add_test(tests, a_skin_along_a_body_has_sections);
  tcase_add_test(tests, a_small_part_of_the_skins_does_not_decide);
  tcase_add_test(tests, another_skeleton_is_ignored);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
