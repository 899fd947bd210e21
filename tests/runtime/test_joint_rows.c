/* Each kind of joint against closed forms of mechanics. */
#include <math.h>

#include "harness.h"
#include "rigid_scenes.h"

static const double PI = 3.14159265358979323846;

static const double G = 9.81;

/* An angle's change, taken the shorter way round. */
static float wrapped(float angle) {
  return angle - (float)(2 * PI * round((double)angle / (2 * PI)));
}

static scene begin(void) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  return s;
}

static void push(const scene *s, uint32_t body, sbf_vec3 impulse) {
  sbr_double3 o = sbr_character_get_origin(s->world, s->character);
  sbf_vec3 c = rigid_state(s, body).center;
  sbr_double3 at = {o.x + (double)c.x, o.y + (double)c.y, o.z + (double)c.z};
  sbr_character_apply_rigid_impulse(s->world, s->character, body, at, impulse);
}

/* Mean time from one upward passage of a coordinate through `middle` to the next, s. */
static double period(const scene *s, uint32_t joint, sbf_joint_axis axis, double middle, int ticks) {
  double last = 0, first = 0, end = 0;
  int count = -1;
  for (int i = 0; i < ticks; i++) {
    sbr_world_tick(s->world);
    double x = (double)rigid_joint_state(s, joint).coordinates[axis] - middle;
    if (i > 0 && last < 0 && x >= 0) {
      end = i - x / (x - last);
      if (++count == 0) first = end;
    }
    last = x;
  }
  ck_assert_int_gt(count, 2);
  return (end - first) / (60.0 * count);
}

static const double small_box = 0.02 * 0.02 / 6; /* I / m of a cube of 2 cm */

/* A cone's bound does not act at its axis: a body that hangs along the axis swings freely to both sides. */
START_TEST(a_cone_does_not_act_at_its_axis)
{
  scene s = begin();
  rigid_box(&s, (sbf_vec3){0, -1, 0}, (sbf_vec3){0.02f, 0.02f, 0.02f}, 1);
  sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_y);
  rigid_limit(&s, joint, (sbf_limit){.target = SBF_JOINT_AXIS_SWING, .max = 0.7f});
  scene_start(&s);
  const sbf_vec3 directions[4] = {{0.3f, 0, 0}, {-0.3f, 0, 0}, {0, 0, 0.3f}, {0, 0, -0.3f}};
  push(&s, 0, directions[_i]);
  scene_ticks(&s, 6);
  sbf_vec3 v = rigid_state(&s, 0).velocity;
  float along = (v.x * directions[_i].x + v.z * directions[_i].z) / 0.3f;
  ck_assert_double_eq_tol((double)along, 0.3 * cos(0.1 * sqrt(G)), 0.01); /* after a tenth of a second */
  scene_free(&s);
}
END_TEST

/* 60 degrees either way: T = T0 / agm(1, cos(amplitude / 2)). */
START_TEST(a_hinge_swings_as_a_pendulum)
{
  scene s = begin();
  rigid_box(&s, (sbf_vec3){0, -1, 0}, (sbf_vec3){0.02f, 0.02f, 0.02f}, 1);
  rigid_joint(&s, SBF_JOINT_KIND_REVOLUTE, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_z);
  scene_start(&s);
  push(&s, 0, (sbf_vec3){(float)sqrt(G), 0, 0}); /* m v, v^2 = 2 g (1 - cos 60) */
  double t = period(&s, 0, SBF_JOINT_AXIS_TWIST, 0, 1200);
  double expected = 1.0731820 * 2 * PI * sqrt((1 + small_box) / G);
  ck_assert_double_eq_tol(t / expected, 1, 5e-4);
  double max = 0;
  for (int i = 0; i < 600; i++) {
    sbr_world_tick(s.world);
    sbr_joint_state now = rigid_joint_state(&s, 0);
    max = fmax(max, fabs((double)now.coordinates[SBF_JOINT_AXIS_TWIST]));
    ck_assert_float_le(now.separation, 1e-5f);
    ck_assert_float_le(now.angular_error, 1e-5f);
  }
  ck_assert_double_eq_tol(max, PI / 3, 0.01); /* after half a minute, neither gained nor lost */
  scene_free(&s);
}
END_TEST

