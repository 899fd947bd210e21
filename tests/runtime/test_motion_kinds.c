/* Kinds of gait other than walking against their closed forms. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "animation/gait/motion_kinds.h"
#include "gait_stage.h"
#include "harness.h"
#include "math/quat.h"
#include "sbfmt/asset.h"

static const double PI = 3.14159265358979;
static const sbf_quat BACKWARD = {-0.70710678f, 0, 0, 0.70710678f}; /* +Y to -Z */
enum { BONES = 10 };
static const float LENGTH = 2;

/* A straight chain along -Z, its nose at half the length. */
static sbf_asset *chain(sbf_gait_kind kind, sbf_gait **gait, float height) {
  static const uint32_t all[BONES] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  sbf_asset *a = sbf_asset_create(NULL);
  sbf_bone *bones = sbf_asset_allocate(a, BONES, sizeof *bones);
  for (int i = 0; i < BONES; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].parent = i - 1;
    bones[i].head = sbri_vec3(0, height, LENGTH * (0.5f - (float)i / BONES));
    bones[i].rotation = BACKWARD;
    bones[i].length = LENGTH / BONES;
  }
  *gait = sbf_asset_allocate(a, 1, sizeof **gait);
  sbf_gait_init(*gait);
  (*gait)->kind = kind;
  (*gait)->body = 0;
  (*gait)->walk_speed = 1;
  sbf_undulation *wave = sbf_asset_allocate(a, 1, sizeof *wave);
  sbf_undulation_init(wave);
  wave->bones = (sbf_u32_list){all, BONES};
  (*gait)->undulation = wave;
  a->bones = (sbf_bone_list){bones, BONES};
  a->gaits = (sbf_gait_list){*gait, 1};
  return a;
}

static void float_at(sbf_asset *a, sbf_gait *gait, float altitude, float buoyancy) {
  sbf_medium *medium = sbf_asset_allocate(a, 1, sizeof *medium);
  sbf_medium_init(medium);
  medium->altitude = altitude;
  medium->buoyancy = buoyancy;
  gait->medium = medium;
}

/* The yaw that a bone has turned from rest against the heading. */
static double yaw_of(const gait_stage *s, uint32_t bone) {
  sbf_vec3 back = sbri_world_to_body(s->state, sbri_rotate(s->pose[bone].rotation, sbri_vec3(0, 1, 0)));
  return atan2((double)back.x, -(double)back.z);
}

START_TEST(a_wave_travels_at_its_frequency_times_its_length)
{
  sbf_gait *gait;
  sbf_asset *a = chain(SBF_GAIT_KIND_SWIM, &gait, 0);
  sbf_undulation *wave = (sbf_undulation *)(uintptr_t)gait->undulation;
  wave->amplitude = sbri_vec3(0.05f, 0, 0);
  wave->wavelength = 0.8f;
  wave->strouhal_number = 0.3f;
  gait_stage s;
  gait_stage_begin_scaled(&s, a, 1.0f / 240, 1);
  s.input.forward = 1;
  gait_stage_ticks(&s, 4 * 240);
  double f = 0.3 * 1 / (2 * 0.05 * (double)LENGTH), sums[2][2] = {{0}};
  uint32_t bones[2] = {2, 7};
  int ticks = (int)(240 * 4 / f + 0.5);
  for (int t = 0; t < ticks; t++) {
    gait_stage_ticks(&s, 1);
    for (int k = 0; k < 2; k++) {
      double slope = tan(yaw_of(&s, bones[k])), u = 2 * PI * f * t / 240;
      sums[k][0] += slope * cos(u), sums[k][1] += slope * sin(u);
    }
  }
  double lag = atan2(sums[1][1], sums[1][0]) - atan2(sums[0][1], sums[0][0]);
  while (lag < 0) lag += 2 * PI;
  double between = (double)LENGTH * 0.5; /* between the middles of two bones */
  ck_assert_double_eq_tol(2 * PI * f * between / lag, f * 0.8 * (double)LENGTH, 0.01 * f);
  double height = 2 * hypot(sums[0][0], sums[0][1]) / ticks; /* 2 pi a / lambda */
  ck_assert_double_eq_tol(height, 2 * PI * 0.05 / 0.8, 0.01);
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_wave_keeps_its_frequency_within_bounds)
{
  sbf_undulation wave;
  sbf_undulation_init(&wave);
  ck_assert_double_eq_tol((double)sbri_wave_frequency(&wave, 1, 1), 0.3 / 0.2, 1e-5);
  ck_assert_double_eq_tol((double)sbri_wave_frequency(&wave, 0, 1), 0.4, 1e-6);
  ck_assert_double_eq_tol((double)sbri_wave_frequency(&wave, 100, 1), 8, 1e-6);
  wave.amplitude = sbri_vec3(0, 0, 0);
  ck_assert_double_eq_tol((double)sbri_wave_frequency(&wave, 1, 1), 0.4, 1e-6);
}
END_TEST

