#include <math.h>

#include "conversions.h"

typedef struct turned {
  uint32_t quarters; /* about +Y, from looking along +Z */
  bool named;        /* its legs say which is left */
  bool toes;         /* its feet point ahead */
} turned;

static int32_t put(const turned *t, sbfi_scene *s, const char *name, int32_t parent, bool bone, double x,
    double y, double z) {
  static const double cosine[4] = {1, 0, -1, 0}, sine[4] = {0, 1, 0, -1};
  double c = cosine[t->quarters], q = sine[t->quarters];
  return scene_node(s, name, parent, bone, c * x + q * z, y, c * z - q * x);
}

/* Somebody with two legs, whose boots reach ahead of the ankles; the left one stands a little wider. */
static void make(sbfi_scene *s, const turned *t) {
  static const float times[2] = {0, 1};
  scene_begin(s);
  int32_t hips = put(t, s, "hips", SBF_NONE, true, 0, 1, 0);
  scene_box(s, put(t, s, "coat", hips, false, 0, 0.5, 0), 0.25, 0, 0, 0, false);
  for (int side = -1; side <= 1; side += 2) {
    const char *thigh_name = t->named ? side > 0 ? "thigh.L" : "thigh.R" : side > 0 ? "thigh1" : "thigh2";
    const char *foot_name = t->named ? side > 0 ? "LeftFoot" : "RightFoot" : side > 0 ? "foot1" : "foot2";
    int32_t thigh = put(t, s, thigh_name, hips, true, side > 0 ? 0.28125 : -0.25, 0, 0);
    int32_t shin = put(t, s, side > 0 ? "shin1" : "shin2", thigh, true, 0, -0.5, 0);
    int32_t foot = put(t, s, foot_name, shin, true, 0, -0.4375, 0);
    int32_t boot = put(t, s, side > 0 ? "boot1" : "boot2", foot, false, 0, 0, t->toes ? 0.0625 : 0);
    scene_box(s, boot, 0.0625, 0, 0, 0, false);
  }
  scene_end(s);
  static const sbf_vec3 leaps[4][2] = {
      {{0, 1, 0}, {0, 1, 2}}, {{0, 1, 0}, {2, 1, 0}}, {{0, 1, 0}, {0, 1, -2}}, {{0, 1, 0}, {-2, 1, 0}}};
  sbfi_scene_channel *channel = scene_clip(s, "leap", 1, 1);
  *channel = (sbfi_scene_channel){
      .node = hips, .position_count = 2, .position_times = times, .positions = leaps[t->quarters]};
}

static uint32_t leg_on(const sbf_asset *a, int side) {
  const sbf_gait *gait = &a->gaits.at[0];
  for (uint32_t l = 0; l < gait->legs.count; l++)
    if (gait->legs.at[l].home.x * (float)side > 0) return l;
  ck_abort_msg("no leg on that side");
  return 0;
}

static sbf_vec3 middle_of(const sbf_render_mesh *mesh) {
  sbf_vec3 sum = {0, 0, 0};
  float fraction = 1.0f / (float)mesh->mesh.positions.count;
  for (uint32_t i = 0; i < mesh->mesh.positions.count; i++) {
    sum.x += fraction * mesh->mesh.positions.at[i].x;
    sum.y += fraction * mesh->mesh.positions.at[i].y;
    sum.z += fraction * mesh->mesh.positions.at[i].z;
  }
  return sum;
}

/* Whichever way the file has it look, and whether names or feet tell. */
START_TEST(characters_face_z)
{
  for (int reported = 0; reported < 3; reported++)
    for (uint32_t quarters = 0; quarters < 4; quarters++) {
      /* Backwards is believed where both say so. */
      turned t = {quarters, reported != 1, reported != 0};
      uint32_t expected = quarters == 2 && reported != 2 ? 2 : 0;
      sbfi_scene scene;
      converted c;
      make(&scene, &t);
      converted_scene(&c, &scene, &scene, NULL);
      const sbf_asset *a = c.asset;
      ck_assert_uint_eq(a->gaits.count, 1);
      ck_assert_uint_eq(a->gaits.at[0].legs.count, 2);
      ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_FACING), quarters && expected == 0);
      float wide = a->gaits.at[0].legs.at[leg_on(a, expected ? -1 : 1)].home.x;
      ck_assert_float_eq_tol(fabsf(wide), 0.28125f, 1e-6f);
      double way_on = expected ? -1 : 1;
      check_near(
          middle_of(mesh_named(a, "boot1")), way_on * 0.28125, 0.0625, t.toes ? way_on * 0.0625 : 0, 1e-6);
      ck_assert_uint_eq(a->clips.count, 1);
      const sbf_track *direction = &a->clips.at[0].tracks.at[0];
      ck_assert_float_eq_tol(direction->values.at[3], 0, 1e-6f);
      ck_assert_float_eq_tol(direction->values.at[5], 2 * (float)way_on, 1e-6f);
      converted_free(&c);
      sbfi_scene_free(&scene);
    }
}
END_TEST

