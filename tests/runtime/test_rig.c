#include "animation/skeleton/rig.h"

#include <math.h>

#include "gait_stage.h"
#include "harness.h"
#include "math/vec3.h"
#include "quadruped.h"
#include "sbfmt/asset.h"

/* A body on two pegs: hips that swing a foot each, sideways of them. */
static const struct {
  const char *name;
  int32_t parent;
  sbf_vec3 head;
} rows[] = {{"root", -1, {0, 0, 0}}, {"hip.L", 0, {0.1f, 0.3f, 0}}, {"foot.L", 1, {0.4f, 0.25f, 0}},
    {"toe.L", 2, {0.4f, 0.05f, 0.1f}}, {"hip.R", 0, {-0.1f, 0.3f, 0}}, {"foot.R", 4, {-0.4f, 0.25f, 0}},
    {"claw.L", 3, {0.4f, 0, 0.15f}}};
enum { BONES = sizeof rows / sizeof *rows };

static sbf_bone bones[BONES];
static sbf_ik_chain chains[3];
static sbf_leg legs[3];
static sbf_gait gait;

static sbf_asset *make(void) {
  sbf_asset *asset = sbf_asset_create(NULL);
  for (int i = 0; i < BONES; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = bones[i].name = rows[i].name;
    bones[i].parent = rows[i].parent;
    bones[i].head = rows[i].head;
  }
  static const int32_t ends[3] = {2, 5, 6}, roots[3] = {1, 4, 0}; /* the last: four bones below its root */
  for (int i = 0; i < 3; i++) {
    sbf_ik_chain_init(&chains[i]);
    chains[i].root = roots[i];
    chains[i].end = ends[i];
    sbf_leg_init(&legs[i]);
    legs[i].name = rows[ends[i]].name;
    legs[i].ik = i;
    legs[i].home = rows[ends[i]].head;
    legs[i].sole = 0.25f;
    legs[i].group = (uint32_t)i;
  }
  sbf_gait_init(&gait);
  gait.body = gait.hips = 0;
  gait.step_trigger = 0.03f;
  gait.step_height = 0.03f;
  gait.legs = (sbf_leg_list){legs, 3};
  asset->bones = (sbf_bone_list){bones, BONES};
  asset->ik_chains = (sbf_ik_chain_list){chains, 3};
  asset->gaits = (sbf_gait_list){&gait, 1};
  return asset;
}

START_TEST(legs_are_three_bones_or_a_peg_or_have_a_toe)
{
  gait_stage s;
  gait_stage_begin(&s, make());
  ck_assert_uint_eq(s.rig.leg_count, 2); /* bones of neither leg are ignored */
  ck_assert(s.rig.legs[0].upper == 1 && s.rig.legs[0].lower == -1 && s.rig.legs[0].foot == 2);
  ck_assert_float_eq_tol(s.rig.legs[0].length.upper, sqrtf(0.09f + 0.0025f), 1e-6f);
  gait_stage_end(&s);
  sbf_asset *toed = make();
  chains[2].end = 3;
  gait_stage_begin(&s, toed);
  ck_assert_uint_eq(s.rig.leg_count, 3);
  const sbri_leg *leg = &s.rig.legs[2];
  ck_assert(leg->has_toe && leg->toe == 3 && leg->foot == 2 && leg->lower == 1 && leg->upper == 0);
  ck_assert_float_eq_tol(leg->home.ankle.y - leg->home.toe.y, 0.2f, 1e-6f);
  ck_assert_float_gt(leg->length.reach, leg->length.upper + leg->length.lower); /* its foot leans */
  gait_stage_end(&s);
  gait_stage_begin(&s, quadruped_asset());
  ck_assert_uint_eq(s.rig.leg_count, 4);
  for (uint32_t l = 0; l < 4; l++)
    ck_assert(s.rig.legs[l].lower == s.rig.legs[l].upper + 1 && !s.rig.legs[l].has_toe);
  gait_stage_end(&s);
}
END_TEST

/* Five seconds at 0.2 m/s: both feet step alternately and stay in place in stance, with a small error in each
 * peg's length. */
START_TEST(a_character_walks_on_pegs)
{
  gait_stage s;
  gait_stage_begin(&s, make());
  s.input.forward = 0.2f;
  sbf_vec3 stance[2] = {{0}};
  bool was_planted[2] = {false, false};
  float slip = 0;
  for (int i = 0; i < 300; i++) {
    gait_stage_ticks(&s, 1);
    sbr_leg_state now[2];
    ck_assert_uint_eq(sbri_gait_legs(&s.rig, s.state, 1, now, 2), 2);
    ck_assert(now[0].planted || now[1].planted);
    for (int l = 0; l < 2; l++) {
      sbf_vec3 foot = s.pose[s.rig.legs[l].foot].position, hip = s.pose[s.rig.legs[l].upper].position;
      ck_assert_float_eq_tol(sbri_length(sbri_sub(foot, hip)), s.rig.legs[l].length.upper, 0.15f);
      if (now[l].planted && !was_planted[l]) stance[l] = foot;
      if (now[l].planted) slip = fmaxf(slip, sbri_length(sbri_sub(foot, stance[l])));
      was_planted[l] = now[l].planted;
    }
    /* The toe hangs on its foot and stays level with it. */
    ck_assert_float_eq_tol(s.pose[2].position.y - s.pose[3].position.y, 0.2f, 1e-5f);
  }
  sbr_leg_state now[2];
  sbri_gait_legs(&s.rig, s.state, 1, now, 2);
  ck_assert_uint_ge(now[0].steps_taken, 4);
  ck_assert_uint_ge(now[1].steps_taken, 4);
  ck_assert_float_lt(slip, 1e-4f);
  gait_stage_end(&s);
}
END_TEST

