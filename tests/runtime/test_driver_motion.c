#include <math.h>

#include "harness.h"
#include "math/quat.h"
#include "math/vec3.h"
#include "sbrun/animation.h"
#include "scenes.h"
#include "state/world.h"

/* ---- A rod held along its middle, by a bone at its end that a clip moves ---- */

enum { RINGS = 9, AROUND = 4, POINTS = RINGS * (AROUND + 1) };

static const float LENGTH_M = 1.6f, RADIUS_M = 0.1f;

/* Rings of four about points of the middle, which the bone holds; springs along, around, across and to it. */
static void add_rod(scene *s, float stiffness) {
  static const float corners[AROUND][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  sbf_vec3 at[POINTS];
  float masses[POINTS];
  uint32_t pinned[RINGS], count = 0;
  sbf_uint2 ends[512];
  float k[512];
  for (uint32_t r = 0; r < RINGS; r++) {
    float z = LENGTH_M * (float)r / (RINGS - 1);
    pinned[r] = (AROUND + 1) * r;
    at[pinned[r]] = (sbf_vec3){0, 0, z};
    for (uint32_t i = 0; i < AROUND; i++)
      at[pinned[r] + 1 + i] = (sbf_vec3){RADIUS_M * corners[i][0], RADIUS_M * corners[i][1], z};
  }
  for (uint32_t a = 0; a < POINTS; a++) {
    masses[a] = a % (AROUND + 1) ? 0.5f : 0;
    for (uint32_t b = a + 1; b < POINTS && b < a + 2 * (AROUND + 1); b++) {
      if (a % (AROUND + 1) == 0 && b % (AROUND + 1) == 0) continue;
      sbf_vec3 d = {at[b].x - at[a].x, at[b].y - at[a].y, at[b].z - at[a].z};
      if (d.x * d.x + d.y * d.y + d.z * d.z > 0.09f) continue;
      ends[count] = (sbf_uint2){{a, b}};
      k[count++] = stiffness;
    }
  }
  scene_body(s, 0)->attributes.damping_ratio = 0.15f;
  sbf_level *level = scene_points(s, 0, at, masses, POINTS);
  scene_springs(s, level, ends, k, count);
  scene_pin(s, level, 0, pinned, RINGS);
}

enum { KEYS = 5 };

/* A clip of the bone with a key every 24th of a second, as animations are stored; played at once. */
static scene rod(sbf_track_property property, const float *values, uint32_t value_count) {
  static const float times[KEYS] = {0, 1 / 24.0f, 2 / 24.0f, 3 / 24.0f, 4 / 24.0f};
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0, 0});
  add_rod(&s, 4000);
  sbf_clip *clip = sbf_asset_allocate(s.asset, 1, sizeof *clip);
  sbf_track *track = sbf_asset_allocate(s.asset, 1, sizeof *track);
  sbf_clip_init(clip);
  sbf_track_init(track);
  clip->id = clip->name = "thrown";
  clip->duration = times[KEYS - 1];
  clip->loop = false;
  clip->tracks = (sbf_track_list){track, 1};
  track->bone = 0;
  track->property = property;
  track->times = (sbf_f32_list){times, KEYS};
  track->values = (sbf_f32_list){values, value_count};
  s.asset->clips = (sbf_clip_list){clip, 1};
  scene_start(&s);
  sbr_clip_play how = sbr_default_clip_play();
  sbr_character_play_clip(s.world, s.character, 0, 0, &how);
  return s;
}

/* Maximum distance of a free point from its position by the bone alone, in radii. */
static float farthest(const scene *s) {
  const sbri_character *c = sbri_character_of(s->world, s->character);
  const sbr_transform *bone = &sbri_pose(c)[0];
  const sbri_body *body = &c->model->bodies[0];
  float found = 0;
  for (uint32_t i = 0; i < POINTS; i++) {
    sbf_vec3 rest = body->level->positions.at[i], now = scene_point(s, 0, i);
    sbf_vec3 pinned = sbri_rotate(
        sbri_quat_multiply(bone->rotation, sbri_quat_conjugate(s->asset->bones.at[0].rotation)), rest);
    sbf_vec3 off = sbri_sub(now, sbri_add(bone->position, pinned));
    found = fmaxf(found, sqrtf(sbri_dot(off, off)) / RADIUS_M);
  }
  return found;
}

static void check(scene *s, float throws) {
  float fastest = 0;
  const sbri_character *c = sbri_character_of(s->world, s->character);
  for (int i = 0; i < 60; i++) {
    sbf_vec3 before = sbri_pose(c)[0].position;
    sbf_quat turned = sbri_pose(c)[0].rotation;
    scene_ticks(s, 1);
    sbf_vec3 displacement = sbri_sub(sbri_pose(c)[0].position, before);
    sbf_quat rotation = sbri_quat_multiply(sbri_pose(c)[0].rotation, sbri_quat_conjugate(turned));
    fastest = fmaxf(fastest, sqrtf(sbri_dot(displacement, displacement)) +
                                 LENGTH_M * 2 * sqrtf(fmaxf(0, 1 - rotation.w * rotation.w)));
    ck_assert_float_lt(farthest(s), 1); /* at 2 it may be inside out */
  }
  ck_assert_float_gt(fastest, throws); /* in m a tick: the clip was played */
  ck_assert_float_lt(farthest(s), 0.2f);
  scene_free(s);
}

START_TEST(thrown_bodies_follow_their_driver)
{
  static const float up[3 * KEYS] = {0, 0, 0, 0, 0.7f, 0, 0, 2.1f, 0, 0, 1.6f, 0, 0, 0, 0};
  scene s = rod(SBF_TRACK_PROPERTY_TRANSLATION, up, 3 * KEYS);
  check(&s, 0.4f);
}
END_TEST

START_TEST(whirled_bodies_follow_their_driver)
{
  /* About Y by 0, 0.5, 1.5, 1 and 0 radians, from the rest pose: up to 24 rad/s. */
  static const float turns[4 * KEYS] = {0.707106781f, 0, 0, 0.707106781f, 0.685124544f, 0.174941017f,
      -0.174941017f, 0.685124544f, 0.517382161f, 0.48199139f, -0.48199139f, 0.517382161f, 0.620544581f,
      0.339005049f, -0.339005049f, 0.620544581f, 0.707106781f, 0, 0, 0.707106781f};
  scene s = rod(SBF_TRACK_PROPERTY_ROTATION, turns, 4 * KEYS);
  check(&s, 0.5f);
}
END_TEST

START_TEST(bodies_stand_after_a_jump)
{
  static const float away[3 * KEYS] = {0, 0, 0, 0, 0, 6, 0, 0, 6, 0, 0, 6, 0, 0, 6};
  scene s = rod(SBF_TRACK_PROPERTY_TRANSLATION, away, 3 * KEYS);
  check(&s, 2);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("guiding");
  TCase *c = tcase_create("guiding");
  tcase_add_test(c, thrown_bodies_follow_their_driver);
  tcase_add_test(c, whirled_bodies_follow_their_driver);
  tcase_add_test(c, bodies_stand_after_a_jump);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
