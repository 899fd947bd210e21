#include <math.h>
#include <string.h>

#include "conversions.h"

static const sbf_clip *clip_named(const sbf_asset *a, const char *name) {
  for (uint32_t i = 0; i < a->clips.count; i++)
    if (strcmp(a->clips.at[i].name, name) == 0) return &a->clips.at[i];
  ck_abort_msg("no clip is named %s", name);
  return NULL;
}

/* The track of a bone, NULL where it rests. */
static const sbf_track *track_of(const sbf_clip *clip, int32_t bone, sbf_track_property property) {
  for (uint32_t i = 0; i < clip->tracks.count; i++)
    if (clip->tracks.at[i].bone == bone && clip->tracks.at[i].property == property)
      return &clip->tracks.at[i];
  return NULL;
}

/* --- Frames of bones at a key, as sbf.md 8.1 and 14.1 put them together ------------------------------- */

typedef struct frame {
  double at[3][4]; /* rotation and place */
} frame;

static frame frame_of(sbf_vec3 p, sbf_quat q) {
  const double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w;
  return (frame){{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), (double)p.x},
      {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), (double)p.y},
      {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), (double)p.z}}};
}

static frame product(const frame *a, const frame *b) {
  frame out;
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 4; k++)
      out.at[r][k] = a->at[r][0] * b->at[0][k] + a->at[r][1] * b->at[1][k] + a->at[r][2] * b->at[2][k] +
                     (k == 3 ? a->at[r][3] : 0);
  return out;
}

static frame undone(const frame *a) {
  frame out;
  for (int r = 0; r < 3; r++) {
    for (int k = 0; k < 3; k++) out.at[r][k] = a->at[k][r];
    out.at[r][3] = -(a->at[0][r] * a->at[0][3] + a->at[1][r] * a->at[1][3] + a->at[2][r] * a->at[2][3]);
  }
  return out;
}

/* Of a bone at a time at which it and those above it have keys. */
static frame frame_at(const sbf_asset *a, const sbf_clip *clip, int32_t bone, float time) {
  const sbf_bone *b = &a->bones.at[bone];
  frame rest = frame_of(b->head, b->rotation), above;
  if (b->parent != SBF_NONE) {
    frame parent = frame_of(a->bones.at[b->parent].head, a->bones.at[b->parent].rotation);
    above = frame_at(a, clip, b->parent, time);
    parent = undone(&parent);
    rest = product(&parent, &rest);
  }
  const sbf_track *p = track_of(clip, bone, SBF_TRACK_PROPERTY_TRANSLATION);
  const sbf_track *q = track_of(clip, bone, SBF_TRACK_PROPERTY_ROTATION);
  for (uint32_t i = 0; p && i < p->times.count; i++)
    if (p->times.count == 1 || p->times.at[i] == time)
      for (int r = 0; r < 3; r++) rest.at[r][3] = (double)p->values.at[3 * i + (uint32_t)r];
  for (uint32_t i = 0; q && i < q->times.count; i++) {
    if (q->times.count > 1 && q->times.at[i] != time) continue;
    const float *v = q->values.at + 4 * (size_t)i;
    frame turned = frame_of((sbf_vec3){(float)rest.at[0][3], (float)rest.at[1][3], (float)rest.at[2][3]},
        (sbf_quat){v[0], v[1], v[2], v[3]});
    rest = turned;
  }
  return b->parent == SBF_NONE ? rest : product(&above, &rest);
}

static void check_place(const frame *f, double x, double y, double z, double within) {
  check_near((sbf_vec3){(float)f->at[0][3], (float)f->at[1][3], (float)f->at[2][3]}, x, y, z, within);
}

/* --- By hand ----------------------------------------------------------------------------------------- */

static const float two_times[2] = {0, 1}, half = 0.70710678f;

/* Centimetres, a group between two bones that moves as well, and bones that run along X: frames are turned.
 */
