#include "harness.h"
#include "render/camera.h"

static const float aspect = 1.5f;

/* Where a point lands: -1..1 across the picture both ways. */
static sbf_vec2 shown(const draw_camera *camera, sbf_vec3 p) {
  matrix4 view = draw_camera_view(camera), projection = draw_camera_projection(camera, aspect, 100);
  matrix4 all = matrix4_product(&projection, &view);
  const float *m = all.at;
  float w = m[3] * p.x + m[7] * p.y + m[11] * p.z + m[15];
  ck_assert_float_gt(w, 0);
  return (sbf_vec2){
      (m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12]) / w, (m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13]) / w};
}

static sbf_vec3 corner(const box3 *box, int i) {
  return v3(
      i & 1 ? box->max.x : box->min.x, i & 2 ? box->max.y : box->min.y, i & 4 ? box->max.z : box->min.z);
}

START_TEST(box_fills_the_picture)
{
  static const box3 boxes[] = {{{-0.9f, 0, -2.7f}, {0.9f, 1.1f, 2.3f}}, {{10, 0, 0}, {10.1f, 30, 0.1f}},
      {{-5, -5, -5}, {-4.99f, -4.99f, -4.99f}}};
  float widest = 0, highest = 0;
  draw_camera camera;
  draw_camera_frame(
      &camera, &boxes[_i], aspect, DRAW_CAMERA_THREE_QUARTER_YAW, DRAW_CAMERA_THREE_QUARTER_PITCH);
  for (int i = 0; i < 8; i++) {
    sbf_vec2 at = shown(&camera, corner(&boxes[_i], i));
    widest = fmaxf(widest, fabsf(at.x)), highest = fmaxf(highest, fabsf(at.y));
  }
  ck_assert_float_lt(fmaxf(widest, highest), 0.95f); /* a margin is kept */
  ck_assert_float_gt(fmaxf(widest, highest), 0.80f); /* and no more than one */
}
END_TEST

START_TEST(non_finite_points_are_left_out)
{
  const sbf_vec3 points[] = {{0, 0, 0}, {NAN, 0, 0}, {0, INFINITY, 0}, {1, 1, 1}};
  draw_camera camera, plain;
  const sbf_vec3 good[] = {{0, 0, 0}, {1, 1, 1}};
  draw_camera_frame_points(&camera, points, 4, aspect, 0.3f, 0.2f);
  draw_camera_frame_points(&plain, good, 2, aspect, 0.3f, 0.2f);
  ck_assert_float_eq(camera.distance, plain.distance);
  draw_camera_frame_points(&camera, points + 1, 2, aspect, 0.3f, 0.2f);
  ck_assert_float_gt(camera.distance, 1);
  ck_assert(isfinite(camera.distance));
}
END_TEST

START_TEST(front_is_towards_positive_z)
{
  const box3 box = {{-1, -1, -1}, {1, 1, 1}};
  draw_camera camera;
  draw_camera_frame(&camera, &box, aspect, 0, 0);
  sbf_vec3 eye = draw_camera_eye(&camera);
  ck_assert_float_gt(eye.z, 2);
  ck_assert_float_eq_tol(eye.x, 0, 1e-4f);
  ck_assert_float_gt(shown(&camera, v3(1, 0, 0)).x, 0);
  ck_assert_float_gt(shown(&camera, v3(0, 1, 0)).y, 0);
}
END_TEST

static draw_camera framed_at(float x, float y, float z) {
  const box3 box = {{x - 1, y - 1, z - 1}, {x + 1, y + 1, z + 1}};
  draw_camera camera;
  draw_camera_frame(&camera, &box, aspect, 0, 0);
  return camera;
}