/* A quadruped that looks along -Z, of whom names alone say so; the head ahead of its fore feet, or behind. */
static void make_quadruped(sbfi_scene *s, bool head_ahead) {
  const turned t = {2, true, false};
  scene_begin(s);
  int32_t hips = put(&t, s, "hips", SBF_NONE, true, 0, 0.9375, -0.5);
  int32_t chest = put(&t, s, "chest", hips, true, 0, 0, 1);
  int32_t head = put(&t, s, "head", chest, true, 0, 0.25, head_ahead ? 0.5 : -1.5);
  scene_box(s, put(&t, s, "coat", hips, false, 0, 0, 0.5), 0.25, 0, 0, 0, false);
  scene_box(s, put(&t, s, "skull", head, false, 0, 0, 0), 0.125, 0, 0, 0, false);
  static const char *const names[2][2][3] = {
      {{"thigh.R", "shin.R", "foot.R"}, {"thigh.L", "shin.L", "foot.L"}},
      {{"upperarm.R", "forearm.R", "hand.R"}, {"upperarm.L", "forearm.L", "hand.L"}}};
  for (int fore = 0; fore < 2; fore++)
    for (int left = 0; left < 2; left++) {
      const char *const *name = names[fore][left];
      int32_t upper = put(&t, s, name[0], fore ? chest : hips, true, left ? 0.25 : -0.25, -0.25, 0);
      int32_t lower = put(&t, s, name[1], upper, true, 0, -0.3125, 0);
      int32_t foot = put(&t, s, name[2], lower, true, 0, -0.3125, 0);
      scene_box(s, put(&t, s, "hoof", foot, false, 0, 0, 0), 0.0625, 0, 0, 0, false);
    }
  scene_end(s);
}

START_TEST(a_head_behind_all_feet_reverses_a_quadruped)
{
  for (int ahead = 0; ahead < 2; ahead++) {
    sbfi_scene scene;
    converted c;
    make_quadruped(&scene, ahead);
    converted_scene(&c, &scene, &scene, NULL);
    ck_assert_uint_eq(c.asset->gaits.count, 1);
    ck_assert_uint_eq(c.asset->gaits.at[0].legs.count, 4);
    ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_FACING), ahead);
    check_near(c.asset->bones.at[bone_named(c.asset, "hand.L")].head, ahead ? 0.25 : -0.25, 0.0625,
        ahead ? 0.5 : -0.5, 1e-6);
    converted_free(&c);
    sbfi_scene_free(&scene);
  }
}
END_TEST

/* Without a gait nobody asks where ahead is. */
START_TEST(without_a_gait_nothing_is_rotated)
{
  sbfi_scene scene;
  converted c;
  turned t = {1, true, true};
  sbf_convert_options options = {.no_gait = true};
  make(&scene, &t);
  converted_scene(&c, &scene, &scene, &options);
  ck_assert_float_eq_tol(c.asset->bones.at[bone_named(c.asset, "LeftFoot")].head.z, -0.28125f, 1e-6f);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_FACING), 0);
  /* Asked, it says so, and touches nothing. */
  sbf_convert_stance stance = {.struct_size = 0};
  int32_t hangs_on[7];
  sbf_diagnostic error;
  ck_assert_uint_eq(c.asset->bones.count, 7);
  ck_assert_int_eq(sbf_convert_stand(c.asset, NULL, &stance, hangs_on, &error), SBF_OK);
  ck_assert_uint_eq(stance.quarter_turns, 1);
  ck_assert_double_eq_tol(stance.ground_m, 0, 1e-6);
  ck_assert_double_eq_tol(stance.height_m, 1.75, 1e-6);
  for (int i = 0; i < 7; i++) ck_assert_int_eq(hangs_on[i], SBF_NONE);
  stance.struct_size = 3;
  ck_assert_int_ne(sbf_convert_stand(c.asset, NULL, &stance, hangs_on, &error), SBF_OK);
  ck_assert_int_eq(error.code, SBF_CODE_BAD_CALL);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("convert_facing");
  TCase *tests = tcase_create("convert_facing");
  tcase_add_test(tests, characters_face_z);
  tcase_add_test(tests, a_head_behind_all_feet_reverses_a_quadruped);
  tcase_add_test(tests, without_a_gait_nothing_is_rotated);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