START_TEST(it_banks_by_speed_times_angular_velocity_over_gravity)
{
  sbf_gait *gait;
  sbf_asset *a = chain(SBF_GAIT_KIND_FLY, &gait, 0);
  gait->undulation = NULL;
  float_at(a, gait, 1, 1);
  gait_stage s;
  gait_stage_begin(&s, a);
  s.input.forward = 4, s.input.turn = 1;
  gait_stage_ticks(&s, 600);
  sbf_vec3 left = sbri_rotate(s.state->posture.root.rotation, sbri_vec3(1, 0, 0));
  ck_assert_double_eq_tol(asin(-(double)left.y), atan2(4.0, 9.81), 1e-3);
  s.input.turn = -1;
  gait_stage_ticks(&s, 600);
  left = sbri_rotate(s.state->posture.root.rotation, sbri_vec3(1, 0, 0));
  ck_assert_double_eq_tol(asin((double)left.y), atan2(4.0, 9.81), 1e-3);
  gait_stage_end(&s);
}
END_TEST

START_TEST(heavy_swimmers_sink_to_the_ground)
{
  for (int k = 0; k < 3; k++) {
    float buoyancy = 0.8f + 0.2f * (float)k;
    sbf_gait *gait;
    sbf_asset *a = chain(SBF_GAIT_KIND_SWIM, &gait, 0);
    float_at(a, gait, 30, buoyancy);
    gait_stage s;
    gait_stage_begin(&s, a);
    ck_assert_double_eq_tol((double)s.state->motion.position.y, 30, 1e-4);
    gait_stage_ticks(&s, 300);
    double max = sqrt(0.2 * 9.81 * (double)LENGTH), up = (double)sbri_motion(&s.rig, s.state)->up;
    ck_assert_double_eq_tol(up, k == 0 ? -max : k == 1 ? 0 : max, 0.02 * max);
    if (k == 1) ck_assert_double_eq_tol((double)s.state->motion.position.y, 30, 1e-4);
    gait_stage_ticks(&s, 1500);
    if (k == 0) ck_assert_double_eq_tol((double)s.state->motion.position.y, 0, 1e-4);
    gait_stage_end(&s);
  }
}
END_TEST

START_TEST(a_swimmer_stays_between_ground_and_surface)
{
  sbf_gait *gait;
  sbf_asset *a = chain(SBF_GAIT_KIND_SWIM, &gait, 0.25f);
  a->environment.has_water = true;
  a->environment.water_level = 2;
  float_at(a, gait, 0.5f, 1);
  gait_stage s;
  gait_stage_begin(&s, a);
  s.input.up = 1;
  gait_stage_ticks(&s, 300);
  ck_assert_double_eq_tol((double)(s.state->motion.position.y + s.rig.stand.high.y), 2, 1e-4);
  s.input.up = -1, s.input.forward = 0.5f;
  for (int t = 0; t < 600; t++) {
    gait_stage_ticks(&s, 1);
    for (uint32_t b = 0; b < BONES; b++) ck_assert_float_gt(s.pose[b].position.y, -0.02f);
  }
  gait_stage_end(&s);
}
END_TEST

static double off_path(const sbf_vec3 *path, int count, sbf_vec3 at) {
  double min = 1e9;
  for (int i = 0; i + 1 < count; i++) {
    double ax = path[i].x, az = path[i].z, bx = (double)path[i + 1].x - ax, bz = (double)path[i + 1].z - az;
    double px = (double)at.x - ax, pz = (double)at.z - az, bb = bx * bx + bz * bz;
    double t = bb > 0 ? fmin(1, fmax(0, (px * bx + pz * bz) / bb)) : 0;
    min = fmin(min, hypot(px - t * bx, pz - t * bz));
  }
  return min;
}

