/* Swinging chains: pendulums by closed forms, the same at every tick, outside or inside of colliders. */
#include <stdlib.h>
#include <string.h>

#include "gait_stage.h"
#include "harness.h"
#include "sbfmt/asset.h"

/* A root and three bones of 0.2 m behind it, of which the first two swing in the shape tests' chain, and all
 * three in the others. */
enum { BONES = 4, LINKS = 3 };
static const float LENGTH = 0.2f;
static const float TICKS_HZ[] = {30, 60, 144, 50};

typedef struct spring_values {
  float stiffness, drag, radius;
  sbf_vec3 gravity;
  int32_t center;
} spring_values;

static const spring_values HAIR = {30, 8, 0.01f, {0, -20, 0}, SBF_NONE};

static const sbf_bone *bones_of(sbf_asset *a) {
  sbf_bone *bones = sbf_asset_allocate(a, BONES, sizeof *bones);
  for (int i = 0; i < BONES; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = bones[i].name = "bone";
    bones[i].parent = i - 1;
    bones[i].head = sbri_vec3(0, 1, i ? -LENGTH * (float)(i - 1) : 0);
    bones[i].rotation = sbri_quat_between(sbri_vec3(0, 1, 0), sbri_vec3(0, 0, -1));
    bones[i].length = i ? LENGTH : 0;
  }
  return bones;
}

static void add_chain(
    sbf_asset *a, sbf_chain *chain, const uint32_t *bones, uint32_t count, spring_values v) {
  sbf_chain_spring *spring = sbf_asset_allocate(a, 1, sizeof *spring);
  float *numbers = sbf_asset_allocate(a, 3, sizeof *numbers);
  sbf_vec3 *gravity = sbf_asset_allocate(a, 1, sizeof *gravity);
  numbers[0] = v.stiffness, numbers[1] = v.drag, numbers[2] = v.radius, *gravity = v.gravity;
  sbf_chain_spring_init(spring);
  spring->stiffness = (sbf_f32_list){numbers, 1};
  spring->drag = (sbf_f32_list){numbers + 1, 1};
  spring->radius = (sbf_f32_list){numbers + 2, 1};
  spring->gravity = (sbf_vec3_list){gravity, 1};
  spring->center = v.center;
  sbf_chain_init(chain);
  chain->id = "hair";
  chain->bones = (sbf_u32_list){bones, count};
  chain->spring = spring;
}

static sbf_asset *hair(uint32_t links, spring_values v) {
  static const uint32_t order[LINKS] = {1, 2, 3};
  sbf_asset *a = sbf_asset_create(NULL);
  sbf_chain *chain = sbf_asset_allocate(a, 1, sizeof *chain);
  a->bones = (sbf_bone_list){bones_of(a), links + 1};
  add_chain(a, chain, order, links, v);
  a->chains = (sbf_chain_list){chain, 1};
  return a;
}

static sbf_vec3 along(const gait_stage *s, uint32_t bone) {
  return sbri_rotate(s->pose[bone].rotation, sbri_vec3(0, 1, 0));
}

static sbf_vec3 end_of(const gait_stage *s, uint32_t bone) {
  return sbri_add_scaled(s->pose[bone].position, along(s, bone), LENGTH * s->input.scale);
}

START_TEST(a_chain_rests_along_stiffness_and_gravity)
{
  for (size_t i = 0; i < sizeof TICKS_HZ / sizeof *TICKS_HZ; i++) {
    gait_stage s;
    gait_stage_begin_scaled(&s, hair(LINKS, HAIR), 1 / TICKS_HZ[i], 1);
    gait_stage_ticks(&s, (int)(6 * TICKS_HZ[i]));
    sbf_vec3 pose = sbri_vec3(0, 0, -1);
    for (uint32_t k = 1; k <= LINKS; k++) {
      sbf_vec3 rests = sbri_add_scaled(HAIR.gravity, pose, HAIR.stiffness);
      pose = sbri_normalize(rests, pose);
      ck_assert_float_le(sbri_length(sbri_sub(along(&s, k), pose)), 1e-3f);
    }
    gait_stage_end(&s);
  }
}
END_TEST

/* Angle of one link that is let go at 0.1 rad to the side: a'' + (drag + h stiffness/L) a' + stiffness/L a =
 * 0, with steps of h = 1/60 s. */