START_TEST(tracks_are_of_frames_in_their_parents)
{
  static const sbf_vec3 group_moves[2] = {{0, 0, 0}, {0, 0, 50}};
  const sbf_quat turns[2] = {{0, 0, 0, 1}, {0, 0, half, half}};
  sbfi_scene scene;
  scene_begin(&scene);
  scene.unit_m = 0.01;
  int32_t armature = scene_node(&scene, "armature", SBF_NONE, false, 0, 100, 0);
  int32_t upper = scene_node(&scene, "upper", armature, true, 0, 0, 0);
  int32_t group = scene_node(&scene, "group", upper, false, 0, 0, 0);
  int32_t lower = scene_node(&scene, "lower", group, true, 100, 0, 0);
  int32_t tip = scene_node(&scene, "tip", lower, true, 100, 0, 0);
  sbfi_scene_channel *channels = scene_clip(&scene, "bend", 1, 2);
  channels[0] = (sbfi_scene_channel){
      .node = group, .position_count = 2, .position_times = two_times, .positions = group_moves};
  channels[1] = (sbfi_scene_channel){
      .node = lower, .rotation_count = 2, .rotation_times = two_times, .rotations = turns};
  scene_end(&scene);
  (void)tip;
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_asset *a = c.asset;
  const sbf_clip *clip = clip_named(a, "bend");
  ck_assert_float_eq(clip->duration, 1);
  ck_assert_uint_eq(clip->tracks.count, 2); /* of the lower bone alone: the others rest */
  ck_assert_int_eq(clip->tracks.at[0].bone, bone_named(a, "lower"));
  frame lower_frame = frame_at(a, clip, bone_named(a, "lower"), 1);
  check_place(&lower_frame, 1, 1, 0.5, 1e-6);
  frame tip_frame = frame_at(a, clip, bone_named(a, "tip"), 1);
  check_place(&tip_frame, 1, 2, 0.5, 1e-6);
  for (int r = 0; r < 3; r++) ck_assert_double_eq_tol(tip_frame.at[r][1], r == 1, 1e-6); /* +Y along it */
  tip_frame = frame_at(a, clip, bone_named(a, "tip"), 0);
  check_place(&tip_frame, 2, 1, 0, 1e-6);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* What only says what rest says is no track; what stays the same is one key. */
START_TEST(tracks_are_as_short_as_they_can_be)
{
  static const sbf_vec3 rest[2] = {{0, 1, 0}, {0, 1, 0}}, aside[2] = {{0.5f, 1, 0}, {0.5f, 1, 0}},
                        size[2] = {{1, 1, 1}, {2, 2, 2}};
  static const sbf_quat none[2] = {{0, 0, 0, 1}, {0, 0, 0, -1}};
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t root = scene_node(&scene, "root", SBF_NONE, true, 0, 0, 0);
  int32_t one = scene_node(&scene, "one", root, true, 0, 1, 0);
  int32_t two = scene_node(&scene, "two", one, true, 0, 1, 0);
  int32_t lamp = scene_node(&scene, "lamp", root, false, 0, 0, 0);
  sbfi_scene_channel *channels = scene_clip(&scene, "still", 1, 3);
  channels[0] = (sbfi_scene_channel){.node = one,
      .position_count = 2,
      .position_times = two_times,
      .positions = rest,
      .rotation_count = 2,
      .rotation_times = two_times,
      .rotations = none};
  channels[1] = (sbfi_scene_channel){.node = two,
      .position_count = 2,
      .position_times = two_times,
      .positions = aside,
      .scale_count = 2,
      .scale_times = two_times,
      .scales = size};
  channels[2] = (sbfi_scene_channel){
      .node = lamp, .position_count = 2, .position_times = two_times, .positions = aside};
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  const sbf_clip *clip = clip_named(c.asset, "still");
  ck_assert_uint_eq(clip->tracks.count, 2);
  int32_t bone = bone_named(c.asset, "two");
  const sbf_track *position = track_of(clip, bone, SBF_TRACK_PROPERTY_TRANSLATION);
  ck_assert_uint_eq(position->times.count, 1);
  ck_assert_float_eq(position->values.at[0], 0.5f);
  const sbf_track *scale = track_of(clip, bone, SBF_TRACK_PROPERTY_SCALE);
  ck_assert_uint_eq(scale->times.count, 2);
  ck_assert_float_eq(scale->values.at[4], 2);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_KEYS), 1); /* the lamp */
  ck_assert_ptr_nonnull(strstr(converted_note(&c, SBF_CODE_IMPORT_KEYS)->message, "1 of 3"));
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(without_bones_nothing_moves)
{
  static const sbf_vec3 moves[2] = {{0, 0, 0}, {1, 0, 0}};
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t ball = scene_node(&scene, "ball", SBF_NONE, false, 0, 0, 0);
  scene_box(&scene, ball, 1, 0, 0, 0, false);
  *scene_clip(&scene, "roll", 1, 1) = (sbfi_scene_channel){
      .node = ball, .position_count = 2, .position_times = two_times, .positions = moves};
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, NULL, NULL);
  ck_assert_uint_eq(c.asset->clips.count, 0);
  ck_assert_uint_eq(converted_count(&c, SBF_CODE_IMPORT_IGNORED), 1);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* Flat and endless transforms cost their bone's keys, with a word, and nothing else. */