/* A spherical joint on a circle: w^2 = g / (L cos(angle)). */
START_TEST(a_ball_joint_swings_round)
{
  scene s = begin();
  const double angle = 0.6, x = sin(0.6), y = -cos(0.6), w = sqrt(G / cos(angle));
  rigid_box(&s, (sbf_vec3){(float)x, (float)y, 0}, (sbf_vec3){0.02f, 0.02f, 0.02f}, 2);
  rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_x);
  scene_start(&s);
  push(&s, 0, (sbf_vec3){0, 0, (float)(2 * w * x)});
  for (int i = 0; i < 300; i++) {
    sbr_world_tick(s.world);
    ck_assert_double_eq_tol((double)rigid_state(&s, 0).center.y, y, 0.02);
  }
  scene_free(&s);
}
END_TEST

/* Along a line at 30 degrees: g sin 30. */
START_TEST(a_slider_slides)
{
  scene s = begin();
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 2);
  const float half = (float)(-PI / 12);
  rigid_joint(
      &s, SBF_JOINT_KIND_PRISMATIC, -1, 0, (sbf_vec3){0, 0, 0}, (sbf_quat){0, 0, sinf(half), cosf(half)});
  scene_start(&s);
  scene_ticks(&s, 60);
  sbr_joint_state now = rigid_joint_state(&s, 0);
  ck_assert_float_eq_tol(now.coordinates[SBF_JOINT_AXIS_LINEAR_X], 9.81f / 4, 0.03f);
  ck_assert_float_le(now.separation, 1e-5f);
  ck_assert_float_le(now.angular_error, 1e-5f);
  scene_free(&s);
}
END_TEST

/* A screw without a thread: falls along its axis and turns about it, each as if alone. */
START_TEST(a_cylinder_joint_falls_and_rotates)
{
  scene s = begin();
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.2f, 0.2f, 0.2f}, 1);
  sbf_joint *joint =
      rigid_joint(&s, SBF_JOINT_KIND_CYLINDRICAL, -1, 0, (sbf_vec3){0.05f, 0, 0}, rigid_along_y);
  rigid_drive(&s, joint, (sbf_drive){.target = SBF_JOINT_AXIS_TWIST, .velocity = 1, .damping = 1000});
  scene_start(&s);
  scene_ticks(&s, 60);
  sbr_joint_state now = rigid_joint_state(&s, 0);
  ck_assert_float_eq_tol(now.coordinates[SBF_JOINT_AXIS_LINEAR_X], -9.81f / 2, 0.03f);
  ck_assert_float_eq_tol(now.coordinates[SBF_JOINT_AXIS_TWIST], 1, 0.01f);
  ck_assert_float_le(now.separation, 2e-5f);
  ck_assert_float_le(now.angular_error, 2e-5f);
  scene_free(&s);
}
END_TEST

/* A bead on a level wire does not fall; a puck on a level plane slides over it unhindered. */
START_TEST(points_on_lines_and_in_planes)
{
  for (int plane = 0; plane < 2; plane++) {
    scene s = begin();
    rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 1);
    rigid_joint(&s, plane ? SBF_JOINT_KIND_POINT_IN_PLANE : SBF_JOINT_KIND_POINT_ON_LINE, -1, 0,
        (sbf_vec3){0, 0, 0}, plane ? rigid_along_y : rigid_along_x);
    scene_start(&s);
    push(&s, 0, (sbf_vec3){1, 0, 0.5f});
    scene_ticks(&s, 60);
    sbr_rigid_state now = rigid_state(&s, 0);
    ck_assert_float_eq_tol(now.center.x, 1, 1e-3f);
    ck_assert_float_eq_tol(now.center.y, 0, 1e-5f);
    ck_assert_float_eq_tol(now.center.z, plane ? 0.5f : 0, 1e-3f);
    scene_free(&s);
  }
}
END_TEST

START_TEST(a_fixed_body_stays)
{
  scene s = begin();
  rigid_box(&s, (sbf_vec3){1, 0, 0}, (sbf_vec3){2, 0.1f, 0.1f}, 1);
  rigid_joint(&s, SBF_JOINT_KIND_FIXED, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_x);
  scene_start(&s);
  scene_ticks(&s, 120);
  sbr_joint_state now = rigid_joint_state(&s, 0);
  ck_assert_float_le(now.separation, 1e-5f);
  ck_assert_float_le(now.angular_error, 1e-5f);
  ck_assert_float_eq_tol(now.force.y, 9.81f, 0.01f);
  ck_assert_float_eq_tol(now.torque.z, 9.81f, 0.01f); /* a metre of arm */
  scene_free(&s);
}
END_TEST