START_TEST(a_snake_follows_the_path_of_its_nose)
{
  enum { TICKS = 1200 };
  sbf_gait *gait;
  sbf_asset *a = chain(SBF_GAIT_KIND_SLITHER, &gait, 0.05f);
  ((sbf_undulation *)(uintptr_t)gait->undulation)->wavelength = 0.6f;
  gait_stage s;
  gait_stage_begin(&s, a);
  sbf_vec3 *path = calloc(TICKS, sizeof *path);
  double worst = 0, heading = 0;
  s.input.forward = 1;
  for (int t = 0; t < TICKS; t++) {
    if (t == 600) s.input.turn = 0.4f;
    gait_stage_ticks(&s, 1);
    path[t] = s.pose[0].position;
    if (t > 60 && t < 600)
      heading = fmax(heading,
          fabs(atan2((double)path[t].x - (double)path[t - 1].x, (double)path[t].z - (double)path[t - 1].z)));
    for (uint32_t b = 0; t > 300 && b < BONES; b++) {
      worst = fmax(worst, off_path(path, t + 1, s.pose[b].position));
      ck_assert_double_eq_tol((double)s.pose[b].position.y, 0.05, 1e-5);
      if (b)
        ck_assert_double_eq_tol((double)sbri_length(sbri_sub(s.pose[b].position, s.pose[b - 1].position)),
            (double)LENGTH / BONES, 1e-3 * (double)LENGTH);
    }
  }
  ck_assert_double_lt(worst, 0.002 * (double)LENGTH);
  ck_assert_double_eq_tol(heading, 0.7, 0.01); /* heading_amplitude */
  ck_assert_double_gt(sbri_gait_distance(s.state), 0.95 * TICKS / 60);
  free(path);
  gait_stage_end(&s);
}
END_TEST

/* Stairs of `parameter` along z, three times as deep as high. */
static double stairs(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  (void)x;
  *normal = sbri_vec3(0, 1, 0);
  return ground->parameters[0] * floor(z / (3 * ground->parameters[0]) + 0.5);
}

/* Straight up stairs, and in a circle along, up and down: its joints stay connected, and it keeps its
 * speed. */
START_TEST(a_snake_crosses_edges_without_jumps)
{
  static const double STEP = 0.1;
  for (int turns = 0; turns < 2; turns++) {
    sbf_gait *gait;
    sbf_asset *a = chain(SBF_GAIT_KIND_SLITHER, &gait, 0.05f);
    ((sbf_undulation *)(uintptr_t)gait->undulation)->wavelength = 0.6f;
    gait_stage s;
    gait_stage_begin_on(&s, a, stairs, STEP);
    s.rig.wall_volume.wall_sphere_count = 1,
    s.rig.wall_volume.wall_spheres[0].radius = 0.05f; /* so that it can fall */
    s.rig.wall_volume.step_up = 0.1f;
    double speed[BONES] = {0}, height[BONES] = {0}, jump = 0, stretch = 0, under = 0;
    s.input.forward = 1, s.input.turn = turns ? 0.5f : 0;
    for (int t = 0; t < 900; t++) {
      gait_stage_ticks(&s, 1);
      for (uint32_t b = 0; b < BONES; b++) {
        sbf_vec3 at = s.pose[b].position, normal;
        double now = ((double)at.y - height[b]) * 60;
        if (t > 2) jump = fmax(jump, fabs(now - speed[b]) / 60);
        height[b] = (double)at.y, speed[b] = now;
        under = fmax(under, stairs(&s.ground, (double)at.x, (double)at.z, &normal) + 0.05 - (double)at.y);
        double length = b ? (double)sbri_length(sbri_sub(at, s.pose[b - 1].position)) : 0;
        if (b) stretch = fmax(stretch, fabs(length / ((double)LENGTH / BONES) - 1));
      }
    }
    ck_assert_double_lt(jump, 0.15 * STEP);
    ck_assert_double_lt(stretch, 0.02);
    ck_assert_double_lt(under, 0.2 * STEP);
    gait_stage_end(&s);
  }
}
END_TEST

START_TEST(the_serpenoid_curve_is_the_integral_of_its_heading)
{
  double x = 0, z = 0;
  float mean;
  sbf_vec3 start = sbri_serpenoid(0.8f, 0, &mean);
  for (int i = 0; i < 20000; i++) {
    double u = 2 * PI * (i + 0.5) / 20000, h = 0.8 * sin(u);
    x += sin(h) / 20000, z += cos(h) / 20000;
    if (i % 1000 != 999) continue;
    float phase = (float)(i + 1) / 20000;
    sbf_vec3 at = sbri_serpenoid(0.8f, phase, &mean);
    ck_assert_double_eq_tol((double)(at.x - start.x), x, 2e-6);
    ck_assert_double_eq_tol((double)(at.z + mean * phase - start.z), z, 2e-6);
  }
}
END_TEST