START_TEST(a_small_angle_swings_as_a_damped_oscillator)
{
  const float f = 0.8f, w = 6.2831853f * f, damping = 0.15f;
  spring_values v = {LENGTH * w * w, 2 * damping * w - w * w / 60, 0, {0, 0, 0}, SBF_NONE};
  gait_stage s;
  gait_stage_begin_scaled(&s, hair(1, v), 1.0f / 60, 1);
  sbri_spring_end *end = sbri_spring_ends(&s.rig, s.state);
  end->now = end->before = sbri_add_scaled(s.pose[1].position, sbri_vec3(sinf(0.1f), 0, -cosf(0.1f)), LENGTH);
  const double u = (double)w * sqrt(1 - (double)damping * (double)damping);
  for (int i = 1; i <= 120; i++) {
    gait_stage_ticks(&s, 1);
    double t = (i + 0.5) / 60,
           decay = exp(-(double)damping * (double)w * t); /* the velocity is half a step late */
    double exact = 0.1 * decay * (cos(u * t) + (double)damping * (double)w / u * sin(u * t));
    ck_assert_double_eq_tol((double)along(&s, 1).x, exact, 0.002);
  }
  gait_stage_end(&s);
}
END_TEST

/* Positions of the ends relative to the head, twenty times a second, while the host moves and turns the
 * character. */
static void record(float hz, float scale, spring_values v, sbf_vec3 *at) {
  gait_stage s;
  gait_stage_begin_scaled(&s, hair(LINKS, v), 1 / hz, scale);
  double x = 0;
  int ticks = (int)hz, count = 0;
  for (int i = 1; i <= 3 * ticks; i++) {
    double t = i / (double)hz, to = 0.3 * sin(3 * t);
    s.input.displacement = sbri_vec3((float)(to - x) * scale, 0, 0);
    s.input.rotation = (float)(0.8 / (double)hz);
    x = to;
    gait_stage_ticks(&s, 1);
    if ((i * 2) % ticks == 0)
      for (uint32_t k = 1; k <= LINKS; k++)
        at[count++] = sbri_scale(sbri_sub(end_of(&s, k), s.pose[1].position), 1 / scale);
  }
  gait_stage_end(&s);
}

enum { RECORDED = 6 * LINKS };

static float max_difference(const sbf_vec3 *a, const sbf_vec3 *b) {
  float max = 0;
  for (int i = 0; i < RECORDED; i++) max = fmaxf(max, sbri_length(sbri_sub(a[i], b[i])));
  return max;
}

START_TEST(its_motion_does_not_depend_on_the_tick)
{
  sbf_vec3 reference[RECORDED], at[RECORDED];
  record(60, 1, HAIR, reference);
  for (size_t i = 0; i < sizeof TICKS_HZ / sizeof *TICKS_HZ; i++) {
    record(TICKS_HZ[i], 1, HAIR, at);
    ck_assert_float_le(max_difference(at, reference), 0.01f * LINKS * LENGTH);
  }
  spring_values limp = HAIR;
  limp.stiffness = 3;
  record(60, 1, limp, at);
  ck_assert_float_gt(max_difference(at, reference), 0.1f); /* it was not the same because nothing swung */
}
END_TEST

START_TEST(a_larger_character_with_larger_accelerations_moves_equally)
{
  sbf_vec3 reference[RECORDED], at[RECORDED];
  spring_values twice = HAIR;
  twice.stiffness *= 2, twice.gravity = sbri_scale(HAIR.gravity, 2);
  record(60, 1, HAIR, reference);
  record(60, 2, twice, at);
  ck_assert_float_le(max_difference(at, reference), 1e-4f);
}
END_TEST

START_TEST(relative_to_a_center_its_motion_does_not_swing_it)
{
  for (int has_center = 0; has_center < 2; has_center++) {
    spring_values v = HAIR;
    v.center = has_center ? 0 : SBF_NONE;
    gait_stage s;
    gait_stage_begin(&s, hair(LINKS, v));
    gait_stage_ticks(&s, 600);
    sbf_vec3 hangs = sbri_sub(end_of(&s, LINKS), s.pose[1].position);
    float max = 0;
    for (int i = 0; i < 60; i++) {
      s.input.displacement = sbri_vec3(0.02f, 0, 0);
      gait_stage_ticks(&s, 1);
      max = fmaxf(max, sbri_length(sbri_sub(sbri_sub(end_of(&s, LINKS), s.pose[1].position), hangs)));
    }
    if (has_center)
      ck_assert_float_le(max, 1e-4f);
    else
      ck_assert_float_gt(max, 0.05f);
    gait_stage_end(&s);
  }
}
END_TEST

