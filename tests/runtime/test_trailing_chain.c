#include "gait_stage.h"
#include "harness.h"
#include "sbfmt/asset.h"

/* A snake of eight bones of 0.2 m, head first, its body behind it. */
enum { BONES = 8 };
static const float LENGTH = 0.2f;

static void begin(gait_stage *s, sbf_chain_kind kind, float damping) {
  static const uint32_t order[BONES] = {0, 1, 2, 3, 4, 5, 6, 7};
  sbf_asset *a = sbf_asset_create(NULL);
  sbf_bone *bones = sbf_asset_allocate(a, BONES, sizeof *bones);
  for (int i = 0; i < BONES; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = bones[i].name = "bone";
    bones[i].parent = i - 1;
    bones[i].head = sbri_vec3(0, 0.1f, -LENGTH * (float)i);
    bones[i].rotation = sbri_quat_between(sbri_vec3(0, 1, 0), sbri_vec3(0, 0, -1));
    bones[i].length = LENGTH;
  }
  a->bones = (sbf_bone_list){bones, BONES};
  sbf_chain *chain = sbf_asset_allocate(a, 1, sizeof *chain);
  sbf_chain_init(chain);
  chain->id = "body";
  chain->kind = kind;
  chain->bones = (sbf_u32_list){order, BONES};
  chain->angle_limit = 0.4f;
  chain->damping = damping;
  a->chains = (sbf_chain_list){chain, 1};
  gait_stage_begin(s, a);
}

static void run(gait_stage *s, double seconds, float forward, float turn) {
  s->input.forward = forward;
  s->input.turn = turn;
  for (int i = 0; i < (int)(60 * seconds); i++) {
    gait_stage_ticks(s, 1);
    for (int k = 1; k < BONES; k++) {
      float separation = sbri_length(sbri_sub(s->pose[k].position, s->pose[k - 1].position));
      ck_assert_float_eq_tol(separation, LENGTH, 1e-4f);
    }
  }
}

static sbf_vec3 along(const gait_stage *s, int k) {
  return sbri_rotate(s->pose[k].rotation, sbri_vec3(0, 1, 0));
}

static float max_bend(const gait_stage *s) {
  float max = 0;
  for (int k = 1; k < BONES; k++)
    max = fmaxf(max, acosf(sbri_clamp(sbri_dot(along(s, k), along(s, k - 1)), -1, 1)));
  return max;
}

START_TEST(a_chain_at_rest_has_its_modelled_pose)
{
  gait_stage s;
  begin(&s, SBF_CHAIN_KIND_DISTANCE, 0);
  run(&s, 1, 0, 0);
  for (int k = 0; k < BONES; k++)
    ck_assert_float_le(sbri_length(sbri_sub(s.pose[k].position, s.rig.bones.rest[k].position)), 1e-4f);
  gait_stage_end(&s);
}
END_TEST

START_TEST(the_body_follows_the_path_of_the_head)
{
  gait_stage s;
  begin(&s, SBF_CHAIN_KIND_DISTANCE, 0);
  run(&s, 3, 0.5f, 0);
  run(&s, 2, 0.5f, 0.8f);
  ck_assert_float_gt(max_bend(&s), 0.05f);
  ck_assert_float_le(max_bend(&s), 0.41f);
  /* Its last bone still lies near the straight line that the head came along. */
  ck_assert_float_lt(fabsf(s.pose[BONES - 1].position.x), 0.5f * fabsf(s.pose[0].position.x));
  gait_stage_end(&s);
}
END_TEST

START_TEST(the_bend_is_bounded)
{
  gait_stage s;
  begin(&s, SBF_CHAIN_KIND_DISTANCE, 0);
  run(&s, 4, 0.05f, 3);
  ck_assert_float_le(max_bend(&s), 0.401f);
  gait_stage_end(&s);
}
END_TEST

START_TEST(damping_straightens_it_at_rest)
{
  gait_stage stiff, limp;
  begin(&stiff, SBF_CHAIN_KIND_DISTANCE, 3);
  begin(&limp, SBF_CHAIN_KIND_DISTANCE, 0);
  run(&stiff, 3, 0.4f, 1.2f), run(&limp, 3, 0.4f, 1.2f);
  run(&stiff, 5, 0, 0), run(&limp, 5, 0, 0);
  ck_assert_float_lt(max_bend(&stiff), 0.12f);
  ck_assert_float_gt(max_bend(&limp), 2 * max_bend(&stiff));
  gait_stage_end(&stiff), gait_stage_end(&limp);
}
END_TEST

START_TEST(links_keep_the_requested_spacing)
{
  static const float spacing[BONES] = {0.2f, 0.3f, 0.1f, 0.25f, 0.2f, 0.2f, 0.4f, 0.2f};
  gait_stage s;
  begin(&s, SBF_CHAIN_KIND_DISTANCE, 0);
  ((sbf_chain *)(uintptr_t)s.asset->chains.at)->spacing = (sbf_f32_list){spacing, BONES};
  sbri_gait_pose(&s.rig, s.state, &s.input, true, s.pose);
  s.input.forward = 0.4f, s.input.turn = 0.7f;
  for (int i = 0; i < 240; i++) {
    gait_stage_ticks(&s, 1);
    for (int k = 1; k < BONES; k++) {
      float separation = sbri_length(sbri_sub(s.pose[k].position, s.pose[k - 1].position));
      ck_assert_float_eq_tol(separation, spacing[k - 1], 1e-4f);
    }
  }
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_swimmer_keeps_its_height)
{
  gait_stage s;
  begin(&s, SBF_CHAIN_KIND_DISTANCE, 1);
  sbri_gait_reset(&s.rig, s.state, &s.input, sbri_vec3(0, 0.7f, 0), 0);
  sbri_gait_pose(&s.rig, s.state, &s.input, true, s.pose);
  run(&s, 2, 0.5f, 1), run(&s, 2, 0.5f, -1);
  for (int k = 0; k < BONES; k++) ck_assert_float_eq_tol(s.pose[k].position.y, 0.8f, 1e-3f);
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_lagging_chain_keeps_its_direction_for_a_while)
{
  gait_stage s;
  begin(&s, SBF_CHAIN_KIND_LAG, 4);
  run(&s, 1, 0, 1);
  ck_assert_float_gt(max_bend(&s), 0.02f);
  run(&s, 5, 0, 0);
  ck_assert_float_lt(max_bend(&s), 0.01f);
  gait_stage_end(&s);
}
END_TEST