/* A knee between two bodies: the narrowest of several limits of one motion applies, also of a hinge's own
 * limit. */
START_TEST(limits_of_a_joint_narrow_each_other)
{
  static const struct { float min, max; } bounds[] = {{-0.4f, 2}, {-1, 0.9f}, {-0.8f, 1.5f}};
  sbf_asset *asset = make();
  sbf_rigid_body *bodies = sbf_asset_allocate(asset, 2, sizeof *bodies);
  sbf_joint *joint = sbf_asset_allocate(asset, 1, sizeof *joint);
  sbf_limit *limits = sbf_asset_allocate(asset, 3, sizeof *limits);
  for (int i = 0; i < 2; i++) {
    sbf_rigid_body_init(&bodies[i]);
    bodies[i].bone = i + 1;
    bodies[i].center = rows[i + 1].head;
  }
  sbf_joint_init(joint);
  joint->kind = SBF_JOINT_KIND_REVOLUTE;
  joint->body_a = 0, joint->body_b = 1;
  joint->frame_a.position = sbri_sub(rows[2].head, rows[1].head);
  for (int i = 0; i < 3; i++) {
    sbf_limit_init(&limits[i]);
    limits[i].target = SBF_JOINT_AXIS_TWIST;
    limits[i].min = bounds[i].min, limits[i].max = bounds[i].max;
  }
  joint->limits = (sbf_limit_list){limits, 3};
  asset->rigid_bodies = (sbf_rigid_body_list){bodies, 2};
  asset->joints = (sbf_joint_list){joint, 1};
  gait_stage s;
  gait_stage_begin(&s, asset);
  const sbri_joint_limit *limit = &s.rig.bones.limits[2];
  ck_assert(limit->active);
  ck_assert_float_eq(limit->twist[0], -0.4f);
  ck_assert_float_eq(limit->twist[1], 0.9f);
  ck_assert_float_eq(limit->swing_y[0], 0);
  ck_assert_float_eq(limit->swing_z[1], 0);
  ck_assert(!s.rig.bones.limits[1].active);
  gait_stage_end(&s);
}
END_TEST

/* A foot of an octahedron: a vertex on the ground, a ring of four a half of its height above. */
START_TEST(a_round_sole_is_as_wide_as_its_points_near_the_ground)
{
  enum { HAND = 16 };
  const float radius = 0.05f, height = 0.12f;
  sbf_asset *asset = quadruped_asset();
  sbf_vec3 home = asset->bones.at[HAND].head, top = {home.x, height, home.z}, bottom = {home.x, 0, home.z};
  sbf_vec3 at[6] = {bottom, {home.x - radius, height / 2, home.z}, {home.x, height / 2, home.z - radius},
      {home.x + radius, height / 2, home.z}, {home.x, height / 2, home.z + radius}, top};
  const uint32_t sizes[8] = {3, 3, 3, 3, 3, 3, 3, 3};
  const uint32_t points[24] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 5, 2, 1, 5, 3, 2, 5, 4, 3, 5, 1, 4};
  const uint32_t counts[6] = {1, 1, 1, 1, 1, 1}, bones_of[6] = {HAND, HAND, HAND, HAND, HAND, HAND};
  const float weights[6] = {1, 1, 1, 1, 1, 1};
  sbf_skin skin;
  sbf_skin_init(&skin);
  skin.influence_counts = (sbf_u32_list){counts, 6};
  skin.bones = (sbf_u32_list){bones_of, 6};
  skin.weights = (sbf_f32_list){weights, 6};
  sbf_render_mesh mesh;
  sbf_render_mesh_init(&mesh);
  mesh.mesh =
      (sbf_polygon_mesh){.positions = {at, 6}, .polygon_sizes = {sizes, 8}, .polygon_points = {points, 24}};
  mesh.skin = &skin;
  asset->render_meshes = (sbf_render_mesh_list){&mesh, 1};
  gait_stage s;
  gait_stage_begin(&s, asset);
  const sbri_leg *leg = NULL;
  for (uint32_t l = 0; l < s.rig.leg_count; l++)
    if (s.rig.legs[l].foot == HAND) leg = &s.rig.legs[l];
  ck_assert_ptr_nonnull(leg);
  /* At 6 % of its height it is 12 % of its ring. */
  for (int k = 0; k < 4; k++) {
    const sbf_vec3 corner = leg->sole.corners[k];
    ck_assert_float_eq_tol(fabsf(corner.x) + fabsf(corner.z), 0.12f * radius, 1e-5f);
  }
  gait_stage_end(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rig");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, legs_are_three_bones_or_a_peg_or_have_a_toe);
  tcase_add_test(tests, a_character_walks_on_pegs);
  tcase_add_test(tests, limits_of_a_joint_narrow_each_other);
  tcase_add_test(tests, a_round_sole_is_as_wide_as_its_points_near_the_ground);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
