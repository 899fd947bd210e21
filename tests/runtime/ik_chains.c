#include "ik_chains.h"

#include "harness.h"
#include "random.h"

float ik_random(uint32_t *seed) {
  return random_between(seed, -1, 1);
}

sbf_vec3 ik_random_place(uint32_t *seed, float radius) {
  for (;;) {
    float x = ik_random(seed), y = ik_random(seed), z = ik_random(seed);
    if (x * x + y * y + z * z <= 1) return sbri_vec3(radius * x, radius * y, radius * z);
  }
}

sbf_quat ik_random_rotation(uint32_t *seed) {
  float x = ik_random(seed), y = ik_random(seed), z = ik_random(seed), w = ik_random(seed);
  return sbri_quat_normalize((sbf_quat){x, y, z, w});
}

void ik_chain_straight(ik_chain_fixture *f) {
  *f = (ik_chain_fixture){.chain = {.base = {{0, 0, 0}, {0, 0, 0, 1}},
                              .count = IK_CHAIN_JOINTS,
                              .target_rotation = {0, 0, 0, 1},
                              .tolerance = 1e-3f,
                              .iterations = 200}};
  for (int i = 0; i < IK_CHAIN_JOINTS; i++)
    f->joints[i] = (sbri_ik_joint){.offset = {0, i ? 1.0f : 0, 0}, .rotation = {0, 0, 0, 1}};
  f->chain.joints = f->joints;
}

void ik_chain_bent(ik_chain_fixture *f) {
  ik_chain_straight(f);
  for (int i = 1; i + 1 < IK_CHAIN_JOINTS; i++)
    f->joints[i].rotation = sbri_quat_about(sbri_vec3(1, 0, 0), 0.2f);
}

void ik_chain_limit(ik_chain_fixture *f, float max) {
  /* The joint's +X is the link's +Y. */
  sbf_quat rotation = sbri_quat_between(sbri_vec3(0, 1, 0), sbri_vec3(1, 0, 0));
  f->limit = (sbri_joint_limit){.before = rotation,
      .after = sbri_quat_conjugate(rotation),
      .twist = {-0.5f, 0.5f},
      .swing_y = {-3.2f, 3.2f},
      .swing_z = {-3.2f, 3.2f},
      .cone = max,
      .active = true};
  for (int i = 1; i + 1 < IK_CHAIN_JOINTS; i++) f->joints[i].limit = &f->limit;
}

float ik_chain_excess(const ik_chain_fixture *f) {
  float worst = 0;
  for (int i = 0; i < IK_CHAIN_JOINTS; i++)
    worst = fmaxf(worst, sbri_joint_limit_excess(f->joints[i].limit, f->joints[i].rotation));
  return worst;
}

static sbf_vec3 end_of(const ik_chain_fixture *f) {
  sbr_transform frames[IK_CHAIN_JOINTS];
  sbri_ik_compute_frames(&f->chain, frames);
  for (int i = 1; i < IK_CHAIN_JOINTS; i++) {
    float length = sbri_length(sbri_sub(frames[i].position, frames[i - 1].position));
    ck_assert_float_eq_tol(length, 1, 1e-5f);
  }
  return frames[IK_CHAIN_JOINTS - 1].position;
}

void ik_expect_reaches(ik_method *solve, float max_passes, int min) {
  uint32_t seed = 5, passes = 0;
  int reached = 0;
  for (int i = 0; i < 200; i++) {
    ik_chain_fixture f;
    ik_chain_bent(&f);
    f.chain.target = ik_random_place(&seed, 9);
    sbri_ik_result r = solve(&f.chain);
    float error = sbri_length(sbri_sub(end_of(&f), f.chain.target));
    ck_assert_float_eq_tol(error, r.error, 1e-5f);
    ck_assert_int_eq(r.reached, error <= 1e-3f);
    reached += r.reached;
    passes += r.iterations;
  }
  ck_assert_int_ge(reached, min);
  ck_assert_float_le((float)passes / 200, max_passes);
}

void ik_expect_keeps_limits(ik_method *solve, int min) {
  uint32_t seed = 11;
  int reached = 0;
  for (int i = 0; i < 200; i++) {
    ik_chain_fixture f;
    ik_chain_bent(&f);
    ik_chain_limit(&f, 0.6f);
    f.chain.target = ik_random_place(&seed, 8);
    if (sbri_length(f.chain.target) < 4) f.chain.target.y += 5; /* closer than the coiled chain can reach */
    reached += solve(&f.chain).reached;
    ck_assert_float_le(ik_chain_excess(&f), 2e-5f);
  }
  ck_assert_int_ge(reached, min);
}

void ik_expect_keeps_hinges(ik_method *solve, int min) {
  static const sbf_vec3 axes[2] = {{1, 0, 0}, {0, 0, 1}}; /* alternately */
  sbri_joint_limit hinges[2];
  uint32_t seed = 13;
  int reached = 0;
  for (int k = 0; k < 2; k++) {
    sbf_quat rotation = sbri_quat_between(axes[k], sbri_vec3(1, 0, 0));
    hinges[k] = (sbri_joint_limit){.before = rotation,
        .after = sbri_quat_conjugate(rotation),
        .twist = {-0.3f, 1.2f},
        .cone = 3.2f,
        .active = true};
  }
  for (int i = 0; i < 200; i++) {
    ik_chain_fixture f;
    ik_chain_straight(&f);
    for (int k = 1; k + 1 < IK_CHAIN_JOINTS; k++) {
      f.joints[k].limit = &hinges[k % 2];
      f.joints[k].rotation = sbri_quat_about(axes[k % 2], 0.2f);
    }
    f.chain.target = ik_random_place(&seed, 8);
    if (sbri_length(f.chain.target) < 4) f.chain.target.y += 5;
    reached += solve(&f.chain).reached;
    ck_assert_float_le(ik_chain_excess(&f), 2e-5f);
    for (int k = 1; k + 1 < IK_CHAIN_JOINTS; k++) {
      sbf_vec3 still = sbri_sub(sbri_rotate(f.joints[k].rotation, axes[k % 2]), axes[k % 2]);
      ck_assert_float_le(sbri_length(still), 1e-4f);
    }
  }
  ck_assert_int_ge(reached, min);
}