START_TEST(unreadable_keys_are_left_out)
{
  static const sbf_vec3 far_away[2] = {{0, 0, 0}, {3e38f, 0, 0}};
  sbfi_scene scene;
  scene_begin(&scene);
  int32_t armature = scene_node(&scene, "armature", SBF_NONE, false, 0, 0, 0);
  for (int r = 0; r < 3; r++) scene_local(&scene, armature)->at[r][r] = 1000;
  int32_t root = scene_node(&scene, "root", armature, true, 0, 0, 0);
  int32_t flat = scene_node(&scene, "flat", root, true, 0, 1, 0);
  scene_local(&scene, flat)->at[2][2] = 0;
  sbfi_scene_channel *channels = scene_clip(&scene, "odd", 1, 2);
  channels[0] = (sbfi_scene_channel){
      .node = root, .position_count = 2, .position_times = two_times, .positions = far_away};
  channels[1] = (sbfi_scene_channel){
      .node = flat, .position_count = 2, .position_times = two_times, .positions = far_away};
  scene_end(&scene);
  converted c;
  converted_scene(&c, &scene, &scene, NULL);
  ck_assert_uint_eq(clip_named(c.asset, "odd")->tracks.count, 0);
  const char *message = converted_note(&c, SBF_CODE_IMPORT_KEYS)->message;
  ck_assert_msg(strstr(message, "2 bones"), "%s", message);
  converted_free(&c);
  sbfi_scene_free(&scene);
}
END_TEST

/* --- Real files -------------------------------------------------------------------------------------- */

typedef struct known_clip {
  const char *file, *clip;
  uint32_t clips;
  double duration;
  uint32_t keys;     /* of the longest track */
  const char *moved; /* a bone, and where its head is at the last key: from the file's own numbers */
  double x, y, z;
  bool loop; /* it ends as it begins */
} known_clip;

/* Places of glTF joints are products of the file's own node transforms with the last keys, worked out apart.
 */
static const known_clip known_clips[] = {
    {"fox/fox.glb", "Run", 3, 1.15833, 25, "b_LeftFoot02_018", 9.30384, 0.0305671, -19.4112, true},
    {"fox/fox.glb", "Survey", 3, 3.41667, 83, "b_Head_05", -5.28204, 58.7805, 37.3504, true},
    {"greenman/greenman.glb", "2_move", 4, 1.25, 30, "leg_R", -0.527218, 0.493715, -0.136106, true},
    {"spider/spider.glb", "SpiderArmature|Spider_Walk", 5, 0.833333, 21, "FrontFoot.L", 1.69032, 0.024694,
        2.63525, true},
    {"spider/spider.glb", "SpiderArmature|Spider_Attack", 5, 0.75, 19, "MidBackLeg3.R", -2.55932, 0.876002,
        -0.927709, true},
    {"snake/snake.glb", "SnakeArmature|Snake_Attack", 4, 0.666667, 17, "LowerMouth", -0.025083, 2.39962,
        0.581074, true},
    {"walk-dae/walk.dae", "animation", 1, 5.791666, 139, "Hips", -0.0164799, 1.007704, 1.37236,
        false}, /* it looks and walks along +X and is turned to +Z */
    {"mocap/cmu_01_01.bvh", "Motion", 1, 22.92491, 2752, "Hips", 8.8787, 17.8124, 38.5426, false},
};

START_TEST(real_clips_match_their_files)
{
  const known_clip *known = &known_clips[_i];
  const char *path = harness_shared(known->file);
  if (!path) return;
  converted c;
  converted_file(&c, path, NULL);
  ck_assert_uint_eq(c.asset->clips.count, known->clips);
  const sbf_clip *clip = clip_named(c.asset, known->clip);
  ck_assert_double_eq_tol((double)clip->duration, known->duration, 1e-5);
  ck_assert_int_eq(clip->loop, known->loop);
  uint32_t max = 0;
  float last = 0;
  for (uint32_t i = 0; i < clip->tracks.count; i++) {
    const sbf_f32_list times = clip->tracks.at[i].times;
    if (times.count <= max) continue;
    max = times.count;
    last = times.at[max - 1];
  }
  ck_assert_uint_eq(max, known->keys);
  frame f = frame_at(c.asset, clip, bone_named(c.asset, known->moved), last);
  check_place(&f, known->x, known->y, known->z, 2e-4);
  converted_free(&c);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("convert_clips");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, tracks_are_of_frames_in_their_parents);
  tcase_add_test(tests, tracks_are_as_short_as_they_can_be);
  tcase_add_test(tests, without_bones_nothing_moves);
  tcase_add_test(tests, unreadable_keys_are_left_out);
  tcase_add_loop_test(tests, real_clips_match_their_files, 0, sizeof known_clips / sizeof *known_clips);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