/* A cart: fixed wheels behind, steering ones in front, on each side; a track of four links. */
static sbf_asset *cart(sbf_gait **gait, bool steers, bool tracks) {
  static const uint32_t links[4] = {5, 6, 7, 8};
  sbf_asset *a = chain(SBF_GAIT_KIND_ROLL, gait, 0.5f);
  sbf_bone *bones = (sbf_bone *)(uintptr_t)a->bones.at;
  for (int i = 1; i < BONES; i++) {
    bones[i].parent = 0;
    bones[i].rotation = (sbf_quat){0, 0, 0, 1};
  }
  bones[0].head = sbri_vec3(0, 0.5f, 0);
  for (int w = 0; w < 4; w++) bones[1 + w].head = sbri_vec3(w % 2 ? -0.5f : 0.5f, 0.3f, w < 2 ? -1 : 1);
  for (int l = 0; l < 4; l++)
    bones[5 + l].head = sbri_vec3(0.5f, l == 0 || l == 3 ? 0 : 0.6f, l == 0 || l == 1 ? -0.3f : 0.3f);
  (*gait)->undulation = NULL;
  sbf_wheel *wheels = sbf_asset_allocate(a, 4, sizeof *wheels);
  for (int w = 0; w < 4; w++) {
    sbf_wheel_init(&wheels[w]);
    wheels[w].bone = 1 + w;
    wheels[w].radius = 0.3f;
    wheels[w].steer_limit = steers && w >= 2 ? 0.6f : 0;
  }
  (*gait)->wheels = (sbf_wheel_list){wheels, 4};
  sbf_tread *tread = sbf_asset_allocate(a, 1, sizeof *tread);
  sbf_tread_init(tread);
  tread->bones = (sbf_u32_list){links, 4};
  if (tracks) (*gait)->treads = (sbf_tread_list){tread, 1};
  return a;
}

static double rolled(const gait_stage *s, uint32_t bone) {
  sbf_vec3 up = sbri_world_to_body(s->state, sbri_rotate(s->pose[bone].rotation, sbri_vec3(0, 1, 0)));
  return atan2((double)up.z, (double)up.y);
}

static double separation(double a, double b) {
  return fabs(remainder(a - b, 2 * PI));
}

START_TEST(wheels_rotate_by_the_distance_over_their_radius)
{
  sbf_gait *gait;
  gait_stage s;
  gait_stage_begin(&s, cart(&gait, false, true));
  s.input.forward = 0.7f;
  gait_stage_ticks(&s, 200);
  for (uint32_t w = 1; w <= 4; w++)
    ck_assert_double_lt(separation(rolled(&s, w), sbri_gait_distance(s.state) / 0.3), 1e-3);
  gait_stage_end(&s);
  /* About the middle: one side by the turn times half the gauge ahead, the other back. */
  gait_stage_begin(&s, cart(&gait, false, true));
  s.input.turn = 1;
  double round = 0, last = 0;
  for (int t = 0; t < 200; t++) {
    gait_stage_ticks(&s, 1);
    round += remainder((double)s.state->motion.heading - last, 2 * PI),
        last = (double)s.state->motion.heading;
  }
  ck_assert_double_lt(separation(rolled(&s, 1), -round * 0.5 / 0.3), 2e-3);
  ck_assert_double_lt(separation(rolled(&s, 2), round * 0.5 / 0.3), 2e-3);
  gait_stage_end(&s);
}
END_TEST

