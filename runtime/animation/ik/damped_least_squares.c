/* Damped least squares. Every joint rotates about any axis, so the Jacobian of the end's position consists,
 * joint by joint, of the cross product with the arm to the end. Its square is a sum of 3 x 3 blocks, and the
 * system has three rows, or six with the end's rotation, however long the chain is. */
#include <string.h>

#include "animation/ik/ik.h"

static const float MAX_STEP = 0.5f; /* fraction of the reach: maximum displacement of the end per iteration */
static const float MAX_TURN = 0.8f; /* rad: maximum rotation of a joint per iteration */
static const float MIN_DAMPING = 1e-5f; /* fraction of the reach, squared */

typedef struct system {
  double a[6][6], b[6];
  int size;
} system;

/* Cholesky; the matrix is symmetric and, because of the damping, positive definite. */
static void solve_system(system *s, float *x) {
  int n = s->size;
  for (int i = 0; i < n; i++) {
    for (int j = 0; j <= i; j++) {
      double sum = s->a[i][j];
      for (int k = 0; k < j; k++) sum -= s->a[i][k] * s->a[j][k];
      if (i == j)
        s->a[i][i] = sqrt(sum > 1e-30 ? sum : 1e-30);
      else
        s->a[i][j] = sum / s->a[j][j];
    }
  }
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < i; k++) s->b[i] -= s->a[i][k] * s->b[k];
    s->b[i] /= s->a[i][i];
  }
  for (int i = n; i-- > 0;) {
    for (int k = i + 1; k < n; k++) s->b[i] -= s->a[k][i] * s->b[k];
    s->b[i] /= s->a[i][i];
    x[i] = (float)s->b[i];
  }
}

static void add_joint(system *s, sbf_vec3 r, double unit) {
  double square = (double)sbri_dot(r, r), v[3] = {(double)r.x, (double)r.y, (double)r.z};
  const double cross[3][3] = {{0, v[2], -v[1]}, {-v[2], 0, v[0]}, {v[1], -v[0], 0}}; /* -[r]x */
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) s->a[i][k] += (i == k ? square : 0) - v[i] * v[k];
  if (s->size == 3) return;
  for (int i = 0; i < 3; i++) {
    s->a[3 + i][3 + i] += unit * unit;
    for (int k = 0; k < 3; k++) {
      s->a[i][3 + k] += unit * cross[i][k];
      s->a[3 + k][i] += unit * cross[i][k];
    }
  }
}

static sbf_vec3 cut(sbf_vec3 v, float max) {
  float size = sbri_length(v);
  return size > max ? sbri_scale(v, max / size) : v;
}

/* Rotation vector by a joint's comfort in this iteration, in world axes. */
static sbf_vec3 comfort_of(const sbri_ik_chain *chain, uint32_t i, const sbr_transform *frames) {
  const sbri_ik_joint *joint = &chain->joints[i];
  if (joint->comfort_weight <= 0) return sbri_vec3(0, 0, 0);
  sbf_quat before = i ? frames[i - 1].rotation : chain->base.rotation;
  sbf_quat wanted = sbri_quat_multiply(before, joint->comfort);
  sbf_quat rotation = sbri_quat_multiply(wanted, sbri_quat_conjugate(frames[i].rotation));
  sbf_vec3 asked = sbri_quat_log(rotation);
  if (!sbri_ik_comfort_is_even(joint)) {
    sbf_quat own = frames[i].rotation;
    asked = sbri_rotate(own, sbri_ik_comfort_fraction(joint, sbri_rotate(sbri_quat_conjugate(own), asked)));
  }
  return sbri_scale(asked, 0.5f * joint->comfort_weight);
}

