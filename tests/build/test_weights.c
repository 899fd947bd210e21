#include "build/weights/weights.h"

#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "rigged_tubes.h"

static rigged_tubes *tubes;
static sbfi_weights weights;
static sbf_diagnostic error;

static void setup(void) {
  tubes = calloc(1, sizeof *tubes);
  ck_assert_ptr_nonnull(tubes);
  memset(&weights, 0, sizeof weights);
}

static void teardown(void) {
  sbfi_weights_free(&weights);
  free(tubes);
}

static void compute(const sbfi_weights_input *in) {
  sbf_status status = sbfi_compute_weights(in, &weights, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  tubes_check_sums(&weights);
}

static void compute_tubes(void) {
  sbfi_weights_input in = tubes_input(tubes);
  compute(&in);
}

/* An arm along x from 0 to 3 with three bones of length 1. */
static void make_arm(uint32_t rings, bool open) {
  const sbfi_d3 path[] = {{0, 0, 0}, {3, 0, 0}};
  tubes_add(tubes, path, 2, 0.2, rings, open);
  for (int i = 0; i < 3; i++) tubes_add_bone(tubes, "arm", i - 1, (sbfi_d3){i, 0, 0}, (sbfi_d3){i + 1, 0, 0});
}

/* Triangles from `first` on share no point with those before, only places. */
static void give_own_points(uint32_t first) {
  static uint32_t copies[TUBE_POINTS];
  uint32_t points = tubes->point_count;
  memset(copies, 0, sizeof copies);
  for (uint32_t t = first; t < tubes->triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      uint32_t *corner = &tubes->triangles[t][k];
      if (!copies[*corner]) {
        ck_assert_uint_lt(tubes->point_count, TUBE_POINTS);
        copies[*corner] = tubes->point_count;
        tubes->points[tubes->point_count++] = tubes->points[*corner];
      }
      *corner = copies[*corner];
    }
  ck_assert_uint_gt(tubes->point_count, points);
}

static void check_arm(double slack) {
  for (uint32_t i = 0; i < tubes->point_count; i++) {
    double x = (double)tubes->points[i].x;
    for (uint32_t b = 0; b < 3; b++) {
      if (fabs(x - b - 0.5) < 0.25) ck_assert_double_ge(tubes_weight(&weights, i, b), 1 - slack);
      if (fabs(x - b - 0.5) > 0.85) ck_assert_double_le(tubes_weight(&weights, i, b), slack);
    }
    if (fabs(x - 1) < 1e-4) ck_assert_double_eq_tol(tubes_weight(&weights, i, 0), 0.5, 0.15);
  }
}

START_TEST(bones_of_a_chain_divide_a_tube)
{
  make_arm(60, false);
  compute_tubes();
  check_arm(0.1);
  ck_assert_uint_eq(weights.figures.shell_count, 1);
  ck_assert_uint_eq(weights.figures.unused_bone_count, 0);
}
END_TEST

START_TEST(an_open_tube_is_as_good)
{
  make_arm(60, true);
  compute_tubes();
  check_arm(0.1);
}
END_TEST

/* Every triangle has corners of its own at shared positions: the weights are the same. Moved slightly
 * inwards: almost the same. */
START_TEST(triangles_may_be_separate)
{
  make_arm(60, false);
  compute_tubes();
  static uint32_t source[TUBE_POINTS];
  sbfi_weights joined = weights;
  rigged_tubes *whole = tubes;
  for (int shrunk = 0; shrunk < 2; shrunk++) {
    tubes = calloc(1, sizeof *tubes);
    memcpy(tubes->bones, whole->bones, sizeof tubes->bones);
    tubes->bone_count = whole->bone_count;
    tubes->triangle_count = whole->triangle_count;
    for (uint32_t t = 0; t < whole->triangle_count; t++) {
      sbfi_d3 middle = {0, 0, 0};
      for (int k = 0; k < 3; k++)
        middle =
            sbfi_d3_add(middle, sbfi_d3_scale(sbfi_d3_of(whole->points[whole->triangles[t][k]]), 1.0 / 3));
      for (int k = 0; k < 3; k++) {
        sbfi_d3 at = sbfi_d3_of(whole->points[whole->triangles[t][k]]);
        if (shrunk) at = sbfi_d3_add(middle, sbfi_d3_scale(sbfi_d3_sub(at, middle), 0.8));
        source[tubes->point_count] = whole->triangles[t][k];
        tubes->triangles[t][k] = tubes->point_count;
        tubes->points[tubes->point_count++] = sbfi_d3_rounded(at);
      }
    }
    compute_tubes();
    for (uint32_t i = 0; i < tubes->point_count; i++) {
      double x = fabs((double)tubes->points[i].x);
      for (uint32_t b = 0; b < 3; b++) {
        if (!shrunk)
          ck_assert_double_eq_tol(tubes_weight(&weights, i, b), tubes_weight(&joined, source[i], b), 1e-3);
        else if (fabs(x - b - 0.5) < 0.1)
          ck_assert_double_ge(tubes_weight(&weights, i, b), 0.9);
      }
    }
    sbfi_weights_free(&weights);
    free(tubes);
  }
  tubes = whole;
  sbfi_weights_free(&joined);
}
END_TEST

/* A tube bent into a U: bone a in all of one leg, b at the far end of the other. Straight across, a is nearer
 * to the top of the other leg; through the body, b is. */
START_TEST(distance_runs_through_the_body)
{
  const sbfi_d3 path[] = {{0, 0, 0}, {0, 2, 0}, {0.5, 2, 0}, {0.5, 0, 0}};
  tubes_add(tubes, path, 4, 0.1, 40, false);
  uint32_t a = tubes_add_bone(tubes, "a", SBF_NONE, (sbfi_d3){0, 0.05, 0}, (sbfi_d3){0, 0.9, 0});
  uint32_t b = tubes_add_bone(tubes, "b", SBF_NONE, (sbfi_d3){0.5, 0.5, 0}, (sbfi_d3){0.5, 0, 0});
  tubes->bones[a].length = 0.85f;
  tubes->bones[b].length = 0.45f;
  compute_tubes();
  for (uint32_t i = 0; i < tubes->point_count; i++) {
    sbf_vec3 at = tubes->points[i];
    if (at.x > 0.35f && at.y > 0.6f && at.y < 1.1f) ck_assert_double_ge(tubes_weight(&weights, i, b), 0.9);
    if (at.x < 0.15f && at.y < 1.2f) ck_assert_double_ge(tubes_weight(&weights, i, a), 0.9);
  }
}
END_TEST

/* Two legs nearer to each other than a cell. Names distinguish left from right, and no bone of one influences
 * the other. */
START_TEST(legs_close_together)
{
  const sbfi_d3 left[] = {{0.105, 1, 0}, {0.105, 0, 0}}, right[] = {{-0.105, 1, 0}, {-0.105, 0, 0}};
  const sbfi_d3 trunk[] = {{0, 0.95, 0}, {0, 2, 0}};
  uint32_t left_first = tubes_add(tubes, left, 2, 0.1, 40, false);
  uint32_t right_first = tubes_add(tubes, right, 2, 0.1, 40, false);
  uint32_t trunk_first = tubes_add(tubes, trunk, 2, 0.22, 40, false);
  uint32_t hips = tubes_add_bone(tubes, "hips", SBF_NONE, (sbfi_d3){0, 1, 0}, (sbfi_d3){0, 2, 0});
  uint32_t l =
      tubes_add_bone(tubes, "leg.L", (int32_t)hips, (sbfi_d3){0.105, 0.95, 0}, (sbfi_d3){0.105, 0, 0});
  uint32_t r =
      tubes_add_bone(tubes, "leg.R", (int32_t)hips, (sbfi_d3){-0.105, 0.95, 0}, (sbfi_d3){-0.105, 0, 0});
  const int8_t sides[] = {0, 1, -1};
  sbfi_weights_input in = tubes_input(tubes);
  in.sides = sides;
  compute(&in);
  for (uint32_t i = left_first; i < trunk_first; i++) {
    if (tubes->points[i].y > 0.7f) continue;
    ck_assert_double_ge(tubes_weight(&weights, i, i < right_first ? l : r), 0.9);
    ck_assert_double_eq(tubes_weight(&weights, i, i < right_first ? r : l), 0);
  }
  for (uint32_t i = 0; i < tubes->point_count; i++) /* on the trunk too */
    ck_assert(tubes_weight(&weights, i, l) == 0 || tubes_weight(&weights, i, r) == 0);
}
END_TEST

/* A big head over a thin arm: much of the head's underside lies nearer to the arm's bone than to its own. */
START_TEST(thick_parts_reach_farther)
{
  const sbfi_d3 arm[] = {{0.1, 0, 0}, {2, 0, 0}};
  uint32_t head_first = tubes_add_ball(tubes, (sbfi_d3){0, 0.75, 0}, 0.7, 24);
  uint32_t arm_first = tubes_add(tubes, arm, 2, 0.06, 60, false);
  uint32_t head = tubes_add_bone(tubes, "head", SBF_NONE, (sbfi_d3){0, 0.7, 0}, (sbfi_d3){0, 1.4, 0});
  uint32_t hand = tubes_add_bone(tubes, "hand", (int32_t)head, (sbfi_d3){0.15, 0, 0}, (sbfi_d3){2, 0, 0});
  compute_tubes();
  for (uint32_t i = head_first; i < arm_first; i++) /* where it does not touch the arm */
    if (tubes->points[i].y > 0.3f) ck_assert_double_ge(tubes_weight(&weights, i, head), 0.75);
  for (uint32_t i = arm_first; i < tubes->point_count; i++)
    if (tubes->points[i].x > 0.8f) ck_assert_double_ge(tubes_weight(&weights, i, hand), 0.9);
}
END_TEST

/* Two buttons on a sleeve, one over a joint: each moves with one bone. */
START_TEST(small_shells_are_rigid)
{
  make_arm(60, false);
  uint32_t first = tubes_add_ball(tubes, (sbfi_d3){1.01, 0.24, 0}, 0.05, 8);
  uint32_t second = tubes_add_ball(tubes, (sbfi_d3){2.5, 0.24, 0}, 0.05, 8);
  compute_tubes();
  ck_assert_uint_eq(weights.figures.shell_count, 3);
  ck_assert_uint_eq(weights.figures.rigid_shell_count, 2);
  uint32_t chosen = weights.joints[first][0];
  ck_assert(chosen == 0 || chosen == 1);
  for (uint32_t i = first; i < tubes->point_count; i++) {
    ck_assert_float_eq(weights.weights[i][0], 1);
    ck_assert_uint_eq(weights.joints[i][0], i < second ? chosen : 2);
  }
  ck_assert_uint_eq(weights.shell_of_point[second], 2);
}
END_TEST

/* A button whose lowest point is at the position of one of the sleeve's: a shell of its own, and rigid. The
 * sleeve's halves share edges, not points: one shell. */
START_TEST(touching_shells_stay_separate)
{
  make_arm(60, false);
  uint32_t arm = tubes->point_count, above = 0;
  give_own_points(tubes->triangle_count / 2);
  for (uint32_t i = 0; i < arm; i++)
    if (fabs((double)tubes->points[i].x - 1) < 1e-4 && tubes->points[i].y > tubes->points[above].y) above = i;
  sbfi_d3 touched = sbfi_d3_of(tubes->points[above]);
  uint32_t button = tubes_add_ball(tubes, sbfi_d3_add(touched, (sbfi_d3){0, 0.05, 0}), 0.05, 8);
  compute_tubes();
  ck_assert_uint_eq(weights.figures.shell_count, 2);
  ck_assert_uint_eq(weights.figures.rigid_shell_count, 1);
  for (uint32_t i = button; i < tubes->point_count; i++) {
    ck_assert_uint_eq(weights.shell_of_point[i], 1);
    ck_assert_float_eq(weights.weights[i][0], 1);
    ck_assert_uint_eq(weights.joints[i][0], weights.joints[button][0]);
  }
  ck_assert_float_lt(weights.weights[above][0], 0.9f);
}
END_TEST

/* An eye in a head: no bone runs through it, and the nearest bone belongs to a thin ear. */
START_TEST(eyes_follow_the_head_around_them)
{
  tubes_add_ball(tubes, (sbfi_d3){0, 0, 0}, 0.5, 24);
  uint32_t eye = tubes_add_ball(tubes, (sbfi_d3){0, 0.05, 0.49}, 0.04, 8);
  uint32_t behind = tubes->point_count;
  const sbfi_d3 stalk[] = {{0, 0.3, 0.52}, {0, 0.05, 0.6}, {0, -0.2, 0.9}};
  tubes_add(tubes, stalk, 3, 0.01, 10, false);
  uint32_t head = tubes_add_bone(tubes, "head", SBF_NONE, (sbfi_d3){0, -0.4, 0}, (sbfi_d3){0, 0.4, 0});
  tubes_add_bone(tubes, "feeler", (int32_t)head, (sbfi_d3){0, 0.05, 0.6}, (sbfi_d3){0, -0.2, 0.9});
  compute_tubes();
  for (uint32_t i = eye; i < behind; i++) ck_assert_double_eq(tubes_weight(&weights, i, head), 1);
}
END_TEST

/* A ball of radius 1 with a thin arm, turned around x as one shell. Near the shoulder the arm's bone is
 * nearer than the ball's. */
START_TEST(a_thick_limb_keeps_its_shoulder)
{
  const sbfi_d3 path[] = {{-1, 0, 0}, {3, 0, 0}};
  tubes_add(tubes, path, 2, 1, 120, false);
  for (uint32_t i = 0; i < tubes->point_count; i++) {
    double x = (double)tubes->points[i].x, radius = fmax(0.15, sqrt(fmax(0, 1 - x * x)));
    tubes->points[i].y *= (float)radius, tubes->points[i].z *= (float)radius;
  }
  uint32_t ball = tubes_add_bone(tubes, "ball", SBF_NONE, (sbfi_d3){-0.9, 0, 0}, (sbfi_d3){0.5, 0, 0});
  uint32_t arm = tubes_add_bone(tubes, "arm", (int32_t)ball, (sbfi_d3){0.5, 0, 0}, (sbfi_d3){2.9, 0, 0});
  tubes_add_bone(tubes, "other", (int32_t)ball, (sbfi_d3){-0.9, 0, 0}, (sbfi_d3){-1, 0, 0});
  compute_tubes();
  for (uint32_t i = 0; i < tubes->point_count; i++) {
    double x = (double)tubes->points[i].x;
    if (x > 0.55 && x < 0.85) ck_assert_double_ge(tubes_weight(&weights, i, ball), 0.75);
    if (x > 2) ck_assert_double_ge(tubes_weight(&weights, i, arm), 0.9);
  }
}
END_TEST

/* A thick drum that goes on as a thin rod behind the joint: its rim lies behind the joint too, nearer to the
 * rod's bone, but faces away from the rod. */
START_TEST(a_rim_follows_the_bone_behind_it)
{
  const sbfi_d3 path[] = {{0, 0, 0}, {2.2, 0, 0}};
  tubes_add(tubes, path, 2, 0.1, 60, false);
  for (uint32_t i = 0; i < tubes->point_count; i++)
    if (tubes->points[i].x < 1.16f) tubes->points[i].y *= 5, tubes->points[i].z *= 5;
  uint32_t drum = tubes_add_bone(tubes, "drum", SBF_NONE, (sbfi_d3){0.1, 0, 0}, (sbfi_d3){1, 0, 0});
  uint32_t rod = tubes_add_bone(tubes, "rod", (int32_t)drum, (sbfi_d3){1, 0, 0}, (sbfi_d3){2.1, 0, 0});
  compute_tubes();
  for (uint32_t i = 0; i < tubes->point_count; i++) {
    double x = (double)tubes->points[i].x, y = (double)tubes->points[i].y, z = (double)tubes->points[i].z;
    if (x > 1.11 && x < 1.16 && sqrt(y * y + z * z) > 0.4)
      ck_assert_double_ge(tubes_weight(&weights, i, drum), 0.5);
    if (x > 1.8) ck_assert_double_ge(tubes_weight(&weights, i, rod), 0.9);
  }
}
END_TEST

/* A pad of its own before the joint of a limb, which is nearer than the trunk that carries it. */
START_TEST(a_pad_before_a_joint_follows_its_limb)
{
  const sbfi_d3 trunk[] = {{0, 0, 0}, {0, 2, 0}}, arm[] = {{0.6, 1, 0}, {1.6, 1, 0}};
  const sbfi_d3 pad[] = {{0.4, 1, 0}, {0.58, 1, 0}};
  tubes_add(tubes, trunk, 2, 0.12, 40, false);
  tubes_add(tubes, arm, 2, 0.12, 30, false);
  uint32_t first = tubes_add(tubes, pad, 2, 0.2, 6, false);
  uint32_t spine = tubes_add_bone(tubes, "spine", SBF_NONE, (sbfi_d3){0, 0.1, 0}, (sbfi_d3){0, 1.6, 0});
  tubes_add_bone(tubes, "neck", (int32_t)spine, (sbfi_d3){0, 1.6, 0}, (sbfi_d3){0, 1.9, 0});
  tubes_add_bone(tubes, "arm", (int32_t)spine, (sbfi_d3){0.65, 1, 0}, (sbfi_d3){1.5, 1, 0});
  compute_tubes();
  for (uint32_t i = first; i < tubes->point_count; i++)
    ck_assert_double_ge(tubes_weight(&weights, i, spine), 0.95);
}
END_TEST

/* In one skin around both, vertices nearest to the limb's joint follow the limb, also in front of it. */
START_TEST(skin_around_a_joint_follows_its_limb)
{
  const sbfi_d3 path[] = {{0, 0, 0}, {0, 2, 0}, {1.6, 2, 0}};
  tubes_add(tubes, path, 3, 0.12, 40, false);
  uint32_t spine = tubes_add_bone(tubes, "spine", SBF_NONE, (sbfi_d3){0, 0.1, 0}, (sbfi_d3){0, 1.5, 0});
  tubes_add_bone(tubes, "neck", (int32_t)spine, (sbfi_d3){0, 1.5, 0}, (sbfi_d3){0, 1.7, 0});
  uint32_t limb = tubes_add_bone(tubes, "arm", (int32_t)spine, (sbfi_d3){0.8, 2, 0}, (sbfi_d3){1.5, 2, 0});
  compute_tubes();
  for (uint32_t i = 0; i < tubes->point_count; i++)
    if (tubes->points[i].x > 0.6f) ck_assert_double_ge(tubes_weight(&weights, i, limb), 0.8);
}
END_TEST

/* A bone along the middle of another is nearest to no point. */
START_TEST(bones_deep_in_a_body_are_idle)
{
  make_arm(60, false);
  uint32_t twig = tubes_add_bone(tubes, "twig", 0, (sbfi_d3){1.2, 0, 0}, (sbfi_d3){1.7, 0, 0});
  tubes->bones[twig].length = 0.5f;
  compute_tubes();
  for (uint32_t b = 0; b < 3; b++) ck_assert_float_eq(weights.idle_lengths[b], 0);
  ck_assert_float_eq_tol(weights.idle_lengths[twig], 0.5f / 3.4f, 0.01f);
}
END_TEST

/* A leg that ends below and behind the ankle: the heel is the foot's, though both bones are as far. */
START_TEST(the_heel_follows_the_foot)
{
  const sbfi_d3 leg[] = {{0, 2, 0}, {0, -0.3, 0}};
  tubes_add(tubes, leg, 2, 0.2, 60, false);
  uint32_t thigh = tubes_add_bone(tubes, "thigh", SBF_NONE, (sbfi_d3){0, 1.95, 0}, (sbfi_d3){0, 1, 0});
  uint32_t shin = tubes_add_bone(tubes, "shin", (int32_t)thigh, (sbfi_d3){0, 1, 0}, (sbfi_d3){0, 0, 0});
  uint32_t foot = tubes_add_bone(tubes, "foot", (int32_t)shin, (sbfi_d3){0, 0, 0}, (sbfi_d3){0, 0, 1});
  tubes->bones[foot].length = 0.18f;
  compute_tubes();
  for (uint32_t i = 0; i < tubes->point_count; i++) {
    sbf_vec3 at = tubes->points[i];
    if (at.y < -0.25f && at.z < 0.05f) ck_assert_double_ge(tubes_weight(&weights, i, foot), 0.6);
    if (at.y > 0.4f && at.y < 0.6f) ck_assert_double_ge(tubes_weight(&weights, i, shin), 0.9);
  }
}
END_TEST

START_TEST(frames_and_controls_get_no_weights)
{
  make_arm(30, false);
  for (uint32_t i = 0; i < tubes->bone_count; i++) tubes->bones[i].parent += 1;
  memmove(&tubes->bones[1], &tubes->bones[0], 3 * sizeof *tubes->bones);
  tubes->bone_count = 0;
  uint32_t frame = tubes_add_bone(tubes, "body", SBF_NONE, (sbfi_d3){0.5, 0, 0}, (sbfi_d3){0.5, 1, 0});
  tubes->bone_count = 4;
  /* A target in front of the arm, a handle at its last joint, and a handle with a recognizable name. */
  uint32_t aim =
      tubes_add_bone(tubes, "elbow.aim", (int32_t)frame, (sbfi_d3){1.5, 0, 2}, (sbfi_d3){1.5, 0, 3});
  uint32_t pull = tubes_add_bone(tubes, "grip", (int32_t)frame, (sbfi_d3){2, 0, 0}, (sbfi_d3){2, 1, 0});
  uint32_t pole = tubes_add_bone(tubes, "PoleTarget", 2, (sbfi_d3){1.2, 0, 0}, (sbfi_d3){1.2, 1, 0});
  compute_tubes();
  for (uint32_t i = 0; i < tubes->point_count; i++) {
    ck_assert_double_eq(tubes_weight(&weights, i, frame), 0);
    ck_assert_double_eq(tubes_weight(&weights, i, aim), 0);
    ck_assert_double_eq(tubes_weight(&weights, i, pull), 0);
    ck_assert_double_eq(tubes_weight(&weights, i, pole), 0);
  }
  ck_assert_uint_eq(weights.figures.unused_bone_count, 0);
}
END_TEST

/* An end marker has no influence, and the bone before it extends to it. */
START_TEST(ends_of_bones_get_no_weights)
{
  make_arm(60, false);
  uint32_t end = tubes_add_bone(tubes, "arm_end", 2, (sbfi_d3){2.9, 0, 0}, (sbfi_d3){2.9, 1, 0});
  tubes->bones[2].rotation = tubes->bones[end].rotation; /* as of rigs whose bones have no direction */
  compute_tubes();
  check_arm(0.1);
  for (uint32_t i = 0; i < tubes->point_count; i++) ck_assert_double_eq(tubes_weight(&weights, i, end), 0);
  ck_assert_uint_eq(weights.figures.unused_bone_count, 0);
}
END_TEST

/* Handles with which an animator moves a hand, in a tree of their own: one is at the position of a joint. */
START_TEST(trees_of_handles_get_no_weights)
{
  make_arm(60, false);
  uint32_t handle = tubes_add_bone(tubes, "pull", SBF_NONE, (sbfi_d3){2.2, 0.05, 0}, (sbfi_d3){2.2, 0.1, 0});
  uint32_t turn =
      tubes_add_bone(tubes, "turn", (int32_t)handle, (sbfi_d3){2.2, 0.1, 0}, (sbfi_d3){2.2, 0, 0});
  uint32_t wrist = tubes_add_bone(tubes, "lift", (int32_t)turn, (sbfi_d3){2, 0, 0}, (sbfi_d3){2.5, 0, 0});
  compute_tubes();
  check_arm(0.1);
  for (uint32_t i = 0; i < tubes->point_count; i++) {
    ck_assert_double_eq(tubes_weight(&weights, i, handle), 0);
    ck_assert_double_eq(tubes_weight(&weights, i, wrist), 0);
  }
}
END_TEST

/* Fingers that begin at the wrist, as in motion capture: the hand runs on beside them. */
START_TEST(fingers_at_the_wrist_do_not_end_the_hand)
{
  make_arm(60, false);
  uint32_t finger = tubes_add_bone(tubes, "finger", 2, (sbfi_d3){2, 0, 0}, (sbfi_d3){2.2, 0, 0});
  tubes_add_bone(tubes, "tip", (int32_t)finger, (sbfi_d3){2.2, 0, 0}, (sbfi_d3){2.5, 0, 0});
  const int8_t sides[] = {1, 1, 1, 1, 1};
  sbfi_weights_input in = tubes_input(tubes);
  in.sides = sides;
  compute(&in);
  check_arm(0.1);
}
END_TEST

/* A jointed doll: balls in the joints of three limbs of three parts each, and plates on both sides of the
 * middle. */
static uint32_t add_limb(double y, const char *name, int32_t parent) {
  uint32_t first = tubes->bone_count;
  for (int i = 0; i < 3; i++) {
    const sbfi_d3 part[] = {{i + 0.15, y, 0}, {i + 0.85, y, 0}};
    tubes_add(tubes, part, 2, 0.12, 6, false);
    tubes_add_ball(tubes, (sbfi_d3){i, y, 0}, 0.14, 8);
    tubes_add_bone(
        tubes, name, i ? (int32_t)tubes->bone_count - 1 : parent, (sbfi_d3){i, y, 0}, (sbfi_d3){i + 1, y, 0});
  }
  return first;
}

START_TEST(machines_are_rigid)
{
  uint32_t middle = add_limb(0, "middle", SBF_NONE);
  uint32_t left = add_limb(1, "left", (int32_t)middle), right = add_limb(-1, "right", (int32_t)middle);
  ck_assert_uint_eq(left, 3);
  ck_assert_uint_eq(right, 6);
  const sbfi_d3 across[] = {{0.5, -1.7, 0.1}, {0.5, 1.7, 0.1}};
  uint32_t plate = tubes_add(tubes, across, 2, 0.05, 12, false);
  const int8_t sides[] = {0, 0, 0, 1, 1, 1, -1, -1, -1};
  sbfi_weights_input in = tubes_input(tubes);
  in.sides = sides;
  compute(&in);
  ck_assert_uint_eq(weights.figures.shell_count, 19);
  ck_assert_uint_eq(weights.figures.rigid_shell_count, 19);
  for (uint32_t i = plate; i < tubes->point_count; i++) ck_assert_uint_le(weights.joints[i][0], 2);
  for (uint32_t shell = 0; shell < 18; shell++)
    for (uint32_t i = 0; i < plate; i++)
      if (weights.shell_of_point[i] == shell) ck_assert_uint_eq(weights.joints[i][0], shell / 2);
}
END_TEST

/* Rays through the body cost the most of all. */
START_TEST(dense_surfaces_need_few_rays)
{
  make_arm(800, false);
  ck_assert_uint_gt(tubes->point_count, 8192);
  compute_tubes();
  check_arm(0.1);
  ck_assert_uint_le(weights.figures.ray_count, 8192);
  ck_assert_uint_ge(weights.figures.ray_count, 4096);
  double dense = weights.figures.median_distance;
  sbfi_weights_free(&weights);
  tubes->point_count = tubes->triangle_count = tubes->bone_count = 0;
  make_arm(60, false);
  compute_tubes();
  ck_assert_uint_eq(weights.figures.ray_count, tubes->point_count);
  ck_assert_double_eq_tol(weights.figures.median_distance, dense, 0.03);
}
END_TEST

START_TEST(the_unit_changes_nothing)
{
  make_arm(30, false);
  compute_tubes();
  sbfi_weights before = weights;
  for (uint32_t i = 0; i < tubes->point_count; i++)
    tubes->points[i] = sbfi_d3_rounded(sbfi_d3_scale(sbfi_d3_of(tubes->points[i]), 128));
  for (uint32_t b = 0; b < tubes->bone_count; b++)
    tubes->bones[b].head = sbfi_d3_rounded(sbfi_d3_scale(sbfi_d3_of(tubes->bones[b].head), 128));
  compute_tubes();
  ck_assert_mem_eq(before.joints, weights.joints, tubes->point_count * sizeof *weights.joints);
  ck_assert_mem_eq(before.weights, weights.weights, tubes->point_count * sizeof *weights.weights);
  sbfi_weights_free(&before);
}
END_TEST

START_TEST(points_in_no_triangle_follow_the_nearest)
{
  make_arm(30, false);
  uint32_t loose = tubes->point_count++;
  tubes->points[loose] = (sbf_vec3){2.5f, 5, 0};
  compute_tubes();
  ck_assert_double_ge(tubes_weight(&weights, loose, 2), 0.9);
}
END_TEST

START_TEST(refusals)
{
  make_arm(4, false);
  sbfi_weights_input in = tubes_input(tubes);
  in.triangle_count = 1;
  ck_assert_int_eq(sbfi_compute_weights(&in, &weights, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_WEIGHTS_IMPOSSIBLE);
  ck_assert_ptr_null(weights.joints);
  in = tubes_input(tubes);
  for (uint32_t i = 0; i < tubes->point_count; i++) tubes->points[i] = (sbf_vec3){1, 2, 3};
  ck_assert_int_eq(sbfi_compute_weights(&in, &weights, &error), SBF_BAD_INPUT);
  tubes->point_count = tubes->triangle_count = tubes->bone_count = 0;
  make_arm(4, false);
  in = tubes_input(tubes);
  const bool none[3] = {false, false, false};
  in.is_deforming = none;
  ck_assert_int_eq(sbfi_compute_weights(&in, &weights, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_WEIGHTS_IMPOSSIBLE);
  in = tubes_input(tubes);
  in.bone_count = 0;
  ck_assert_int_eq(sbfi_compute_weights(&in, &weights, &error), SBF_BAD_INPUT);
}
END_TEST

START_TEST(memory_may_run_out)
{
  make_arm(4, true);
  tubes_add_ball(tubes, (sbfi_d3){1.5, 0.6, 0}, 0.05, 4);
  sbfi_weights_input in = tubes_input(tubes);
  sbf_status status = SBF_FAILED;
  for (size_t allowed = 0; allowed < 300 && status != SBF_OK; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    in.allocator = &memory.allocator;
    status = sbfi_compute_weights(&in, &weights, &error);
    if (status != SBF_OK) {
      ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
      ck_assert_uint_eq(memory.held_bytes, 0);
    } else {
      sbfi_weights_free(&weights);
      ck_assert_uint_eq(memory.held_bytes, 0);
    }
  }
  ck_assert_int_eq(status, SBF_OK);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("weights");
  TCase *c = tcase_create("weights");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, bones_of_a_chain_divide_a_tube);
  tcase_add_test(c, an_open_tube_is_as_good);
  tcase_add_test(c, triangles_may_be_separate);
  tcase_add_test(c, distance_runs_through_the_body);
  tcase_add_test(c, legs_close_together);
  tcase_add_test(c, thick_parts_reach_farther);
  tcase_add_test(c, small_shells_are_rigid);
  tcase_add_test(c, touching_shells_stay_separate);
  tcase_add_test(c, eyes_follow_the_head_around_them);
  tcase_add_test(c, frames_and_controls_get_no_weights);
  tcase_add_test(c, a_thick_limb_keeps_its_shoulder);
  tcase_add_test(c, a_rim_follows_the_bone_behind_it);
  tcase_add_test(c, a_pad_before_a_joint_follows_its_limb);
  tcase_add_test(c, skin_around_a_joint_follows_its_limb);
  tcase_add_test(c, bones_deep_in_a_body_are_idle);
  tcase_add_test(c, the_heel_follows_the_foot);
  tcase_add_test(c, ends_of_bones_get_no_weights);
  tcase_add_test(c, trees_of_handles_get_no_weights);
  tcase_add_test(c, fingers_at_the_wrist_do_not_end_the_hand);
  tcase_add_test(c, machines_are_rigid);
  tcase_add_test(c, dense_surfaces_need_few_rays);
  tcase_add_test(c, the_unit_changes_nothing);
  tcase_add_test(c, points_in_no_triangle_follow_the_nearest);
  tcase_add_test(c, refusals);
  tcase_add_test(c, memory_may_run_out);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