START_TEST(links_end_at_the_next_link)
{
  sbf_gait *gait;
  gait_stage s;
  gait_stage_begin_scaled(&s, cart(&gait, false, true), 1.0f / 60, 2);
  s.input.forward = 1;
  while (sbri_gait_distance(s.state) < 2 * 2.39) gait_stage_ticks(&s, 1); /* nearly all of the loop of 2.4 */
  double left = 2 * 2.4 - sbri_gait_distance(s.state);
  sbf_vec3 root = s.state->motion.position, at = sbri_sub(s.pose[5].position, root);
  /* Link 0 returns to its position along the floor, from the front. */
  ck_assert_double_eq_tol((double)at.x, 1, 1e-4);
  ck_assert_double_eq_tol((double)at.y, 0, 1e-3);
  ck_assert_double_eq_tol((double)at.z, -0.6 + left, 2e-3);
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_car_rotates_about_its_fixed_axle_within_its_steering_angle)
{
  sbf_gait *gait;
  gait_stage s;
  gait_stage_begin(&s, cart(&gait, true, false));
  s.input.turn = 1;
  gait_stage_ticks(&s, 120);
  ck_assert_double_eq_tol((double)s.state->motion.heading, 0, 1e-6); /* not on the spot */
  s.input.forward = 1;
  gait_stage_ticks(&s, 240);
  ck_assert_double_eq_tol((double)s.state->motion.turn, tan(0.6) / 2, 1e-3);
  sbf_vec3 rear = sbri_lerp(s.pose[1].position, s.pose[2].position, 0.5f);
  gait_stage_ticks(&s, 1);
  sbf_vec3 direction =
      sbri_world_to_body(s.state, sbri_sub(sbri_lerp(s.pose[1].position, s.pose[2].position, 0.5f), rear));
  ck_assert_double_eq_tol((double)(direction.x / direction.z), 0, 0.01);
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_hop_is_as_high_as_a_step)
{
  sbf_gait *gait;
  sbf_asset *a = chain(SBF_GAIT_KIND_CRAWL, &gait, 0);
  gait->undulation = NULL;
  gait->step_height = 0.3f;
  gait->step_duration = 0.5f;
  gait_stage s;
  gait_stage_begin(&s, a);
  double max = 0, moved_on_ground = 0, last = 0;
  s.input.forward = 0.8f;
  for (int t = 0; t < 360; t++) {
    double low = (double)s.pose[0].position.y;
    gait_stage_ticks(&s, 1);
    double distance = sbri_gait_distance(s.state);
    max = fmax(max, (double)s.pose[0].position.y);
    if (low == 0 && s.pose[0].position.y == 0) moved_on_ground += distance - last;
    last = distance;
  }
  ck_assert_double_eq_tol(max, 0.3, 0.01);
  ck_assert_double_lt(moved_on_ground, 1e-6);
  ck_assert_double_gt(last, 0.8 * 0.8 * 6);
  s.input.forward = 0;
  gait_stage_ticks(&s, 120);
  ck_assert_double_eq((double)s.pose[0].position.y, 0);
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_crawler_lifts_but_never_sinks)
{
  sbf_gait *gait;
  sbf_asset *a = chain(SBF_GAIT_KIND_CRAWL, &gait, 0);
  ((sbf_undulation *)(uintptr_t)gait->undulation)->amplitude = sbri_vec3(0.05f, 0, 0);
  gait_stage s;
  gait_stage_begin(&s, a);
  double max = 0, min = 1;
  s.input.forward = 1;
  for (int t = 0; t < 360; t++) {
    gait_stage_ticks(&s, 1);
    for (uint32_t b = 0; b < BONES; b++) {
      max = fmax(max, (double)s.pose[b].position.y);
      min = fmin(min, (double)s.pose[b].position.y);
    }
  }
  ck_assert_double_gt(max, 0.15);
  ck_assert_double_gt(min, -0.02); /* bones are chords of the wave */
  gait_stage_end(&s);
}
END_TEST

START_TEST(each_kind_travels_the_driven_distance)
{
  static const sbf_gait_kind kinds[] = {SBF_GAIT_KIND_SWIM, SBF_GAIT_KIND_FLY, SBF_GAIT_KIND_SLITHER,
      SBF_GAIT_KIND_CRAWL, SBF_GAIT_KIND_ROLL, SBF_GAIT_KIND_NONE};
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    sbf_gait *gait;
    gait_stage s;
    gait_stage_begin(&s, chain(kinds[k], &gait, 0.1f));
    s.input.forward = 1, s.input.turn = 0.2f;
    gait_stage_ticks(&s, 360);
    double went = sbri_gait_distance(s.state);
    if (kinds[k] == SBF_GAIT_KIND_NONE)
      ck_assert_double_eq(went, 0);
    else
      ck_assert_msg(went > 0.9 * 6 && went < 1.01 * 6, "kind %d: %g m", (int)kinds[k], went);
    gait_stage_end(&s);
  }
}
END_TEST

