/* Bodies driven towards the animation, each with its own fraction of the drive's strength. */
#include <math.h>

#include "harness.h"
#include "rigid_person.h"
#include "sbrun/animation.h"

/* ---- A trunk that its bone moves, with arms that stand out level from it ---- */

enum { ARMS = 3 };

static const float KG = 2, REACH_M = 0.25f, G = 9.81f, TURN = 6.28318530718f;
/* Inertia about the joint as drives compute it: the mean of the box's own over all axes, plus the lever
 * arm's. */
static const float MOMENT = 2 * 0.0625f + 0.02f;

static scene arms(void) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -G, 0};
  sbf_bone *bones = sbf_asset_allocate(s.asset, ARMS + 1, sizeof *bones);
  ck_assert_ptr_nonnull(bones);
  for (int i = 0; i <= ARMS; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = "bone";
    bones[i].parent = i ? 0 : -1;
    bones[i].head = (sbf_vec3){i ? 0.2f : 0, 0, i ? (float)i - 2 : 0};
  }
  s.asset->bones = (sbf_bone_list){bones, ARMS + 1};
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 3}, 20);
  for (int i = 1; i <= ARMS; i++) {
    sbf_vec3 head = bones[i].head, middle = {head.x + REACH_M, head.y, head.z};
    uint32_t arm = rigid_box(&s, middle, (sbf_vec3){0.4f, 0.1f, 0.1f}, KG);
    rigid_body(&s, arm)->bone = i;
    (void)rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, 0, arm, head, rigid_along_x);
  }
  rigid_body(&s, 0)->bone = 0;
  for (uint32_t i = 0; i <= ARMS; i++) rigid_body(&s, i)->motion = SBF_BODY_MOTION_KINEMATIC;
  return s;
}

static void drive_all(const scene *s) {
  sbr_character_set_rigid_mode(s->world, s->character, -1, SBR_RIGID_DRIVEN);
  sbr_character_set_rigid_mode(s->world, s->character, 0, SBR_RIGID_KINEMATIC);
}

static void give(const scene *s, int32_t body, float fraction) {
  sbr_character_set_rigid_drive_fraction(s->world, s->character, body, fraction);
}

/* Each arm has its own drive fraction. */
static scene arms_sharing(const float fractions[ARMS]) {
  scene s = arms();
  scene_start(&s);
  drive_all(&s);
  for (int i = 0; i < ARMS; i++) give(&s, i + 1, fractions[i]);
  return s;
}

/* How far below level an arm is, rad. */
static float sag(const scene *s, uint32_t arm) {
  return asinf(-rigid_state(s, arm).center.y / REACH_M);
}

static float angular_velocity(const scene *s, uint32_t body) {
  sbf_vec3 w = rigid_state(s, body).angular_velocity;
  return sqrtf(w.x * w.x + w.y * w.y + w.z * w.z);
}

/* The angle at which drive and weight balance, with the drive as a spring or limited to its strength. */
static float even(float fraction) {
  sbr_rigid_drive drive = sbr_default_rigid_drive();
  float w = TURN * drive.frequency_hz, spring = fraction * MOMENT * w * w, max = fraction * drive.strength;
  if (max < 1) {
    float cut = acosf(max);
    if (spring * cut >= max * KG * G * REACH_M) return cut;
  }
  float angle = 0;
  for (int i = 0; i < 50; i++) angle = KG * G * REACH_M * cosf(angle) / spring;
  return angle;
}

START_TEST(the_drive_fraction_scales_the_drive)
{
  static const float fractions[5][ARMS] = {
      {1, 0.75f, 0.6f}, {0.6f, 1, 0.4f}, {0.4f, 0.3f, 0.2f}, {0, 1, 0.1f}, {0.05f, 0.45f, 0}};
  scene s = arms();
  scene_start(&s);
  sbr_rigid_drive drive = sbr_default_rigid_drive();
  drive.joint_friction = 0; /* friction would stop it earlier */
  sbr_character_set_rigid_drive(s.world, s.character, &drive);
  drive_all(&s);
  for (uint32_t i = 0; i < ARMS; i++) give(&s, (int32_t)i + 1, fractions[_i][i]);
  scene_ticks(&s, 1200);
  for (uint32_t i = 0; i < ARMS; i++) {
    ck_assert_float_le(angular_velocity(&s, i + 1), 0.01f);
    ck_assert_float_eq_tol(sag(&s, i + 1), even(fractions[_i][i]), 0.01f);
  }
  scene_free(&s);
}
END_TEST

