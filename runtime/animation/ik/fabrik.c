/* FABRIK on a tree of joints; a chain is a tree without branches.
 *
 * The backward pass moves positions only. The forward pass rotates the joints towards these positions, from
 * the root on, and so keeps lengths, limits and minimum twist. */
#include "animation/ik/ik.h"

enum { PATIENCE = 16 }; /* iterations */

typedef struct point_set {
  sbf_vec3 at[SBRI_IK_MAX_JOINTS];   /* positions after the backward pass */
  sbf_vec3 sums[SBRI_IK_MAX_JOINTS]; /* of the positions that the children require */
  float counts[SBRI_IK_MAX_JOINTS];  /* number of these; 0: no goal below */
  float lengths[SBRI_IK_MAX_JOINTS]; /* to the parent */
  sbr_transform frames[SBRI_IK_MAX_JOINTS];
} point_set;

static void find_frames(const sbri_ik_tree *tree, point_set *p) {
  for (uint32_t i = 0; i < tree->count; i++) {
    const sbr_transform *before = i ? &p->frames[tree->parents[i]] : &tree->base;
    const sbri_ik_joint *joint = &tree->joints[i];
    p->frames[i].position = sbri_add(before->position, sbri_rotate(before->rotation, joint->offset));
    p->frames[i].rotation = sbri_quat_normalize(sbri_quat_multiply(before->rotation, joint->rotation));
  }
}

static void backward(const sbri_ik_tree *tree, point_set *p) {
  for (uint32_t i = 0; i < tree->count; i++) p->sums[i] = sbri_vec3(0, 0, 0), p->counts[i] = 0;
  for (uint32_t g = 0; g < tree->goal_count; g++) {
    uint32_t joint = tree->goals[g].joint;
    p->sums[joint] = sbri_add(p->sums[joint], tree->goals[g].position);
    p->counts[joint] += 1;
  }
  for (uint32_t i = tree->count; i-- > 0;) {
    p->at[i] = p->frames[i].position;
    if (p->counts[i] == 0) continue;
    p->at[i] = sbri_scale(p->sums[i], 1 / p->counts[i]);
    if (i == 0) break;
    uint32_t parent = tree->parents[i];
    sbf_vec3 is = sbri_sub(p->frames[parent].position, p->frames[i].position);
    sbf_vec3 towards = sbri_normalize(sbri_sub(p->frames[parent].position, p->at[i]), sbri_normalize(is, is));
    p->sums[parent] = sbri_add(p->sums[parent], sbri_add_scaled(p->at[i], towards, p->lengths[i]));
    p->counts[parent] += 1;
  }
}

/* Rotation that moves a joint's children closest to their targets: the sum of their arms to the sum of the
 * targets, then about that line for the arm farthest from it. */
static sbf_quat rotation_of(const sbri_ik_tree *tree, const point_set *p, uint32_t joint) {
  sbf_vec3 is = {0, 0, 0}, wanted = {0, 0, 0}, side_is = {0, 0, 0}, side_wanted = {0, 0, 0};
  const sbr_transform *frame = &p->frames[joint];
  uint32_t children = 0;
  for (uint32_t i = joint + 1; i < tree->count; i++) {
    if (tree->parents[i] != joint || p->counts[i] == 0 || p->lengths[i] <= 0) continue;
    is = sbri_add(is, sbri_rotate(frame->rotation, tree->joints[i].offset));
    sbf_vec3 to = sbri_sub(p->at[i], frame->position);
    wanted = sbri_add(wanted, sbri_scale(sbri_normalize(to, to), p->lengths[i]));
    children++;
  }
  if (children == 0) return sbri_quat_identity();
  sbf_vec3 from_unit = sbri_normalize(is, sbri_vec3(0, 1, 0)), to_unit = sbri_normalize(wanted, from_unit);
  sbf_quat rotation = sbri_quat_between(from_unit, to_unit);
  if (children == 1) return rotation;
  float farthest = 0;
  for (uint32_t i = joint + 1; i < tree->count; i++) {
    if (tree->parents[i] != joint || p->counts[i] == 0) continue;
    sbf_vec3 arm = sbri_rotate(rotation, sbri_rotate(frame->rotation, tree->joints[i].offset));
    sbf_vec3 off = sbri_add_scaled(arm, to_unit, -sbri_dot(arm, to_unit));
    if (sbri_length(off) <= farthest) continue;
    farthest = sbri_length(off);
    sbf_vec3 to = sbri_sub(p->at[i], frame->position);
    side_is = off, side_wanted = sbri_add_scaled(to, to_unit, -sbri_dot(to, to_unit));
  }
  float angle =
      sbri_atan2(sbri_dot(to_unit, sbri_cross(side_is, side_wanted)), sbri_dot(side_is, side_wanted));
  return sbri_quat_multiply(sbri_quat_about(to_unit, angle), rotation);
}

