#include "import/gait/rest_pose.h"

#include <math.h>
#include <string.h>

#include "conversions.h"
#include "motion/quatd.h"

static const double DEGREE = 0.017453292519943295;

/* A person in an exact T: bones with boxes, fingers on its hands. Collarbones are as long as upper arms. */
static void build_with(sbfi_scene *s, double arm_drop, bool has_collarbones) {
  scene_begin(s);
  int32_t hips = scene_node(s, "hips", SBF_NONE, true, 0, 1, 0);
  scene_box(s, scene_node(s, "p", hips, false, 0, 0, 0), 0.15, 0, 0, 0, false);
  int32_t chest = scene_node(s, "chest", hips, true, 0, 0.4, 0);
  scene_box(s, scene_node(s, "p", chest, false, 0, 0, 0), 0.16, 0, 0, 0, false);
  int32_t head = scene_node(s, "head", chest, true, 0, 0.3, 0);
  scene_box(s, scene_node(s, "p", head, false, 0, 0, 0), 0.1, 0, 0.1, 0, false);
  for (int side = 1; side >= -1; side -= 2) {
    int32_t b = scene_node(s, side > 0 ? "thigh.L" : "thigh.R", hips, true, 0.12 * side, -0.1, 0);
    scene_box(s, scene_node(s, "p", b, false, 0, 0, 0), 0.07, 0, -0.2, 0, false);
    b = scene_node(s, side > 0 ? "shin.L" : "shin.R", b, true, 0, -0.45, 0.01);
    scene_box(s, scene_node(s, "p", b, false, 0, 0, 0), 0.06, 0, -0.2, 0, false);
    b = scene_node(s, side > 0 ? "foot.L" : "foot.R", b, true, 0, -0.4, -0.01);
    scene_box(s, scene_node(s, "p", b, false, 0, 0, 0), 0.05, 0, 0, 0.03, false);
    int32_t above = chest;
    if (has_collarbones) {
      above = scene_node(s, side > 0 ? "shoulder.L" : "shoulder.R", chest, true, 0.02 * side, 0.1, 0);
      scene_box(s, scene_node(s, "p", above, false, 0, 0, 0), 0.03, 0.15 * side, 0, 0, false);
    }
    b = scene_node(s, side > 0 ? "arm.L" : "arm.R", above, true, (has_collarbones ? 0.3 : 0.2) * side,
        has_collarbones ? 0 : 0.1, 0);
    scene_box(s, scene_node(s, "p", b, false, 0, 0, 0), 0.05, 0.12 * side, 0, 0, false);
    b = scene_node(
        s, side > 0 ? "elbow.L" : "elbow.R", b, true, 0.28 * side * cos(arm_drop), -0.28 * sin(arm_drop), 0);
    scene_box(s, scene_node(s, "p", b, false, 0, 0, 0), 0.05, 0.12 * side, 0, 0, false);
    b = scene_node(
        s, side > 0 ? "hand.L" : "hand.R", b, true, 0.25 * side * cos(arm_drop), -0.25 * sin(arm_drop), 0);
    scene_box(s, scene_node(s, "p", b, false, 0, 0, 0), 0.03, 0.04 * side, 0, 0, false);
    for (int f = 0; f < 3; f++) {
      b = scene_node(s, side > 0 ? "index.L" : "index.R", b, true, (f ? 0.03 : 0.08) * side, 0, 0);
      scene_box(s, scene_node(s, "p", b, false, 0, 0, 0), 0.012, 0.015 * side, 0, 0, false);
    }
  }
}

static void build(sbfi_scene *s, double arm_drop) {
  build_with(s, arm_drop, false);
}

static const sbf_pose_key *key_of(const sbf_pose *pose, int32_t bone) {
  for (uint32_t i = 0; i < pose->keys.count; i++)
    if (pose->keys.at[i].bone == bone) return &pose->keys.at[i];
  return NULL;
}

/* A bone's rotation in asset space in a pose that replaces rest: q_local = rest q_local, then the key. */
static void posed(const sbf_asset *a, const sbf_pose *pose, int32_t bone, double to[4]) {
  const sbf_quat r = a->bones.at[bone].rotation;
  double rest[4] = {r.x, r.y, r.z, r.w};
  int32_t parent = a->bones.at[bone].parent;
  memcpy(to, rest, sizeof rest);
  if (parent != SBF_NONE) {
    const sbf_quat p = a->bones.at[parent].rotation;
    double above[4], undo[4], local[4], of_parent[4] = {p.x, p.y, p.z, p.w};
    posed(a, pose, parent, above);
    sbfi_quatd_conjugate(of_parent, undo);
    sbfi_quatd_multiply(undo, rest, local);
    sbfi_quatd_multiply(above, local, to);
  }
  const sbf_pose_key *key = key_of(pose, bone);
  if (!key) return;
  double rotation[4] = {key->rotation.x, key->rotation.y, key->rotation.z, key->rotation.w};
  sbfi_quatd_multiply(to, rotation, to);
}