/* Each arm moves as if the others had the same fraction. */
START_TEST(fractions_belong_to_one_bone_each)
{
  static const float fractions[ARMS] = {0, 1, 0.3f};
  scene mixed = arms_sharing(fractions);
  scene alone[ARMS];
  for (int i = 0; i < ARMS; i++) {
    alone[i] = arms();
    scene_start(&alone[i]);
    drive_all(&alone[i]);
    give(&alone[i], -1, fractions[i]);
  }
  for (int tick = 0; tick < 120; tick++) {
    scene_ticks(&mixed, 1);
    for (int i = 0; i < ARMS; i++) {
      scene_ticks(&alone[i], 1);
      ck_assert_float_eq_tol(sag(&mixed, (uint32_t)i + 1), sag(&alone[i], (uint32_t)i + 1), 1e-3f);
    }
  }
  for (int i = 0; i < ARMS; i++) scene_free(&alone[i]);
  scene_free(&mixed);
}
END_TEST

/* ---- Fractions of 0 and 1 ---- */

/* The same bits as a passive one. */
START_TEST(a_zero_drive_fraction_gives_a_ragdoll)
{
  sbr_rigid_state at[2][PARTS];
  for (int driven = 0; driven < 2; driven++) {
    scene s = person();
    scene_start(&s);
    sbr_character_set_rigid_mode(s.world, s.character, -1, driven ? SBR_RIGID_DRIVEN : SBR_RIGID_PASSIVE);
    if (driven) give(&s, -1, 0);
    person_shove(&s, 1, (sbf_vec3){40, 0, 60});
    scene_ticks(&s, 90);
    for (uint32_t b = 0; b < PARTS; b++) at[driven][b] = rigid_state(&s, b);
    scene_free(&s);
  }
  for (uint32_t b = 0; b < PARTS; b++) {
    ck_assert_mem_eq(&at[0][b].frame, &at[1][b].frame, sizeof at[0][b].frame);
    ck_assert_mem_eq(&at[0][b].velocity, &at[1][b].velocity, sizeof at[0][b].velocity);
  }
}
END_TEST

/* A thousandth of the drive has almost no effect; the soft tissue about the joint damps as much. */
START_TEST(a_small_drive_fraction_is_nearly_a_ragdoll)
{
  static const float fractions[ARMS] = {0, 0.001f, 0.01f};
  scene s = arms_sharing(fractions);
  for (int tick = 0; tick < 180; tick++) {
    scene_ticks(&s, 1);
    ck_assert_float_eq_tol(rigid_state(&s, 2).center.y, rigid_state(&s, 1).center.y, 0.002f);
    ck_assert_float_eq_tol(rigid_state(&s, 3).center.y, rigid_state(&s, 1).center.y, 0.02f);
  }
  scene_free(&s);
}
END_TEST

/* ---- An animation ---- */

enum { KEYS = 61 };

static const float SWING = 0.3f, HZ = 0.5f;

/* All arms swing about Z, in a clip of two seconds. */
static void swing(scene *s, float times[KEYS], float values[4 * KEYS]) {
  sbf_clip *clip = sbf_asset_allocate(s->asset, 1, sizeof *clip);
  sbf_track *tracks = sbf_asset_allocate(s->asset, ARMS, sizeof *tracks);
  ck_assert(clip && tracks);
  for (int k = 0; k < KEYS; k++) {
    times[k] = 2.0f * (float)k / (KEYS - 1);
    float half = 0.5f * SWING * sinf(TURN * HZ * times[k]);
    values[4 * k] = values[4 * k + 1] = 0, values[4 * k + 2] = sinf(half), values[4 * k + 3] = cosf(half);
  }
  sbf_clip_init(clip);
  clip->id = clip->name = "swing";
  clip->duration = 2;
  clip->loop = true;
  clip->tracks = (sbf_track_list){tracks, ARMS};
  for (int i = 0; i < ARMS; i++) {
    sbf_track_init(&tracks[i]);
    tracks[i].bone = i + 1;
    tracks[i].property = SBF_TRACK_PROPERTY_ROTATION;
    tracks[i].times = (sbf_f32_list){times, KEYS};
    tracks[i].values = (sbf_f32_list){values, 4 * KEYS};
  }
  s->asset->clips = (sbf_clip_list){clip, 1};
}

static scene swinging(float times[KEYS], float values[4 * KEYS]) {
  scene s = arms();
  swing(&s, times, values);
  scene_start(&s);
  sbr_clip_play how = sbr_default_clip_play();
  sbr_character_play_clip(s.world, s.character, 0, 0, &how);
  return s;
}

START_TEST(settings_without_their_cookie_change_nothing)
{
  float times[KEYS], values[4 * KEYS];
  scene s = swinging(times, values);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  sbr_rigid_drive drive = sbr_default_rigid_drive();
  sbr_clip_play how = sbr_default_clip_play();
  drive.strength = 7, how.speed = 3;
  drive.cookie = how.cookie = 0;
  sbr_character_set_rigid_drive(s.world, s.character, &drive);
  sbr_character_play_clip(s.world, s.character, 1, 0, &how);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hash);
  drive.cookie = sbr_default_rigid_drive().cookie;
  sbr_character_set_rigid_drive(s.world, s.character, &drive);
  uint64_t driven = sbr_world_get_state_hash(s.world);
  ck_assert_uint_ne(driven, hash);
  how.cookie = sbr_default_clip_play().cookie;
  sbr_character_play_clip(s.world, s.character, 1, 0, &how);
  ck_assert_uint_ne(sbr_world_get_state_hash(s.world), driven);
  scene_free(&s);
}
END_TEST