START_TEST(its_state_is_all_of_it_and_moves_with_the_origin)
{
  static const sbf_gait_kind kinds[] = {SBF_GAIT_KIND_SWIM, SBF_GAIT_KIND_SLITHER, SBF_GAIT_KIND_CRAWL};
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    sbf_gait *gait;
    gait_stage s;
    gait_stage_begin(&s, chain(kinds[k], &gait, 0.1f));
    s.input.forward = 1, s.input.turn = 0.3f, s.input.up = 0.2f;
    gait_stage_ticks(&s, 100);
    size_t size = sbri_gait_state_size(&s.rig);
    void *kept = malloc(size);
    memcpy(kept, s.state, size);
    gait_stage_ticks(&s, 50);
    sbr_transform end = s.pose[BONES - 1];
    memcpy(s.state, kept, size);
    gait_stage_ticks(&s, 50);
    ck_assert_mem_eq(&end, &s.pose[BONES - 1], sizeof end);
    memcpy(s.state, kept, size);
    s.input.origin = (sbr_double3){2, 0, -4};
    sbri_gait_rebase(&s.rig, s.state, sbri_vec3(2, 0, -4));
    gait_stage_ticks(&s, 50);
    sbf_vec3 moved = sbri_sub(sbri_add(s.pose[BONES - 1].position, sbri_vec3(2, 0, -4)), end.position);
    ck_assert_float_lt(sbri_length(moved), 1e-4f);
    free(kept);
    gait_stage_end(&s);
  }
}
END_TEST

START_TEST(fins_beat_steer_and_trail)
{
  static const uint32_t first[1] = {3}, second[1] = {5}, third[1] = {7};
  sbf_gait *gait;
  sbf_asset *a = chain(SBF_GAIT_KIND_FLY, &gait, 0.5f);
  gait->undulation = NULL;
  sbf_fin *fins = sbf_asset_allocate(a, 3, sizeof *fins);
  for (int f = 0; f < 3; f++) sbf_fin_init(&fins[f]);
  fins[0].bones = (sbf_u32_list){first, 1};
  fins[0].amplitude = 0.5f, fins[0].mean = 0.1f, fins[0].frequency = 2, fins[0].axis = sbri_vec3(0, 2, 0);
  fins[1].bones = (sbf_u32_list){second, 1};
  fins[1].motion = SBF_FIN_MOTION_STEER, fins[1].axis = sbri_vec3(0, 1, 0), fins[1].amplitude = 0.4f;
  fins[2].bones = (sbf_u32_list){third, 1};
  fins[2].motion = SBF_FIN_MOTION_TRAIL, fins[2].axis = sbri_vec3(0, 1, 0), fins[2].amplitude = 0.3f;
  gait->fins = (sbf_fin_list){fins, 3};
  gait_stage s;
  gait_stage_begin(&s, a);
  s.input.forward = 1;
  gait_stage_ticks(&s, 300);
  double min = 9, max = -9;
  for (int t = 0; t < 60; t++) {
    gait_stage_ticks(&s, 1);
    double angle = yaw_of(&s, 3);
    min = fmin(min, angle), max = fmax(max, angle);
  }
  ck_assert_double_eq_tol(fmax(fabs(min), fabs(max)), 0.6, 0.02);
  ck_assert_double_eq_tol(max - min, 1, 0.04);
  s.input.turn = 2;
  gait_stage_ticks(&s, 10);
  ck_assert_float_lt(sbri_fin_states(&s.rig, s.state)[2].lag.value, -0.05f); /* left behind */
  gait_stage_ticks(&s, 300);
  ck_assert_double_eq_tol((double)sbri_fin_states(&s.rig, s.state)[1].lag.value, -0.4, 1e-3);
  gait_stage_end(&s);
}
END_TEST