/* Signed distance of a point from the collider; below 0: penetration. */
static float clearance_of(const sbf_chain_collider *c, sbf_vec3 p, float radius) {
  sbf_vec3 offset = sbri_sub(p, c->position), axis = sbri_sub(c->end, c->position);
  if (c->shape == SBF_CHAIN_COLLIDER_SHAPE_PLANE)
    return sbri_dot(offset, sbri_normalize(c->normal, axis)) - radius;
  float t = sbri_clamp(sbri_dot(offset, axis) / fmaxf(sbri_dot(axis, axis), 1e-9f), 0, 1);
  float distance =
      sbri_length(c->shape == SBF_CHAIN_COLLIDER_SHAPE_CAPSULE ? sbri_add_scaled(offset, axis, -t) : offset);
  return c->inside ? c->radius - radius - distance : distance - radius - c->radius;
}

/* A link falls from level, and each collider stops its end. With a single correction per step and the length
 * restored afterwards, as in VRM, some penetration is left. */
static float min_clearance(const sbf_chain_collider *shape, bool collides, float *last) {
  static const uint32_t first = 0;
  const spring_values v = {2, 3, 0.01f, {0, -30, 0}, SBF_NONE};
  sbf_asset *a = hair(1, v);
  sbf_chain_collider *collider = sbf_asset_allocate(a, 1, sizeof *collider);
  *collider = *shape;
  a->chain_colliders = (sbf_chain_collider_list){collider, 1};
  ((sbf_chain_spring *)(uintptr_t)a->chains.at->spring)->colliders = (sbf_u32_list){&first, collides};
  gait_stage s;
  gait_stage_begin(&s, a);
  float min = 1;
  for (int k = 0; k < 240; k++) {
    gait_stage_ticks(&s, 1);
    *last = clearance_of(shape, end_of(&s, 1), v.radius);
    min = fminf(min, *last);
  }
  gait_stage_end(&s);
  return min;
}

START_TEST(ends_stay_out_of_colliders_or_inside)
{
  static const sbf_chain_collider shapes[] = {
      {"s", "", 0, SBF_CHAIN_COLLIDER_SHAPE_SPHERE, {0, 0.85f, -0.15f}, {0, 0, 0}, {0, 1, 0}, 0.08f, false},
      {"c", "", 0, SBF_CHAIN_COLLIDER_SHAPE_CAPSULE, {-0.3f, 0.85f, -0.12f}, {0.3f, 0.85f, -0.18f}, {0, 1, 0},
          0.07f, false},
      {"p", "", 0, SBF_CHAIN_COLLIDER_SHAPE_PLANE, {0, 0.9f, 0}, {0, 0, 0}, {0, 3, 1}, 0, false},
      {"i", "", 0, SBF_CHAIN_COLLIDER_SHAPE_SPHERE, {0, 1, -0.1f}, {0, 0, 0}, {0, 1, 0}, 0.15f, true},
      {"k", "", 0, SBF_CHAIN_COLLIDER_SHAPE_CAPSULE, {0, 1, 0}, {0, 1, -0.2f}, {0, 1, 0}, 0.1f, true}};
  for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
    float last, unused;
    ck_assert_float_lt(min_clearance(&shapes[i], false, &unused), -0.06f);
    ck_assert_float_gt(min_clearance(&shapes[i], true, &last), -0.025f);
    ck_assert_float_le(fabsf(last), 0.01f);
  }
}
END_TEST

/* The centre of a sphere has no direction outwards, nor has a collider of radius 0. */
START_TEST(an_end_in_the_middle_of_a_collider_stays_finite)
{
  static const uint32_t first = 0;
  sbf_asset *a = hair(1, HAIR);
  sbf_chain_collider *collider = sbf_asset_allocate(a, 1, sizeof *collider);
  *collider = (sbf_chain_collider){
      .id = "m", .name = "", .bone = 0, .position = {0, 1, -LENGTH}, .normal = {0, 0, 0}, .radius = 0.1f};
  a->chain_colliders = (sbf_chain_collider_list){collider, 1};
  ((sbf_chain_spring *)(uintptr_t)a->chains.at->spring)->colliders = (sbf_u32_list){&first, 1};
  gait_stage s;
  gait_stage_begin(&s, a);
  for (int i = 0; i < 60; i++) {
    gait_stage_ticks(&s, 1);
    ck_assert(isfinite(end_of(&s, 1).x) && isfinite(end_of(&s, 1).y));
    ck_assert_float_eq_tol(sbri_length(sbri_sub(end_of(&s, 1), s.pose[1].position)), LENGTH, 1e-5f);
  }
  gait_stage_end(&s);
}
END_TEST