/* Starts, walks, stops: behind while it gains speed, with it while it walks, at rest with it in the end. */
START_TEST(follows_a_walk)
{
  const float step = 0.04f, speed = 0.5f;
  draw_camera camera = framed_at(0, 0, 0);
  float at = 0, before = camera.subject.x;
  for (int i = 0; i < 250; i++) {
    at += speed * step;
    draw_camera best = framed_at(at, 0, 0);
    draw_camera_follow(&camera, &best, step);
    ck_assert_float_ge(camera.subject.x, before);
    ck_assert_float_le(camera.subject.x, at + 1e-4f);
    before = camera.subject.x;
  }
  ck_assert_float_eq_tol(camera.subject.x, at, 1e-3f);
  ck_assert_float_eq_tol(camera.velocity.x, speed, 1e-3f);
  draw_camera best = framed_at(at, 0, 0);
  for (int i = 0; i < 250; i++) {
    draw_camera_follow(&camera, &best, step);
    ck_assert_float_le(camera.subject.x, at + speed * DRAW_CAMERA_FOLLOW_SECONDS);
  }
  ck_assert_float_eq_tol(camera.subject.x, at, 1e-3f);
}
END_TEST

START_TEST(bobbing_is_smoothed)
{
  draw_camera camera = framed_at(0, 0, 0);
  float max = 0;
  for (int i = 0; i < 250; i++) {
    draw_camera best = framed_at(0, 0.1f * sinf(15 * 0.04f * (float)i), 0);
    draw_camera_follow(&camera, &best, 0.04f);
    if (i > 100) max = fmaxf(max, fabsf(camera.subject.y));
  }
  ck_assert_float_lt(max, 0.03f);
}
END_TEST

START_TEST(steps_back_as_the_subject_grows)
{
  const box3 big = {{-3, -3, -3}, {3, 3, 3}};
  draw_camera camera = framed_at(0, 0, 0), best;
  draw_camera_frame(&best, &big, aspect, 0, 0);
  float before = camera.distance;
  for (int i = 0; i < 150; i++) {
    draw_camera_follow(&camera, &best, 0.04f);
    ck_assert(camera.distance >= before - 0.02f * before && camera.distance <= 1.2f * best.distance);
    before = camera.distance;
  }
  ck_assert_float_eq_tol(camera.distance, best.distance, 0.01f);
}
END_TEST

START_TEST(frame_rate_does_not_matter)
{
  draw_camera slow = framed_at(0, 0, 0), fast = slow;
  for (int i = 1; i <= 10; i++) {
    draw_camera best = framed_at(0, 0.1f * (float)i, -0.3f);
    draw_camera_follow(&slow, &best, 0.04f);
  }
  for (int i = 1; i <= 40; i++) {
    draw_camera best = framed_at(0, 0.025f * (float)i, -0.3f * fminf((float)i / 4, 1));
    draw_camera_follow(&fast, &best, 0.01f);
  }
  ck_assert_float_eq_tol(slow.subject.y, fast.subject.y, 1e-4f);
  ck_assert_float_eq_tol(slow.subject.z, fast.subject.z, 1e-4f);
}
END_TEST

START_TEST(orbit_keeps_the_subject_and_the_distance)
{
  const box3 box = {{-1, -0.5f, -1}, {1, 0.5f, 1}};
  draw_camera camera;
  draw_camera_frame(&camera, &box, aspect, 0.4f, 0.3f);
  sbf_vec2 before = shown(&camera, camera.subject);
  float home = camera.home_yaw;
  draw_camera_orbit(&camera, 1.3f);
  sbf_vec2 after = shown(&camera, camera.subject);
  ck_assert_float_eq_tol(before.x, after.x, 1e-4f);
  ck_assert_float_eq_tol(before.y, after.y, 1e-4f);
  ck_assert_float_eq(camera.home_yaw, home);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("camera");
  TCase *tests = tcase_create("camera");
  tcase_add_loop_test(tests, box_fills_the_picture, 0, 3);
  tcase_add_test(tests, non_finite_points_are_left_out);
  tcase_add_test(tests, front_is_towards_positive_z);
  tcase_add_test(tests, follows_a_walk);
  tcase_add_test(tests, bobbing_is_smoothed);
  tcase_add_test(tests, steps_back_as_the_subject_grows);
  tcase_add_test(tests, frame_rate_does_not_matter);
  tcase_add_test(tests, orbit_keeps_the_subject_and_the_distance);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