/* A rod with its given length, and a rope that is taut only at its maximum length. */
START_TEST(a_distance_is_kept_or_limited)
{
  scene s = begin();
  rigid_box(&s, (sbf_vec3){1, 0, 0}, (sbf_vec3){0.02f, 0.02f, 0.02f}, 1);
  rigid_box(&s, (sbf_vec3){0, 0, 5}, (sbf_vec3){0.02f, 0.02f, 0.02f}, 1);
  sbf_joint *rod = rigid_joint(&s, SBF_JOINT_KIND_DISTANCE, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_x);
  rod->frame_b.position = (sbf_vec3){0, 0, 0};
  sbf_joint *rope = rigid_joint(&s, SBF_JOINT_KIND_DISTANCE, -1, 1, (sbf_vec3){0, 0, 5}, rigid_along_x);
  rigid_limit(&s, rope, (sbf_limit){.target = SBF_JOINT_AXIS_DISTANCE, .min = 0, .max = 0.5f});
  scene_start(&s);
  float lowest = 0;
  for (int i = 0; i < 240; i++) {
    sbr_world_tick(s.world);
    ck_assert_float_eq_tol(rigid_joint_state(&s, 0).coordinates[SBF_JOINT_AXIS_DISTANCE], 1, 2e-5f);
    ck_assert_float_le(rigid_joint_state(&s, 1).coordinates[SBF_JOINT_AXIS_DISTANCE], 0.5f + 2e-5f);
    float y = rigid_state(&s, 0).center.y;
    lowest = y < lowest ? y : lowest;
  }
  ck_assert_float_eq_tol(lowest, -1, 1e-3f);
  ck_assert_float_eq_tol(rigid_state(&s, 1).center.y, -0.5f, 1e-4f);
  scene_free(&s);
}
END_TEST

/* Atwood's machine: a = g (m_a - m_b) / (m_a + m_b); with a ratio r, rope on side b counts r times. */
START_TEST(a_pulley_is_atwoods_machine)
{
  const double ratios[2] = {1, 2};
  for (int i = 0; i < 2; i++) {
    const double a = 3, b = 2, r = ratios[i];
    scene s = begin();
    rigid_box(&s, (sbf_vec3){-1, -5, 0}, (sbf_vec3){0.1f, 0.1f, 0.1f}, (float)a);
    rigid_box(&s, (sbf_vec3){1, -5, 0}, (sbf_vec3){0.1f, 0.1f, 0.1f}, (float)b);
    sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_PULLEY, 0, 1, (sbf_vec3){0, 0, 0}, rigid_along_x);
    joint->frame_a.position = joint->frame_b.position = (sbf_vec3){0, 0, 0};
    joint->pulley_a = (sbf_vec3){-1, 0, 0}, joint->pulley_b = (sbf_vec3){1, 0, 0};
    joint->pulley_ratio = (float)r;
    scene_start(&s);
    scene_ticks(&s, 30);
    /* Tension T on a, r T on b; v_a = -r v_b: m_a dv_a = T - m_a g, m_b dv_b = r T - m_b g. */
    double down = G * r * (r * a - b) / (r * r * a + b);
    ck_assert_double_eq_tol((double)rigid_state(&s, 0).velocity.y, -0.5 * down, 0.03);
    ck_assert_double_eq_tol((double)rigid_state(&s, 1).velocity.y, 0.5 * down / r, 0.03);
    ck_assert_float_le(rigid_joint_state(&s, 0).separation, 2e-5f);
    scene_free(&s);
  }
}
END_TEST

/* All six axes free: it falls. With a limit of zero width it is a hinge. */
START_TEST(six_freedoms)
{
  scene s = begin();
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 1);
  sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_SIX_DOF, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_x);
  rigid_limit(&s, joint, (sbf_limit){.target = SBF_JOINT_AXIS_LINEAR_X});
  rigid_limit(&s, joint, (sbf_limit){.target = SBF_JOINT_AXIS_LINEAR_Y, .min = -0.3f, .max = 1});
  scene_start(&s);
  push(&s, 0, (sbf_vec3){1, 0, 1});
  scene_ticks(&s, 60);
  sbr_rigid_state now = rigid_state(&s, 0);
  ck_assert_float_eq_tol(now.center.x, 0, 1e-5f);
  ck_assert_float_eq_tol(now.center.y, -0.3f, 1e-4f);
  ck_assert_float_eq_tol(now.center.z, 1, 1e-3f);
  scene_free(&s);
}
END_TEST