START_TEST(the_chain_rests_on_the_ground)
{
  gait_stage s;
  begin(&s, SBF_CHAIN_KIND_DISTANCE, 0);
  s.ground = sbr_ground_slope(15);
  run(&s, 6, 0.5f, 0);
  for (int k = 0; k < BONES; k++) {
    sbf_vec3 p = s.pose[k].position, normal;
    float ground = (float)s.ground.height(&s.ground, (double)p.x, (double)p.z, &normal);
    ck_assert_float_eq_tol(p.y - ground, 0.1f, 0.06f); /* its head stays level */
  }
  gait_stage_end(&s);
}
END_TEST

/* A segment without length may exist for its index alone. */
START_TEST(empty_links_have_no_length)
{
  static const float spacing[BONES] = {0.2f, 0, 0.2f, 0, 0, 0.3f, 0.2f, 0.2f};
  gait_stage s;
  begin(&s, SBF_CHAIN_KIND_DISTANCE, 1);
  ((sbf_chain *)(uintptr_t)s.asset->chains.at)->spacing = (sbf_f32_list){spacing, BONES};
  sbri_gait_pose(&s.rig, s.state, &s.input, true, s.pose);
  s.input.forward = 0.4f, s.input.turn = 0.9f;
  for (int i = 0; i < 300; i++) {
    if (i == 200) s.input.forward = s.input.turn = 0;
    gait_stage_ticks(&s, 1);
    for (int k = 1; k < BONES; k++) {
      float separation = sbri_length(sbri_sub(s.pose[k].position, s.pose[k - 1].position));
      ck_assert_float_eq_tol(separation, spacing[k - 1], 1e-4f);
      ck_assert(isfinite(s.pose[k].rotation.w));
      if (spacing[k] == 0) ck_assert_float_ge(sbri_dot(along(&s, k), along(&s, k - 1)), 0.99999f);
    }
  }
  ck_assert_float_le(max_bend(&s), 0.41f);
  gait_stage_end(&s);
}
END_TEST

/* From the same bends, at any tick: each decays by exp(-damping t). */
START_TEST(straightening_takes_the_same_time_at_any_tick)
{
  float left[3];
  const int rates[3] = {30, 60, 240};
  for (int r = 0; r < 3; r++) {
    gait_stage s;
    begin(&s, SBF_CHAIN_KIND_LAG, 2);
    for (int k = 1; k < BONES; k++) { /* each continues the one before it, turned by 0.2 rad */
      sbri_chain_bone *bone = &sbri_chain_bones(&s.rig, s.state)[k];
      sbf_quat bend = sbri_quat_about(sbri_vec3(0, 1, 0), 0.2f * (float)k);
      bone->frame.rotation = sbri_quat_multiply(bend, bone->frame.rotation);
    }
    s.input.tick_s = 1 / (float)rates[r];
    gait_stage_ticks(&s, rates[r]);
    left[r] = max_bend(&s);
    gait_stage_end(&s);
  }
  ck_assert_float_lt(left[1], 0.2f);
  ck_assert_float_eq_tol(left[0], left[1], 0.02f);
  ck_assert_float_eq_tol(left[2], left[1], 0.02f);
}
END_TEST

/* Twice round, past the angle where headings wrap: no bone rotates faster than the head plus its own bend. */
START_TEST(nothing_jumps_where_headings_wrap_around)
{
  for (int kind = 0; kind < 2; kind++) {
    gait_stage s;
    begin(&s, kind ? SBF_CHAIN_KIND_LAG : SBF_CHAIN_KIND_DISTANCE, 2);
    run(&s, 2, 0.3f, 1.5f);
    sbr_transform before[BONES];
    for (int i = 0; i < 60 * 9; i++) {
      for (int k = 0; k < BONES; k++) before[k] = s.pose[k];
      gait_stage_ticks(&s, 1);
      for (int k = 0; k < BONES; k++) {
        sbf_quat moved = sbri_quat_multiply(s.pose[k].rotation, sbri_quat_conjugate(before[k].rotation));
        ck_assert_float_le(sbri_length(sbri_quat_log(moved)), 2 * 1.5f / 60);
      }
    }
    gait_stage_end(&s);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("trailing_chain");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_chain_at_rest_has_its_modelled_pose);
  tcase_add_test(tests, the_body_follows_the_path_of_the_head);
  tcase_add_test(tests, the_bend_is_bounded);
  tcase_add_test(tests, damping_straightens_it_at_rest);
  tcase_add_test(tests, links_keep_the_requested_spacing);
  tcase_add_test(tests, a_swimmer_keeps_its_height);
  tcase_add_test(tests, a_lagging_chain_keeps_its_direction_for_a_while);
  tcase_add_test(tests, the_chain_rests_on_the_ground);
  tcase_add_test(tests, empty_links_have_no_length);
  tcase_add_test(tests, straightening_takes_the_same_time_at_any_tick);
  tcase_add_test(tests, nothing_jumps_where_headings_wrap_around);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
