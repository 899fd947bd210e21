#include <math.h>

#include "gait_stage.h"
#include "harness.h"
#include "quadruped.h"
#include "sbrun/terrain.h"

/* The positions that a ground was queried for. */
typedef struct asked {
  const gait_stage *walk;
  double farthest;
} asked;

static double plain(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  asked *a = (asked *)(uintptr_t)ground->user;
  *normal = (sbf_vec3){0, 1, 0};
  if (a) {
    const sbf_vec3 *at = &a->walk->state->motion.position;
    a->farthest = fmax(a->farthest, hypot(x - (double)at->x, z - (double)at->z));
  }
  return 0;
}

/* Level until z = 1, a metre lower from there on. */
static double cliff(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)ground, (void)x;
  *normal = (sbf_vec3){0, 1, 0};
  return z > 1 ? -1 : 0;
}

/* Level until z = 1, then of a slope. */
static double bank(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  double rise = ground->parameters[0], length = sqrt(1 + rise * rise);
  (void)x;
  *normal = z > 1 ? (sbf_vec3){0, (float)(1 / length), (float)(-rise / length)} : (sbf_vec3){0, 1, 0};
  return z > 1 ? rise * (z - 1) : 0;
}

/* A slope to the side. */
static double hillside(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  double rise = ground->parameters[0], length = sqrt(1 + rise * rise);
  (void)z;
  *normal = (sbf_vec3){(float)(-rise / length), (float)(1 / length), 0};
  return rise * x;
}

START_TEST(no_foot_steps_over_an_edge)
{
  gait_stage w;
  gait_stage_begin_on(&w, quadruped_asset(), cliff, 0);
  w.input.forward = 0.3f;
  for (int i = 0; i < 900; i++) {
    gait_stage_ticks(&w, 1);
    for (int l = 0; l < 4; l++)
      if (w.state->feet[l].planted) ck_assert_float_le(w.state->feet[l].ground.z, 1);
  }
  ck_assert_float_gt(w.state->motion.position.z, 0.4f); /* it comes near */
  ck_assert_float_lt(w.state->motion.position.z, 1.2f); /* and stops */
  float stopped = w.state->motion.position.z;
  w.input.forward = -0.3f;
  gait_stage_ticks(&w, 300);
  ck_assert_float_lt(w.state->motion.position.z, stopped - 0.8f); /* it can move back */
  gait_stage_end(&w);
}
END_TEST

START_TEST(slopes_are_walked_unless_they_are_too_steep)
{
  gait_stage steep, mild;
  gait_stage_begin_on(&steep, quadruped_asset(), bank, 1.6);
  gait_stage_begin_on(&mild, quadruped_asset(), bank, 0.5);
  steep.input.forward = mild.input.forward = 0.3f;
  gait_stage_ticks(&steep, 900);
  gait_stage_ticks(&mild, 900);
  for (int l = 0; l < 4; l++) ck_assert_float_le(steep.state->feet[l].ground.z, 1.01f);
  ck_assert_float_gt(mild.state->motion.position.z, 3);
  gait_stage_end(&steep);
  gait_stage_end(&mild);
}
END_TEST

START_TEST(feet_and_body_tilt_with_the_ground)
{
  gait_stage w;
  gait_stage_begin_on(&w, quadruped_asset(), hillside, 0.3);
  w.input.forward = 0.2f;
  gait_stage_ticks(&w, 300);
  sbf_vec3 up = {0, 1, 0}, wanted = sbri_normalize(sbri_vec3(-0.3f, 1, 0), up);
  for (int l = 0; l < 4; l++) {
    ck_assert_float_ge(sbri_dot(w.state->feet[l].normal, wanted), 0.9999f);
    sbf_quat back = sbri_quat_conjugate(w.rig.bones.rest[w.rig.legs[l].foot].rotation);
    sbf_quat turned = sbri_quat_multiply(w.pose[w.rig.legs[l].foot].rotation, back);
    ck_assert_float_ge(sbri_dot(sbri_rotate(turned, up), wanted), 0.999f);
  }
  sbf_vec3 body = sbri_rotate(w.state->posture.root.rotation, up);
  ck_assert_float_lt(body.x, -0.05f); /* it rolls to the same side, by its fraction */
  gait_stage_end(&w);
}
END_TEST

START_TEST(a_sole_rests_as_a_board_does)
{
  gait_stage w;
  gait_stage_begin_on(&w, quadruped_asset(), bank, 0.25);
  for (int l = 0; l < 4; l++)
    w.rig.legs[l].sole = (sbri_sole){.left = 0.03f, .right = -0.03f, .toe = 0.05f, .heel = -0.05f};
  sbf_vec3 position = {0, 0, 1}, normal; /* half of it on the level, half on the bank */
  sbri_set_sole_on_ground(&w.rig, w.state, &w.input, 0, &position, &normal);
  float slope = -normal.z / normal.y;
  ck_assert_float_eq_tol(slope, 0.125f, 0.01f);
  for (float z = -0.05f; z <= 0.051f; z += 0.01f) {
    sbf_vec3 unused;
    double ground = bank(&w.ground, 0, 1 + (double)z, &unused);
    ck_assert_double_ge((double)(position.y + slope * z), ground - 1e-6);
  }
  gait_stage_end(&w);
}
END_TEST

