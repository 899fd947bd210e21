#include "harness.h"
#include "math/quat.h"
#include "math/trig.h"

static sbf_quat turn(sbf_vec3 axis, float angle) {
  float s, c;
  sbri_sincos(angle / 2, &s, &c);
  return (sbf_quat){axis.x * s, axis.y * s, axis.z * s, c};
}

static void expect(sbf_vec3 a, sbf_vec3 b) {
  ck_assert_float_le(sbri_length(sbri_sub(a, b)), 2e-6f);
}

START_TEST(rotations_follow_the_right_hand_rule)
{
  sbf_quat quarter = turn(sbri_vec3(0, 1, 0), 1.5707963f), tip = turn(sbri_vec3(1, 0, 0), 1.5707963f);
  expect(sbri_rotate(quarter, sbri_vec3(0, 0, 1)), sbri_vec3(1, 0, 0));
  expect(sbri_rotate(sbri_quat_multiply(tip, quarter), sbri_vec3(0, 1, 0)), sbri_vec3(0, 0, 1));
}
END_TEST

START_TEST(the_identity_changes_no_bit)
{
  sbf_vec3 v = {0.1f, -123.4567f, 1e-9f}, r = sbri_rotate(sbri_quat_identity(), v);
  ck_assert_mem_eq(&v, &r, sizeof v);
}
END_TEST

START_TEST(between_rotates_one_vector_to_the_other)
{
  const sbf_vec3 from[] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  const sbf_vec3 to[] = {{0, -1, 0}, {0.6f, 0, 0.8f}, {-1, 0, 0}, {0, 1, 0}};
  for (int i = 0; i < 4; i++) expect(sbri_rotate(sbri_quat_between(from[i], to[i]), from[i]), to[i]);
}
END_TEST

START_TEST(blending_follows_the_shorter_path)
{
  sbf_quat a = turn(sbri_vec3(0, 0, 1), 0.4f), b = turn(sbri_vec3(0, 0, 1), 0.6f);
  sbf_quat other = {-b.x, -b.y, -b.z, -b.w}, middle = sbri_quat_blend(a, other, 0.5f);
  float s, c;
  sbri_sincos(0.5f, &s, &c);
  expect(sbri_rotate(middle, sbri_vec3(1, 0, 0)), sbri_vec3(c, s, 0));
}
END_TEST

START_TEST(axes_make_a_rotation)
{
  const sbf_quat given[] = {
      {0, 0, 0, 1}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0.1f, -0.5f, 0.3f, 0.7f}};
  for (int i = 0; i < 5; i++) {
    sbf_quat q = sbri_quat_normalize(given[i]);
    sbf_vec3 x = sbri_rotate(q, sbri_vec3(1, 0, 0)), y = sbri_rotate(q, sbri_vec3(0, 1, 0)),
             z = sbri_rotate(q, sbri_vec3(0, 0, 1));
    sbf_quat r = sbri_quat_from_axes(x, y, z);
    expect(sbri_rotate(r, sbri_vec3(1, 2, 3)), sbri_rotate(q, sbri_vec3(1, 2, 3)));
  }
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("quat");
  TCase *c = tcase_create("quat");
  tcase_add_test(c, rotations_follow_the_right_hand_rule);
  tcase_add_test(c, the_identity_changes_no_bit);
  tcase_add_test(c, between_rotates_one_vector_to_the_other);
  tcase_add_test(c, blending_follows_the_shorter_path);
  tcase_add_test(c, axes_make_a_rotation);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