/* Returns whether limits allow every joint to reach its position of the backward pass. */
static bool forward(sbri_ik_tree *tree, point_set *p) {
  bool free = true;
  for (uint32_t i = 0; i < tree->count; i++) {
    const sbr_transform *before = i ? &p->frames[tree->parents[i]] : &tree->base;
    sbri_ik_joint *joint = &tree->joints[i];
    p->frames[i].position = sbri_add(before->position, sbri_rotate(before->rotation, joint->offset));
    p->frames[i].rotation = sbri_quat_normalize(sbri_quat_multiply(before->rotation, joint->rotation));
    sbf_quat world = sbri_quat_multiply(rotation_of(tree, p, i), p->frames[i].rotation);
    sbf_quat local = sbri_quat_normalize(sbri_quat_multiply(sbri_quat_conjugate(before->rotation), world));
    joint->rotation = sbri_joint_limit_clamp(joint->limit, local);
    free = free && joint->rotation.x == local.x && joint->rotation.y == local.y &&
           joint->rotation.z == local.z && joint->rotation.w == local.w;
    p->frames[i].rotation = sbri_quat_normalize(sbri_quat_multiply(before->rotation, joint->rotation));
  }
  return free;
}

static float worst_error(const sbri_ik_tree *tree, const point_set *p) {
  float worst = 0;
  for (uint32_t g = 0; g < tree->goal_count; g++) {
    sbf_vec3 off = sbri_sub(p->frames[tree->goals[g].joint].position, tree->goals[g].position);
    float error = sbri_length(off);
    worst = error > worst ? error : worst;
  }
  return worst;
}

/* A single goal beyond the chain's full length: all joints are on the line to it, in one iteration. */
static bool stretch_out(sbri_ik_tree *tree, point_set *p, bool *free) {
  if (tree->goal_count != 1) return false;
  uint32_t end = tree->goals[0].joint;
  sbf_vec3 root = p->frames[0].position, to = sbri_sub(tree->goals[0].position, root);
  float reach = 0, at = 0;
  for (uint32_t i = end; i != 0; i = tree->parents[i]) reach += p->lengths[i];
  if (sbri_length(to) < reach) return false;
  sbf_vec3 along = sbri_normalize(to, sbri_vec3(0, 1, 0));
  for (uint32_t i = 0; i < tree->count; i++) p->counts[i] = 0;
  for (uint32_t i = end; i != 0; i = tree->parents[i]) {
    p->counts[i] = 1;
    p->at[i] = sbri_add_scaled(root, along, reach - at);
    at += p->lengths[i];
  }
  *free = forward(tree, p);
  return true;
}

/* A chain without limits needs no rotations before it converges: positions only. */
static bool is_free_chain(const sbri_ik_tree *tree) {
  if (tree->goal_count != 1 || tree->goals[0].joint != tree->count - 1) return false;
  for (uint32_t i = 1; i < tree->count; i++)
    if (tree->parents[i] != i - 1) return false;
  for (uint32_t i = 0; i + 1 < tree->count; i++)
    if (tree->joints[i].limit && tree->joints[i].limit->active) return false;
  return true;
}

static sbf_vec3 at_length(sbf_vec3 from, sbf_vec3 towards, float length) {
  sbf_vec3 displacement = sbri_sub(towards, from);
  return sbri_add_scaled(from, sbri_normalize(displacement, sbri_vec3(0, 1, 0)), length);
}

static uint32_t solve_positions(sbri_ik_tree *tree, point_set *p) {
  uint32_t passes = 0, last = tree->count - 1;
  sbf_vec3 target = tree->goals[0].position, root = p->frames[0].position;
  for (uint32_t i = 0; i <= last; i++) p->at[i] = p->frames[i].position, p->counts[i] = 1;
  float error = sbri_length(sbri_sub(p->at[last], target));
  while (passes < tree->iterations && error > tree->tolerance) {
    p->at[last] = target;
    for (uint32_t i = last; i-- > 0;) p->at[i] = at_length(p->at[i + 1], p->at[i], p->lengths[i + 1]);
    p->at[0] = root;
    for (uint32_t i = 1; i <= last; i++) p->at[i] = at_length(p->at[i - 1], p->at[i], p->lengths[i]);
    passes++;
    float before = error;
    error = sbri_length(sbri_sub(p->at[last], target));
    if (fabsf(error - before) < 1e-3f * tree->tolerance) break;
  }
  forward(tree, p);
  return passes;
}