START_TEST(it_stands_in_its_rest_pose)
{
  sbf_gait *gait;
  sbf_asset *a = chain(SBF_GAIT_KIND_NONE, &gait, 0.5f);
  sbf_pose *pose = sbf_asset_allocate(a, 1, sizeof *pose);
  sbf_pose_key *key = sbf_asset_allocate(a, 1, sizeof *key);
  sbf_pose_init(pose);
  sbf_pose_key_init(key);
  key->bone = 4;
  key->rotation = sbri_quat_about(sbri_vec3(1, 0, 0), 0.4f);
  pose->keys = (sbf_pose_key_list){key, 1};
  a->poses = (sbf_pose_list){pose, 1};
  gait->rest_pose = 0;
  gait->undulation = NULL;
  gait_stage s;
  gait_stage_begin(&s, a);
  gait_stage_ticks(&s, 1);
  sbf_quat turned = sbri_quat_multiply(sbri_quat_conjugate(s.pose[3].rotation), s.pose[4].rotation);
  ck_assert_double_eq_tol(2 * asin((double)turned.x), 0.4, 1e-5);
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_world_restores_it_and_ignores_invalid_numbers)
{
  sbf_gait *gait;
  sbf_asset *a = chain(SBF_GAIT_KIND_SWIM, &gait, 0);
  float_at(a, gait, 1, 0.9f);
  sbf_diagnostic error;
  sbr_model *model;
  sbr_world *world;
  sbr_character_id one;
  sbr_world_definition world_as = sbr_default_world_definition();
  sbr_character_definition as = sbr_default_character_definition();
  ck_assert_int_eq(sbr_model_create(a, NULL, &model, &error), SBF_OK);
  ck_assert_int_eq(sbr_world_create(&world_as, &world, &error), SBF_OK);
  ck_assert_int_eq(sbr_character_create(world, model, &as, &one, &error), SBF_OK);
  sbr_character_set_drive(world, one, 1, 0, 0.5f);
  sbr_character_set_vertical_speed(world, one, 0.3f);
  sbr_character_set_vertical_speed(world, one, NAN);
  sbr_character_set_vertical_speed(world, one, INFINITY);
  for (int t = 0; t < 60; t++) sbr_world_tick(world);
  size_t size = sbr_world_get_snapshot_size(world);
  void *bytes = malloc(size);
  ck_assert_int_eq(sbr_world_save_snapshot(world, bytes, size), SBF_OK);
  for (int t = 0; t < 60; t++) sbr_world_tick(world);
  uint64_t hash = sbr_world_get_state_hash(world);
  sbr_transform bones[BONES];
  sbr_character_get_bones(world, one, bones, BONES);
  sbr_double3 origin = sbr_character_get_origin(world, one);
  ck_assert_double_eq_tol(origin.y + (double)bones[BONES / 2].position.y, 1 + 0.3 * (2 - 0.3), 0.1);
  ck_assert_int_eq(sbr_world_restore_snapshot(world, bytes, size), SBF_OK);
  for (int t = 0; t < 60; t++) sbr_world_tick(world);
  ck_assert_uint_eq(sbr_world_get_state_hash(world), hash);
  sbr_character_reset(world, one);
  for (int t = 0; t < 60; t++) sbr_world_tick(world);
  sbr_character_get_bones(world, one, bones, BONES);
  for (int b = 0; b < BONES; b++) ck_assert(isfinite(bones[b].position.y));
  free(bytes);
  sbr_world_destroy(world);
  sbr_model_destroy(model);
  sbf_asset_free(a);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("motion_kinds");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_wave_travels_at_its_frequency_times_its_length);
  tcase_add_test(tests, a_wave_keeps_its_frequency_within_bounds);
  tcase_add_test(tests, it_banks_by_speed_times_angular_velocity_over_gravity);
  tcase_add_test(tests, heavy_swimmers_sink_to_the_ground);
  tcase_add_test(tests, a_swimmer_stays_between_ground_and_surface);
  tcase_add_test(tests, a_snake_follows_the_path_of_its_nose);
  tcase_add_test(tests, a_snake_crosses_edges_without_jumps);
  tcase_add_test(tests, the_serpenoid_curve_is_the_integral_of_its_heading);
  tcase_add_test(tests, wheels_rotate_by_the_distance_over_their_radius);
  tcase_add_test(tests, links_end_at_the_next_link);
  tcase_add_test(tests, a_car_rotates_about_its_fixed_axle_within_its_steering_angle);
  tcase_add_test(tests, a_hop_is_as_high_as_a_step);
  tcase_add_test(tests, a_crawler_lifts_but_never_sinks);
  tcase_add_test(tests, each_kind_travels_the_driven_distance);
  tcase_add_test(tests, its_state_is_all_of_it_and_moves_with_the_origin);
  tcase_add_test(tests, fins_beat_steer_and_trail);
  tcase_add_test(tests, it_stands_in_its_rest_pose);
  tcase_add_test(tests, a_world_restores_it_and_ignores_invalid_numbers);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