/* One iteration; `reach` makes angles and lengths comparable. */
static void pass(sbri_ik_chain *chain, sbf_vec3 target, float reach, const sbr_transform *frames) {
  uint32_t n = chain->count;
  bool turns = chain->copy_rotation > 0;
  float unit = 0.5f * reach;
  sbf_vec3 end = frames[n - 1].position, off = cut(sbri_sub(target, end), MAX_STEP * reach);
  sbf_vec3 asks[SBRI_IK_MAX_JOINTS], drift = {0, 0, 0}, angular_velocity = {0, 0, 0}, turn_off = {0, 0, 0};
  system s;
  memset(&s, 0, sizeof s);
  s.size = turns ? 6 : 3;
  for (uint32_t i = 0; i < n; i++) {
    sbf_vec3 r = sbri_sub(end, frames[i].position);
    add_joint(&s, r, (double)unit);
    asks[i] = comfort_of(chain, i, frames);
    drift = sbri_add(drift, sbri_cross(asks[i], r));
    angular_velocity = sbri_add(angular_velocity, asks[i]);
  }
  if (turns) {
    sbf_quat rotation =
        sbri_quat_multiply(chain->target_rotation, sbri_quat_conjugate(frames[n - 1].rotation));
    turn_off = sbri_scale(sbri_quat_log(rotation), chain->copy_rotation);
    turn_off = sbri_scale(cut(sbri_sub(turn_off, angular_velocity), 1), unit);
  }
  sbf_vec3 move = sbri_sub(off, drift);
  const float b[6] = {move.x, move.y, move.z, turn_off.x, turn_off.y, turn_off.z};
  double square = 0;
  for (int i = 0; i < s.size; i++) s.b[i] = (double)b[i], square += s.b[i] * s.b[i];
  double damping = 0.02 * square + (double)(MIN_DAMPING * reach * reach);
  for (int i = 0; i < s.size; i++) s.a[i][i] += damping;
  float y[6] = {0};
  solve_system(&s, y);
  sbf_vec3 push = {y[0], y[1], y[2]}, twist = sbri_scale(sbri_vec3(y[3], y[4], y[5]), unit);
  /* From the end on: a rotation does not change the frames before it. Later frames inherit rotations, so each
   * joint's own part is its whole rotation. */
  for (uint32_t i = n; i-- > 0;) {
    sbf_vec3 r = sbri_sub(end, frames[i].position);
    sbf_vec3 turn = sbri_add(asks[i], sbri_cross(r, push));
    if (turns) turn = sbri_add(turn, twist);
    sbri_ik_rotate_bone(chain, i, sbri_quat_exp(cut(turn, MAX_TURN)), frames);
  }
}

static bool rotation_reached(const sbri_ik_chain *chain, const sbr_transform *frames) {
  if (chain->copy_rotation < 1) return true;
  sbf_quat back = sbri_quat_conjugate(frames[chain->count - 1].rotation);
  return sbri_length(sbri_quat_log(sbri_quat_multiply(chain->target_rotation, back))) < 1e-3f;
}

sbri_ik_result sbri_damped_least_squares(sbri_ik_chain *chain) {
  sbr_transform frames[SBRI_IK_MAX_JOINTS];
  sbf_vec3 target = sbri_ik_begin(chain, frames);
  float reach = sbri_ik_reach(chain);
  uint32_t passes = 0, last = chain->count - 1;
  /* A target out of reach is moved to full length: with a farther one the chain would oscillate. */
  sbf_vec3 far = target, root = frames[0].position, away = sbri_sub(target, root);
  if (sbri_length(away) > reach) target = sbri_add_scaled(root, away, reach / sbri_length(away));
  while (passes < chain->iterations && reach > 0) {
    sbf_vec3 before = frames[last].position;
    bool there = sbri_length(sbri_sub(before, target)) <= chain->tolerance;
    if (there && rotation_reached(chain, frames)) break;
    pass(chain, target, reach, frames);
    sbri_ik_compute_frames(chain, frames);
    passes++;
    if (there || sbri_length(sbri_sub(frames[last].position, before)) >= 0.001f * chain->tolerance) continue;
    break;
  }
  return sbri_ik_finish(chain, far, frames, passes);
}