/* ---- Limits and drives ---- */

/* A level arm falls onto its limit and rests there. Even a fast impact never exceeds it by a degree. */
START_TEST(limits_are_respected)
{
  scene s = begin();
  rigid_box(&s, (sbf_vec3){0.5f, 0, 0}, (sbf_vec3){1, 0.1f, 0.1f}, 2);
  sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_REVOLUTE, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_z);
  rigid_limit(&s, joint, (sbf_limit){.target = SBF_JOINT_AXIS_TWIST, .min = -0.5f, .max = 0.5f});
  scene_start(&s);
  float worst = 0;
  for (int i = 0; i < 240; i++) {
    if (i == 60) push(&s, 0, (sbf_vec3){0, 40, 0}); /* some 20 m/s */
    sbr_world_tick(s.world);
    float beyond = rigid_joint_state(&s, 0).angle_violation;
    worst = beyond > worst ? beyond : worst;
  }
  ck_assert_float_le(worst, 0.0175f);
  ck_assert_float_le(rigid_joint_state(&s, 0).angle_violation, 0.00175f);
  ck_assert_float_eq_tol(rigid_joint_state(&s, 0).coordinates[SBF_JOINT_AXIS_TWIST], -0.5f, 1e-3f);
  scene_free(&s);
}
END_TEST

/* A hinge may turn by more than half a turn: it passes pi, where its angle is read from the other side, and
 * stops at its bound of 4 rad, to either side. */
START_TEST(a_hinge_rotates_beyond_half_a_rotation)
{
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  rigid_box(&s, (sbf_vec3){0.5f, 0, 0}, (sbf_vec3){1, 0.1f, 0.1f}, 2);
  sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_REVOLUTE, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_z);
  rigid_limit(
      &s, joint, (sbf_limit){.target = SBF_JOINT_AXIS_TWIST, .min = _i ? -4 : -0.5f, .max = _i ? 0.5f : 4});
  scene_start(&s);
  float sign = _i ? -1 : 1, turned = 0, last = 0, farthest = 0;
  push(&s, 0, (sbf_vec3){0, sign * 6, 0}); /* some 4 rad/s */
  for (int i = 0; i < 150; i++) {
    sbr_world_tick(s.world);
    float now = rigid_joint_state(&s, 0).coordinates[SBF_JOINT_AXIS_TWIST];
    turned += wrapped(now - last);
    last = now;
    farthest = sign * turned > farthest ? sign * turned : farthest;
  }
  ck_assert_float_eq_tol(farthest, 4, 0.02f);
  ck_assert_float_le(rigid_joint_state(&s, 0).angle_violation, 0.002f);
  scene_free(&s);
}
END_TEST

/* A weight on a soft limit: it rests m g / k beyond the bound, and the spring never pulls. */
START_TEST(a_limit_spring_yields)
{
  scene s = begin();
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 2);
  sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_PRISMATIC, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_y);
  rigid_limit(&s, joint,
      (sbf_limit){
          .target = SBF_JOINT_AXIS_LINEAR_X, .min = -0.1f, .max = 1, .stiffness = 400, .damping = 30});
  scene_start(&s);
  scene_ticks(&s, 6); /* 5 cm, above the bound yet: falling free */
  ck_assert_float_eq_tol(rigid_state(&s, 0).velocity.y, -0.981f, 0.03f);
  scene_ticks(&s, 300);
  ck_assert_float_eq_tol(rigid_state(&s, 0).center.y, -0.1f - 2 * 9.81f / 400, 1e-4f);
  scene_free(&s);
}
END_TEST

/* Restitution of a hard limit: from a fall of 0.5 m back up to 0.36 of it. */
START_TEST(a_hard_limit_throws_back)
{
  scene s = begin();
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 2);
  sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_PRISMATIC, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_y);
  rigid_limit(
      &s, joint, (sbf_limit){.target = SBF_JOINT_AXIS_LINEAR_X, .min = -0.5f, .max = 1, .restitution = 0.6f});
  scene_start(&s);
  scene_ticks(&s, 21);
  float top = -1;
  for (int i = 0; i < 30; i++) {
    sbr_world_tick(s.world);
    float y = rigid_state(&s, 0).center.y;
    top = y > top ? y : top;
  }
  ck_assert_float_eq_tol(top, -0.5f + 0.5f * 0.36f, 0.01f);
  scene_free(&s);
}
END_TEST