/* Kinematic bodies are at the pose. Driven ones lag by the drive's damping and the weight, less with a
 * greater fraction. */
START_TEST(driven_bodies_follow_the_animation)
{
  float times[KEYS], values[4 * KEYS], worst[ARMS] = {0};
  static const float fractions[ARMS] = {1, 0.75f, 0.2f};
  scene s = swinging(times, values), exact = swinging(times, values);
  drive_all(&s);
  for (int i = 0; i < ARMS; i++) give(&s, i + 1, fractions[i]);
  for (int tick = 1; tick <= 300; tick++) {
    scene_ticks(&s, 1);
    scene_ticks(&exact, 1);
    float pose = SWING * sinf(TURN * HZ * (float)tick / 60);
    ck_assert_float_eq_tol(-sag(&exact, 1), pose, 2e-3f);
    for (uint32_t i = 0; i < ARMS && tick > 60; i++)
      worst[i] = fmaxf(worst[i], fabsf(sag(&s, i + 1) - sag(&exact, i + 1)));
  }
  ck_assert_float_le(worst[0], 0.14f);
  ck_assert_float_gt(worst[1], worst[0]);
  ck_assert_float_gt(worst[2], 2 * worst[1]);
  scene_free(&s);
  scene_free(&exact);
}
END_TEST

/* ---- Changes of the fraction ---- */

/* Maximum change of an arm's angular velocity in a tick, by weight, a full drive and the damping of both. */
static float max_change(float damped_rad_s) {
  sbr_rigid_drive drive = sbr_default_rigid_drive();
  float about_end = KG * REACH_M * REACH_M; /* less than its own moment about the joint */
  return (KG * G * REACH_M * (1 + drive.strength) / about_end + drive.joint_damping_1_s * damped_rad_s) / 60;
}

/* At any change of the drive fraction no body rotates suddenly. */
START_TEST(fractions_change_without_a_jump)
{
  scene s = arms();
  scene_start(&s);
  drive_all(&s);
  float before[ARMS] = {0}, was[ARMS] = {0}, lowest = 0;
  for (int tick = 0; tick < 600; tick++) {
    float ramp = fabsf(1 - (float)(tick % 240) / 120);
    give(&s, 1, ramp);
    give(&s, 2, tick % 120 < 60 ? 1 : 0);
    give(&s, 3, tick % 90 < 45 ? 0.1f : 0.9f);
    scene_ticks(&s, 1);
    for (uint32_t i = 0; i < ARMS; i++) {
      float now = angular_velocity(&s, i + 1), coordinate = sag(&s, i + 1), faster = fmaxf(now, before[i]);
      ck_assert_float_le(fabsf(now - before[i]), max_change(faster));
      ck_assert_float_le(fabsf(coordinate - was[i]), 1.1f * faster / 60 + 1e-3f);
      before[i] = now, was[i] = coordinate;
      lowest = fmaxf(lowest, coordinate);
    }
  }
  ck_assert_float_ge(lowest, 1); /* it did fall meanwhile */
  scene_free(&s);
}
END_TEST

/* Released in the middle of a swing, it continues its motion instead of starting at rest. */
START_TEST(released_bodies_keep_their_velocity)
{
  float times[KEYS], values[4 * KEYS];
  scene s = swinging(times, values);
  scene_ticks(&s, 120);
  drive_all(&s);
  if (_i == 0) give(&s, -1, 0);
  float kept = angular_velocity(&s, 1);
  ck_assert_float_ge(kept, 0.9f * SWING * TURN * HZ);
  scene_ticks(&s, 1);
  ck_assert_float_le(fabsf(angular_velocity(&s, 1) - kept), max_change(kept));
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rigid_share");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, the_drive_fraction_scales_the_drive, 0, 5);
  tcase_add_test(tests, fractions_belong_to_one_bone_each);
  tcase_add_test(tests, a_zero_drive_fraction_gives_a_ragdoll);
  tcase_add_test(tests, a_small_drive_fraction_is_nearly_a_ragdoll);
  tcase_add_test(tests, driven_bodies_follow_the_animation);
  tcase_add_test(tests, fractions_change_without_a_jump);
  tcase_add_loop_test(tests, released_bodies_keep_their_velocity, 0, 2);
  tcase_add_test(tests, settings_without_their_cookie_change_nothing);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