START_TEST(steering_sees_no_farther_than_its_range)
{
  double farthest[2];
  const float speeds[2] = {0.1f, 0.6f};
  for (int k = 0; k < 2; k++) {
    gait_stage w;
    asked a = {&w, 0};
    gait_stage_begin_on(&w, quadruped_asset(), plain, 0);
    w.ground.user = &a;
    w.rig.tails.count = 0; /* which asks for the ground below it */
    w.input.forward = speeds[k];
    gait_stage_ticks(&w, 600);
    farthest[k] = a.farthest;
    gait_stage_end(&w);
  }
  ck_assert_double_lt(farthest[0], farthest[1]);       /* the faster, the farther ahead */
  ck_assert_double_lt(farthest[1], 0.33 + 0.32 + 0.3); /* home, leg and step length */
}
END_TEST

/* Maximum depth of any sole point in the ground, during a step and at rest; m. */
static float deepest(const gait_stage *w) {
  float max = 0;
  for (int l = 0; l < 4; l++) {
    const sbri_foot *foot = &w->state->feet[l];
    sbf_vec3 unused;
    double ground = w->ground.height(&w->ground, (double)foot->ground.x, (double)foot->ground.z, &unused);
    max = fmaxf(max, (float)ground - foot->ground.y - foot->lift);
  }
  return max;
}

/* Boards and a pole lie across the path, narrower than a step and higher than a foot is lifted without
 * them. */
START_TEST(feet_clear_obstacles_in_between)
{
  static const sbr_obstacle things[] = {
      {SBR_OBSTACLE_BOX, {0, 0.03, 0.6}, {2, 0.03f, 0.02f}, 0}, /* 6 cm high, where feet are lifted by 4 */
      {SBR_OBSTACLE_BOX, {0, 0.03, 1.1}, {2, 0.03f, 0.02f}, 0.2f},
      {SBR_OBSTACLE_SPHERE, {0.12, 0, 1.6}, {0.05f, 0, 0}, 0},
      {SBR_OBSTACLE_CYLINDER, {-0.12, 0, 1.8}, {0.03f, 0.05f, 0}, 0}};
  sbr_ground floor = sbr_ground_flat(0);
  const sbr_obstacle_set set = {&floor, things, 4};
  gait_stage w;
  gait_stage_begin_on(&w, quadruped_asset(), plain, 0);
  w.ground = sbr_ground_with_obstacles(&set);
  w.input.forward = 0.25f;
  float max = 0, lift = 0;
  for (int i = 0; i < 1200; i++) {
    gait_stage_ticks(&w, 1);
    max = fmaxf(max, deepest(&w));
    for (int l = 0; l < 4; l++) lift = fmaxf(lift, w.state->feet[l].lift);
  }
  ck_assert_float_le(max, 1e-3f);
  ck_assert_float_gt(lift, 0.055f);
  ck_assert_float_gt(w.state->motion.position.z, 2.5f); /* it has passed all of them */
  gait_stage_end(&w);
}
END_TEST

START_TEST(a_wall_is_not_climbed)
{
  static const sbr_obstacle wall = {SBR_OBSTACLE_BOX, {0, 0.5, 1.25}, {3, 0.5f, 0.25f}, 0};
  sbr_ground floor = sbr_ground_flat(0);
  const sbr_obstacle_set set = {&floor, &wall, 1};
  gait_stage w;
  gait_stage_begin_on(&w, quadruped_asset(), plain, 0);
  w.ground = sbr_ground_with_obstacles(&set);
  w.input.forward = 0.3f;
  for (int i = 0; i < 900; i++) {
    gait_stage_ticks(&w, 1);
    for (int l = 0; l < 4; l++) ck_assert_float_le(w.state->feet[l].ground.y, 0.01f);
  }
  ck_assert_float_gt(w.state->motion.position.z, 0.4f);
  ck_assert_float_lt(w.state->motion.position.z, 1.1f);
  gait_stage_end(&w);
}
END_TEST

/* Characters walk on grounds by ray casts, triangles and heights as on any other ground. */
static double ray_down(void *user, sbr_double3 from, double length, sbf_vec3 *normal) {
  (void)user;
  double height = 0.15 * from.z, travel = from.y - height, unit = sqrt(1 + 0.15 * 0.15);
  *normal = (sbf_vec3){0, (float)(1 / unit), (float)(-0.15 / unit)};
  return travel <= length ? travel : -1;
}