/* With `patience` above 0 it stops if as many iterations do not reduce the error by a fifth. */
static uint32_t solve(sbri_ik_tree *tree, point_set *p, uint32_t patience) {
  uint32_t passes = 0;
  bool free = true;
  for (uint32_t i = 0; i < tree->count; i++) p->lengths[i] = sbri_length(tree->joints[i].offset);
  find_frames(tree, p);
  float error = worst_error(tree, p);
  if (error > tree->tolerance && stretch_out(tree, p, &free)) {
    passes = 1;
    if (free) return passes;
    error = worst_error(tree, p);
  } else if (is_free_chain(tree)) {
    return solve_positions(tree, p);
  }
  float mark = error;
  while (passes < tree->iterations && error > tree->tolerance) {
    backward(tree, p);
    forward(tree, p);
    passes++;
    float before = error;
    error = worst_error(tree, p);
    if (patience && passes % patience == 0) {
      if (error > 0.8f * mark) break;
      mark = error;
    }
    if (fabsf(error - before) < 1e-3f * tree->tolerance) break; /* no improvement */
  }
  return passes;
}

sbri_ik_result sbri_fabrik_tree(sbri_ik_tree *tree) {
  point_set p;
  for (uint32_t i = 0; i < tree->count; i++)
    tree->joints[i].rotation = sbri_joint_limit_clamp(tree->joints[i].limit, tree->joints[i].rotation);
  uint32_t passes = solve(tree, &p, 0);
  float error = worst_error(tree, &p);
  return (sbri_ik_result){passes, error, error <= tree->tolerance};
}

static bool is_limited(const sbri_ik_chain *chain) {
  bool limited = false;
  for (uint32_t i = 0; i < chain->count; i++)
    limited = limited || (chain->joints[i].limit && chain->joints[i].limit->active);
  return limited;
}

static void copy_rotations(const sbri_ik_chain *chain, sbf_quat *rotations) {
  for (uint32_t i = 0; i < chain->count; i++) rotations[i] = chain->joints[i].rotation;
}

static void restore_rotations(const sbf_quat *rotations, sbri_ik_chain *chain) {
  for (uint32_t i = 0; i < chain->count; i++) chain->joints[i].rotation = rotations[i];
}

/* Limits may stop the chain in a local minimum, above all with hinges: positions do not help joints that
 * rotate about one axis only. The remaining iterations rotate the joints to move the end, one by one from
 * their initial rotations; the better result is kept. */
static sbri_ik_result out_of_corner(sbri_ik_chain *chain, const sbf_quat *began_with, sbri_ik_result so_far) {
  sbf_quat kept[SBRI_IK_MAX_JOINTS];
  sbri_ik_chain rest = *chain;
  rest.iterations = chain->iterations - so_far.iterations;
  copy_rotations(chain, kept);
  restore_rotations(began_with, chain);
  sbri_ik_result then = sbri_ccd(&rest);
  then.iterations += so_far.iterations;
  if (then.error <= so_far.error) return then;
  restore_rotations(kept, chain);
  so_far.iterations = then.iterations;
  return so_far;
}

sbri_ik_result sbri_fabrik(sbri_ik_chain *chain) {
  point_set p;
  uint32_t parents[SBRI_IK_MAX_JOINTS];
  sbf_quat began_with[SBRI_IK_MAX_JOINTS];
  copy_rotations(chain, began_with);
  sbf_vec3 target = sbri_ik_begin(chain, p.frames);
  sbri_ik_goal goal = {chain->count - 1, target};
  for (uint32_t i = 0; i < chain->count; i++) parents[i] = i ? i - 1 : 0;
  sbri_ik_tree tree = {.base = chain->base,
      .joints = chain->joints,
      .parents = parents,
      .count = chain->count,
      .goals = &goal,
      .goal_count = 1,
      .tolerance = chain->tolerance,
      .iterations = chain->iterations};
  uint32_t passes = solve(&tree, &p, is_limited(chain) ? PATIENCE : 0);
  sbri_ik_result result = sbri_ik_finish(chain, target, p.frames, passes);
  bool near = sbri_length(sbri_sub(target, p.frames[0].position)) < sbri_ik_reach(chain);
  if (result.reached || !near || passes >= chain->iterations || !is_limited(chain)) return result;
  return out_of_corner(chain, began_with, result);
}