void ik_expect_stretches_to(ik_method *solve) {
  uint32_t seed = 17;
  for (int i = 0; i < 50; i++) {
    ik_chain_fixture f;
    ik_chain_bent(&f);
    sbf_vec3 unit = sbri_normalize(ik_random_place(&seed, 1), sbri_vec3(0, 1, 0));
    f.chain.target = sbri_scale(unit, 15);
    sbri_ik_result r = solve(&f.chain);
    ck_assert(!r.reached);
    ck_assert_float_le(r.error, 5.1f);
    ck_assert_float_le(sbri_length(sbri_sub(end_of(&f), sbri_scale(unit, 10))), 1.5f);
    f.chain.soft_reach = 0.1f;
    ik_method *again = solve;
    r = again(&f.chain);
    ck_assert_float_le(sbri_length(end_of(&f)), 10.001f);
  }
}

void ik_expect_bows_to_pole(ik_method *solve) {
  uint32_t seed = 23;
  for (int i = 0; i < 50; i++) {
    ik_chain_fixture f;
    ik_chain_bent(&f);
    f.chain.has_pole = true;
    f.chain.target = ik_random_place(&seed, 8);
    f.chain.pole = ik_random_place(&seed, 20);
    sbri_ik_result r = solve(&f.chain);
    if (!r.reached || sbri_length(f.chain.target) < 1) continue;
    sbr_transform frames[IK_CHAIN_JOINTS];
    sbri_ik_compute_frames(&f.chain, frames);
    sbf_vec3 along = sbri_normalize(f.chain.target, sbri_vec3(0, 1, 0)), bow = {0, 0, 0};
    for (int k = 1; k + 1 < IK_CHAIN_JOINTS; k++) {
      sbf_vec3 p = frames[k].position;
      bow = sbri_add(bow, sbri_add_scaled(p, along, -sbri_dot(p, along)));
    }
    sbf_vec3 pole = sbri_add_scaled(f.chain.pole, along, -sbri_dot(f.chain.pole, along));
    if (sbri_length(bow) < 0.3f || sbri_length(pole) < 0.3f) continue;
    float cosine = sbri_dot(bow, pole) / (sbri_length(bow) * sbri_length(pole));
    ck_assert_float_ge(cosine, 0.99f);
  }
}

void ik_expect_copies_rotation(ik_method *solve) {
  uint32_t seed = 29;
  for (int i = 0; i < 50; i++) {
    ik_chain_fixture f;
    ik_chain_bent(&f);
    f.chain.target = ik_random_place(&seed, 8);
    f.chain.target_rotation = ik_random_rotation(&seed);
    f.chain.copy_rotation = 1;
    sbri_ik_result r = solve(&f.chain);
    sbr_transform frames[IK_CHAIN_JOINTS];
    sbri_ik_compute_frames(&f.chain, frames);
    sbf_quat a = frames[IK_CHAIN_JOINTS - 1].rotation, b = f.chain.target_rotation;
    ck_assert_float_ge(fabsf(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w), 0.99999f);
    ck_assert_float_le(r.error, 1);
  }
}

void ik_expect_survives(ik_method *solve) {
  const sbf_vec3 targets[] = {{0, 0, 0}, {0, 5, 0}, {0, -5, 0}, {0, 10, 0}, {0, 0, 10}, {0, 1e6f, 0}};
  for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
    for (int poled = 0; poled < 2; poled++) {
      ik_chain_fixture f;
      ik_chain_straight(&f);
      f.chain.target = targets[i];
      f.chain.has_pole = poled;
      f.chain.pole = targets[i];
      sbri_ik_result r = solve(&f.chain);
      sbf_vec3 end = end_of(&f);
      ck_assert(isfinite(end.x) && isfinite(end.y) && isfinite(end.z) && isfinite(r.error));
      if (i == 1 || i == 2) ck_assert_float_le(r.error, 1e-2f); /* from a straight chain, along itself */
    }
}

void ik_expect_eases(ik_method *solve, float off) {
  const float reach = 10, soft = 0.1f;
  float last = 0;
  for (int i = 0; i <= 80; i++) {
    float out = 8 + 0.05f * (float)i, eased = sbri_soften_reach(out, reach, soft);
    ik_chain_fixture f;
    ik_chain_bent(&f);
    f.chain.soft_reach = soft;
    f.chain.tolerance = 1e-4f;
    f.chain.iterations = 1000;
    f.chain.target = sbri_scale(sbri_vec3(0.6f, 0.64f, 0.48f), out);
    solve(&f.chain);
    float is = sbri_length(end_of(&f));
    ck_assert_float_eq_tol(is, eased, off);
    if (i == 36) ck_assert_float_le(eased, 9.72f); /* of 9.8 m */
    ck_assert_float_ge(is, last - off);
    if (i > 0) ck_assert_float_le(is - last, 0.05f + off);
    last = is;
  }
  ck_assert_float_eq_tol(last, reach, off);
}