START_TEST(every_kind_of_ground_carries_the_same_walk)
{
  static const sbf_vec3 corners[4] = {{-9, -1.35f, -9}, {9, -1.35f, -9}, {-9, 1.35f, 9}, {9, 1.35f, 9}};
  static const uint32_t triangles[6] = {0, 2, 1, 1, 2, 3};
  static const float heights[4] = {-1.35f, -1.35f, 1.35f, 1.35f};
  static const sbr_height_field field = {heights, 2, 2, 18, -9, -9};
  static const sbr_ray_caster caster = {ray_down, NULL, 10, 100, 0};
  sbr_ground_mesh *mesh;
  ck_assert_int_eq(sbr_ground_mesh_create(NULL, corners, 4, triangles, 2, -99, &mesh, NULL), SBF_OK);
  const sbr_ground grounds[4] = {sbr_ground_plane(0, (sbf_vec3){0, 1, -0.15f}), sbr_ground_from_mesh(mesh),
      sbr_ground_height_field(&field), sbr_ground_from_rays(&caster)};
  sbf_vec3 ends[4];
  for (int g = 0; g < 4; g++) {
    gait_stage w;
    gait_stage_begin_on(&w, quadruped_asset(), plain, 0);
    w.ground = grounds[g];
    sbri_gait_reset(&w.rig, w.state, &w.input, (sbf_vec3){0, 0, 0}, 0);
    w.input.forward = 0.25f;
    for (int i = 0; i < 480; i++) {
      gait_stage_ticks(&w, 1);
      ck_assert_float_le(deepest(&w), 1e-3f);
    }
    ends[g] = w.pose[3].position;
    ck_assert_float_gt(ends[g].z, 1.5f);
    ck_assert_float_le(sbri_length(sbri_sub(ends[g], ends[0])), 0.02f);
    gait_stage_end(&w);
  }
  sbr_ground_mesh_destroy(mesh);
}
END_TEST

START_TEST(without_a_chest_it_pitches_as_its_feet_lie)
{
  gait_stage w;
  gait_stage_begin_on(&w, quadruped_asset(), bank, 0.3);
  sbf_gait gait = w.asset->gaits.at[0];
  gait.chest = -1; /* as of a spider */
  w.asset->gaits.at = &gait;
  gait_stage_remake(&w);
  sbri_gait_reset(&w.rig, w.state, &w.input, (sbf_vec3){0, 0, 3}, 0);
  gait_stage_ticks(&w, 2);
  float fraction = w.rig.gait->body_tilt;
  ck_assert_float_eq_tol(-w.state->posture.hips_pitch, fraction * atanf(0.3f), 0.02f);
  gait_stage_end(&w);
}
END_TEST

/* A ridge along the way, between the feet. */
static double ridge(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)z;
  *normal = (sbf_vec3){0, 1, 0};
  return fabs(x) < 0.03 ? ground->parameters[0] : 0;
}

START_TEST(the_belly_stays_above_the_ground)
{
  const float low = 0.2f, high = 0.195f;
  float lowest[2];
  for (uint32_t bellies = 0; bellies < 2; bellies++) {
    gait_stage w;
    gait_stage_begin_on(&w, quadruped_asset(), ridge, (double)high);
    w.rig.stand.belly[0] = (sbf_vec3){0, low, 0};
    w.rig.stand.belly_count = bellies;
    w.input.forward = 0.15f;
    lowest[bellies] = 1;
    for (int i = 0; i < 240; i++) {
      gait_stage_ticks(&w, 1);
      sbf_vec3 at = sbri_rotate(w.state->posture.root.rotation, (sbf_vec3){0, low, 0});
      float over = w.state->posture.root.position.y + at.y - high;
      if (i > 60 && over < lowest[bellies]) lowest[bellies] = over;
    }
    gait_stage_end(&w);
  }
  ck_assert_float_le(lowest[0], 0.006f); /* no higher than it stands on level ground */
  ck_assert_float_ge(lowest[1], 0.006f);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("footing");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, no_foot_steps_over_an_edge);
  tcase_add_test(tests, slopes_are_walked_unless_they_are_too_steep);
  tcase_add_test(tests, feet_and_body_tilt_with_the_ground);
  tcase_add_test(tests, a_sole_rests_as_a_board_does);
  tcase_add_test(tests, steering_sees_no_farther_than_its_range);
  tcase_add_test(tests, feet_clear_obstacles_in_between);
  tcase_add_test(tests, a_wall_is_not_climbed);
  tcase_add_test(tests, without_a_chest_it_pitches_as_its_feet_lie);
  tcase_add_test(tests, the_belly_stays_above_the_ground);
  tcase_add_test(tests, every_kind_of_ground_carries_the_same_walk);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