/* Where the bone's child lies from it in the pose, of unit length. */
static void direction(
    const sbf_asset *a, const sbf_pose *pose, int32_t bone, int32_t child, double heading[3]) {
  const sbf_quat r = a->bones.at[bone].rotation;
  double rest[4] = {r.x, r.y, r.z, r.w}, undo[4], now[4], length = 0;
  const sbf_vec3 p = a->bones.at[bone].head, q = a->bones.at[child].head;
  double separation[3] = {q.x - p.x, q.y - p.y, q.z - p.z};
  posed(a, pose, bone, now);
  sbfi_quatd_conjugate(rest, undo);
  sbfi_quatd_rotate(undo, separation, heading);
  sbfi_quatd_rotate(now, heading, heading);
  for (int k = 0; k < 3; k++) length += heading[k] * heading[k];
  for (int k = 0; k < 3; k++) heading[k] /= sqrt(length);
}

static double angle_between(const double a[3], const double b[3]) {
  return acos(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / DEGREE;
}

/* Held out by nothing: 70 degrees down, a little ahead, elbows and fingers bent. */
static void assert_arms_are_lowered(bool has_collarbones) {
  sbfi_scene scene;
  converted c;
  build_with(&scene, 0, has_collarbones);
  scene_end(&scene);
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_asset *a = c.asset;
  const sbf_gait *gait = &a->gaits.at[0];
  ck_assert_int_ne(gait->rest_pose, SBF_NONE);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_REST_POSE_PROPOSED), 1);
  const sbf_pose *pose = &a->poses.at[gait->rest_pose];
  ck_assert_float_eq(pose->distance, 0);
  for (int side = 1; side >= -1; side -= 2) {
    double upper[3], lower[3], finger[3];
    int32_t arm = bone_named(a, side > 0 ? "arm.L" : "arm.R"),
            elbow = bone_named(a, side > 0 ? "elbow.L" : "elbow.R");
    int32_t hand = bone_named(a, side > 0 ? "hand.L" : "hand.R");
    direction(a, pose, arm, elbow, upper);
    direction(a, pose, elbow, hand, lower);
    ck_assert_double_eq_tol(asin(-upper[1]) / DEGREE, 70, 2);
    ck_assert_double_gt(upper[0] * side, 0.2);
    ck_assert_double_eq_tol(asin(upper[2]) / DEGREE, 5, 2);
    ck_assert_double_eq_tol(angle_between(upper, lower), 20, 1);
    ck_assert_double_gt(lower[2], upper[2]); /* ahead */
    direction(a, pose, bone_named(a, side > 0 ? "index.L" : "index.R"),
        bone_named(a, side > 0 ? "index.L" : "index.R") + 1, finger);
    ck_assert_double_eq_tol(angle_between(lower, finger), 15, 1);
    ck_assert_ptr_null(key_of(pose, bone_named(a, side > 0 ? "thigh.L" : "thigh.R")));
  }
  converted_free(&c);
  sbfi_scene_free(&scene);
}

START_TEST(arms_are_lowered)
{ assert_arms_are_lowered(false); }
END_TEST

START_TEST(arms_after_long_collarbones_are_lowered)
{ assert_arms_are_lowered(true); }
END_TEST