START_TEST(a_chain_on_another_moves_after_it_in_any_order)
{
  static const uint32_t low[2] = {1, 2}, high[1] = {3};
  sbf_vec3 ends[2];
  for (int swapped = 0; swapped < 2; swapped++) {
    sbf_asset *a = sbf_asset_create(NULL);
    sbf_chain *chains = sbf_asset_allocate(a, 2, sizeof *chains);
    a->bones = (sbf_bone_list){bones_of(a), BONES};
    add_chain(a, &chains[swapped], low, 2, HAIR);
    add_chain(a, &chains[1 - swapped], high, 1, HAIR);
    a->chains = (sbf_chain_list){chains, 2};
    gait_stage s;
    gait_stage_begin(&s, a);
    s.input.displacement = sbri_vec3(0.02f, 0, 0);
    gait_stage_ticks(&s, 40);
    ends[swapped] = end_of(&s, 3);
    gait_stage_end(&s);
  }
  ck_assert_mem_eq(&ends[0], &ends[1], sizeof *ends);
}
END_TEST

START_TEST(a_moved_origin_changes_nothing)
{
  const sbf_vec3 shift = {0.5f, 0, -0.25f};
  for (int has_center = 0; has_center < 2; has_center++) {
    spring_values v = HAIR;
    v.center = has_center ? 0 : SBF_NONE;
    gait_stage moved, kept;
    gait_stage_begin(&moved, hair(LINKS, v));
    gait_stage_begin(&kept, hair(LINKS, v));
    for (int i = 0; i < 60; i++) {
      kept.input.displacement = moved.input.displacement = sbri_vec3(0.02f, 0, 0);
      gait_stage_ticks(&kept, 1);
      gait_stage_ticks(&moved, 1);
      if (i == 20) sbri_gait_rebase(&moved.rig, moved.state, shift);
    }
    sbf_vec3 difference = sbri_sub(sbri_sub(end_of(&kept, LINKS), end_of(&moved, LINKS)), shift);
    ck_assert_float_le(sbri_length(difference), 1e-5f);
    gait_stage_end(&moved);
    gait_stage_end(&kept);
  }
}
END_TEST

/* Then its character can fall asleep. */
START_TEST(at_rest_its_state_does_not_change)
{
  for (size_t i = 0; i < sizeof TICKS_HZ / sizeof *TICKS_HZ; i++) {
    gait_stage s;
    gait_stage_begin_scaled(&s, hair(LINKS, HAIR), 1 / TICKS_HZ[i], 1);
    gait_stage_ticks(&s, (int)(20 * TICKS_HZ[i]));
    size_t size = sizeof(sbri_spring_end) * LINKS;
    sbri_spring_end before[LINKS];
    float pending = sbri_spring_clocks(&s.rig, s.state)->pending_s;
    memcpy(before, sbri_spring_ends(&s.rig, s.state), size);
    gait_stage_ticks(&s, 1);
    ck_assert_mem_eq(before, sbri_spring_ends(&s.rig, s.state), size);
    if (TICKS_HZ[i] <= 60) ck_assert_float_eq(sbri_spring_clocks(&s.rig, s.state)->pending_s, pending);
    gait_stage_end(&s);
  }
}
END_TEST

/* The last bone of VRM's chains ends the one before it. */
START_TEST(a_last_bone_without_spacing_does_not_swing)
{
  static const float spacing[LINKS] = {0.2f, 0.2f, 0};
  gait_stage s;
  sbf_asset *a = hair(LINKS, HAIR);
  ((sbf_chain *)(uintptr_t)a->chains.at)->spacing = (sbf_f32_list){spacing, LINKS};
  gait_stage_begin(&s, a);
  gait_stage_ticks(&s, 120);
  ck_assert_float_gt(sbri_length(sbri_sub(along(&s, 2), along(&s, 1))), 0.01f);
  ck_assert_float_le(sbri_length(sbri_sub(along(&s, 3), along(&s, 2))), 1e-5f);
  gait_stage_end(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("spring_chain");
  TCase *all = tcase_create("all");
  tcase_add_test(all, a_chain_rests_along_stiffness_and_gravity);
  tcase_add_test(all, a_small_angle_swings_as_a_damped_oscillator);
  tcase_add_test(all, its_motion_does_not_depend_on_the_tick);
  tcase_add_test(all, a_larger_character_with_larger_accelerations_moves_equally);
  tcase_add_test(all, relative_to_a_center_its_motion_does_not_swing_it);
  tcase_add_test(all, ends_stay_out_of_colliders_or_inside);
  tcase_add_test(all, an_end_in_the_middle_of_a_collider_stays_finite);
  tcase_add_test(all, a_chain_on_another_moves_after_it_in_any_order);
  tcase_add_test(all, a_moved_origin_changes_nothing);
  tcase_add_test(all, at_rest_its_state_does_not_change);
  tcase_add_test(all, a_last_bone_without_spacing_does_not_swing);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