/* The step response of a damped drive: 1 - e^{-z w t} (cos wd t + z / sqrt(1 - z^2) sin wd t). */
START_TEST(a_drive_answers_a_step)
{
  scene s = begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  s.model_options.rigid_substeps = 16;
  const double inertia = 0.02 / 12, w = 2 * PI, z = 0.5, wd = w * sqrt(1 - z * z);
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 1);
  sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_REVOLUTE, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_y);
  rigid_drive(&s, joint,
      (sbf_drive){.target = SBF_JOINT_AXIS_TWIST,
          .position = 0.4f,
          .stiffness = (float)(inertia * w * w),
          .damping = (float)(2 * z * w * inertia)});
  scene_start(&s);
  for (int i = 1; i <= 120; i++) {
    sbr_world_tick(s.world);
    double t = i / 60.0, x = 0.4 * (1 - exp(-z * w * t) * (cos(wd * t) + z / sqrt(1 - z * z) * sin(wd * t)));
    ck_assert_double_eq_tol((double)rigid_joint_state(&s, 0).coordinates[SBF_JOINT_AXIS_TWIST], x, 0.004);
  }
  scene_free(&s);
}
END_TEST

/* A drive's force is at most its maximum: it carries a load up to that, and a greater load falls. */
START_TEST(a_drive_has_a_maximum)
{
  for (int strong = 0; strong < 2; strong++) {
    scene s = begin();
    rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){0.1f, 0.1f, 0.1f}, 1);
    sbf_joint *joint = rigid_joint(&s, SBF_JOINT_KIND_PRISMATIC, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_y);
    rigid_drive(&s, joint,
        (sbf_drive){.target = SBF_JOINT_AXIS_LINEAR_X,
            .stiffness = 1e6f,
            .damping = 1e3f,
            .maximum = strong ? 10 : 5});
    scene_start(&s);
    scene_ticks(&s, 60);
    /* 9.81 N of weight: held, or falling at g - 5. */
    ck_assert_float_eq_tol(rigid_state(&s, 0).velocity.y, strong ? 0 : -4.81f, 0.03f);
    scene_free(&s);
  }
}
END_TEST

/* A joint with a strength of 15 N carries one kilogram and breaks under two. */
START_TEST(joints_break)
{
  for (int heavy = 0; heavy < 2; heavy++) {
    scene s = begin();
    rigid_box(&s, (sbf_vec3){0, -1, 0}, (sbf_vec3){0.1f, 0.1f, 0.1f}, heavy ? 2 : 1);
    rigid_joint(&s, SBF_JOINT_KIND_SPHERICAL, -1, 0, (sbf_vec3){0, 0, 0}, rigid_along_x)->break_force = 15;
    scene_start(&s);
    scene_ticks(&s, 60);
    ck_assert_int_eq(rigid_joint_state(&s, 0).broken, heavy);
    ck_assert_int_eq(rigid_state(&s, 0).center.y < -1.5f, heavy);
    sbr_character_reset(s.world, s.character);
    ck_assert(!rigid_joint_state(&s, 0).broken);
    scene_free(&s);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("joint_rows");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, a_cone_does_not_act_at_its_axis, 0, 4);
  tcase_add_test(tests, a_hinge_swings_as_a_pendulum);
  tcase_add_test(tests, a_ball_joint_swings_round);
  tcase_add_test(tests, a_slider_slides);
  tcase_add_test(tests, a_cylinder_joint_falls_and_rotates);
  tcase_add_test(tests, points_on_lines_and_in_planes);
  tcase_add_test(tests, a_fixed_body_stays);
  tcase_add_test(tests, a_distance_is_kept_or_limited);
  tcase_add_test(tests, a_pulley_is_atwoods_machine);
  tcase_add_test(tests, six_freedoms);
  tcase_add_test(tests, limits_are_respected);
  tcase_add_loop_test(tests, a_hinge_rotates_beyond_half_a_rotation, 0, 2);
  tcase_add_test(tests, a_limit_spring_yields);
  tcase_add_test(tests, a_hard_limit_throws_back);
  tcase_add_test(tests, a_drive_answers_a_step);
  tcase_add_test(tests, a_drive_has_a_maximum);
  tcase_add_test(tests, joints_break);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