/* Arms that hang by 40 degrees as bound stay; they swing all the same. */
START_TEST(hanging_arms_are_unchanged)
{
  sbfi_scene scene;
  converted c;
  build(&scene, 40 * DEGREE);
  scene_end(&scene);
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_int_eq(c.asset->gaits.at[0].rest_pose, SBF_NONE);
  ck_assert_uint_eq(c.asset->poses.count, 4);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Where the leg opposite the first lands, the first leg's arm is ahead and the other behind. */
START_TEST(arms_swing_against_legs)
{
  sbfi_scene scene;
  converted c;
  build(&scene, 0);
  scene_end(&scene);
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_asset *a = c.asset;
  const sbf_gait *gait = &a->gaits.at[0];
  ck_assert_uint_eq(a->poses.count, 5);
  const sbf_pose *rest = &a->poses.at[0], *end = &a->poses.at[4];
  /* Of a slow walk and of a fast one with longer steps; legs of 0.85 m. */
  static const float steps[4] = {0.0625f, 0.125f, 0.2125f, 0.425f}, speeds[4] = {0.2f, 0.2f, 1, 1};
  for (uint32_t i = 0; i < 4; i++) {
    ck_assert(a->poses.at[1 + i].mirrored);
    ck_assert_float_eq_tol(a->poses.at[1 + i].distance, 0.85f * steps[i], 1e-3f);
    ck_assert_float_eq_tol(a->poses.at[1 + i].speed, 0.85f * speeds[i], 1e-3f);
  }
  /* As the runtime does: the walk's turn after the rest pose's. */
  for (int side = 1; side >= -1; side -= 2) {
    int32_t arm = bone_named(a, side > 0 ? "arm.L" : "arm.R");
    const sbf_pose_key *key = key_of(end, arm);
    double before[3], frame[4],
        swing[4] = {key->rotation.x, key->rotation.y, key->rotation.z, key->rotation.w};
    direction(a, rest, arm, bone_named(a, side > 0 ? "elbow.L" : "elbow.R"), before);
    double own[3], after[3], undo[4];
    posed(a, rest, arm, frame);
    sbfi_quatd_conjugate(frame, undo);
    sbfi_quatd_rotate(undo, before, own);
    sbfi_quatd_rotate(swing, own, own);
    sbfi_quatd_rotate(frame, own, after);
    bool first = (gait->legs.at[0].home.x > 0) == (side > 0);
    ck_assert((after[2] > before[2] + 0.2) == first);
    ck_assert((after[2] < before[2] - 0.2) == !first);
  }
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Long ears of a toy that is mostly head: they are paired and reach farther than its arms, and stay. */
START_TEST(ears_are_no_arms)
{
  sbfi_scene scene;
  converted c;
  build(&scene, 0);
  int32_t head = SBF_NONE;
  for (uint32_t n = 0; n < scene.node_count; n++)
    if (strcmp(scene.nodes[n].name, "head") == 0) head = (int32_t)n;
  for (int side = 1; side >= -1; side -= 2) {
    int32_t b = scene_node(&scene, side > 0 ? "ear.L" : "ear.R", head, true, 0.1 * side, 0.2, 0);
    scene_box(&scene, scene_node(&scene, "p", b, false, 0, 0, 0), 0.1, 0.5 * side, 1, 0, false);
    b = scene_node(&scene, side > 0 ? "tip.L" : "tip.R", b, true, 0.8 * side, 1.5, 0);
    scene_box(&scene, scene_node(&scene, "p", b, false, 0, 0, 0), 0.1, 0.5 * side, 1, 0, false);
  }
  scene_end(&scene);
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_asset *a = c.asset;
  ck_assert_int_ne(a->gaits.at[0].rest_pose, SBF_NONE);
  for (uint32_t i = 0; i < a->poses.count; i++) {
    ck_assert_ptr_null(key_of(&a->poses.at[i], bone_named(a, "ear.L")));
    ck_assert_ptr_null(key_of(&a->poses.at[i], bone_named(a, "tip.R")));
  }
  ck_assert_ptr_nonnull(key_of(&a->poses.at[a->gaits.at[0].rest_pose], bone_named(a, "arm.L")));
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* An idle clip says how it stands; one with a weapon does not. */
START_TEST(a_clip_sets_the_stance)
{
  sbfi_scene scene;
  converted c;
  build(&scene, 0);
  static const float time = 0;
  static const sbf_quat down = {0, 0, -0.5f, 0.8660254f}; /* 60 degrees */
  for (int i = 0; i < 2; i++) {
    sbfi_scene_channel *channel = scene_clip(&scene, i ? "Idle" : "Idle_Gun", 1, 1);
    for (uint32_t n = 0; n < scene.node_count; n++)
      if (strcmp(scene.nodes[n].name, i ? "arm.L" : "arm.R") == 0) channel->node = (int32_t)n;
    channel->rotation_count = 1;
    channel->rotation_times = &time;
    channel->rotations = &down;
  }
  scene_end(&scene);
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_asset *a = c.asset;
  const sbf_pose *pose = &a->poses.at[a->gaits.at[0].rest_pose];
  double heading[3];
  ck_assert_uint_eq(pose->keys.count, 1);
  direction(a, pose, bone_named(a, "arm.L"), bone_named(a, "elbow.L"), heading);
  ck_assert_double_eq_tol(asin(-heading[1]) / DEGREE, 60, 0.1);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rest_pose");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, arms_are_lowered);
  tcase_add_test(tests, arms_after_long_collarbones_are_lowered);
  tcase_add_test(tests, hanging_arms_are_unchanged);
  tcase_add_test(tests, arms_swing_against_legs);
  tcase_add_test(tests, ears_are_no_arms);
  tcase_add_test(tests, a_clip_sets_the_stance);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
