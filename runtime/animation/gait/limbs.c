/* Limbs: joint limits of legs, and targets of the host for IK chains. */
#include "animation/gait/gait_state.h"
#include "animation/ik/ik.h"

static const uint32_t LEG_PASSES = 24;

/* Joints of a chain in the present pose, from the root bone on; returns 0 if there are too many. */
static uint32_t read_joints(const sbri_rig *rig, int32_t root_bone, int32_t end, const sbr_transform *root,
    const sbr_transform *pose, sbri_ik_joint *joints, uint32_t *bones, sbr_transform *base) {
  uint32_t count = 0;
  for (int32_t b = end; b >= 0 && count < SBRI_IK_MAX_JOINTS; b = rig->bones.parents[b]) {
    bones[count++] = (uint32_t)b;
    if (b == root_bone) break;
  }
  if (bones[count - 1] != (uint32_t)root_bone || count < 2) return 0;
  for (uint32_t i = 0; i < count / 2; i++) {
    uint32_t other = bones[i];
    bones[i] = bones[count - 1 - i], bones[count - 1 - i] = other;
  }
  *base = rig->bones.parents[root_bone] >= 0 ? pose[rig->bones.parents[root_bone]] : *root;
  const sbr_transform *before = base;
  for (uint32_t i = 0; i < count; i++) {
    const sbr_transform *frame = &pose[bones[i]];
    sbf_quat to_parent = sbri_quat_conjugate(before->rotation);
    joints[i] = (sbri_ik_joint){.offset = sbri_rotate(to_parent, sbri_sub(frame->position, before->position)),
        .rotation = sbri_quat_normalize(sbri_quat_multiply(to_parent, frame->rotation)),
        .limit = &rig->bones.limits[bones[i]]};
    before = frame;
  }
  return count;
}

/* Writes the solved joints to the pose; children follow. */
static void write_joints(const sbri_rig *rig, const sbri_ik_chain *chain, const uint32_t *bones, float weight,
    sbr_transform *pose) {
  sbr_transform frames[SBRI_IK_MAX_JOINTS];
  sbri_ik_compute_frames(chain, frames);
  for (uint32_t i = 0; i < chain->count; i++) {
    uint32_t b = bones[i];
    sbf_quat to =
        weight < 1 ? sbri_quat_blend(pose[b].rotation, frames[i].rotation, weight) : frames[i].rotation;
    sbri_rig_rotate_bone(rig, b, sbri_quat_multiply(to, sbri_quat_conjugate(pose[b].rotation)), pose);
  }
}

static bool breaks_limit(const sbri_rig *rig, int32_t bone, const sbr_transform *pose) {
  if (!rig->bones.limits[bone].active || rig->bones.parents[bone] < 0) return false;
  sbf_quat parent = sbri_quat_conjugate(pose[rig->bones.parents[bone]].rotation);
  return !sbri_joint_limit_holds(
      &rig->bones.limits[bone], sbri_quat_multiply(parent, pose[bone].rotation), 1e-4f);
}

void sbri_leg_limit(const sbri_rig *rig, const sbri_leg *leg, sbf_vec3 ankle, sbf_vec3 pole, float scale,
    sbr_transform *pose) {
  const int32_t leg_bones[3] = {leg->upper, leg->lower, leg->foot};
  bool breaks = false;
  for (int i = 0; i < 3; i++) breaks = breaks || breaks_limit(rig, leg_bones[i], pose);
  if (!breaks) return;
  sbri_ik_joint joints[SBRI_IK_MAX_JOINTS];
  uint32_t bones[SBRI_IK_MAX_JOINTS];
  sbri_ik_chain chain = {.joints = joints,
      .target = ankle,
      .target_rotation = pose[leg->foot].rotation,
      .copy_rotation = 1,
      .has_pole = true,
      .pole = pole,
      .tolerance = 2e-4f * (leg->length.upper + leg->length.lower) * scale,
      .iterations = LEG_PASSES};
  const sbr_transform none = {{0, 0, 0}, {0, 0, 0, 1}};
  chain.count = read_joints(rig, leg->upper, leg->foot, &none, pose, joints, bones, &chain.base);
  if (chain.count == 0) return;
  sbri_ccd(&chain);
  if (!leg->is_last) {
    write_joints(rig, &chain, bones, 1, pose);
    return;
  }
  sbr_transform
      frames[SBRI_IK_MAX_JOINTS]; /* first and last bones of the chain; bones between are posed later */
  sbri_ik_compute_frames(&chain, frames);
  for (uint32_t i = 0; i < chain.count; i++) pose[bones[i]] = frames[i];
}

static void read_comforts(const sbri_rig *rig, const sbf_ik_chain *source, sbri_ik_joint *joints,
    const uint32_t *bones, uint32_t count) {
  for (uint32_t c = 0; c < source->comforts.count; c++)
    for (uint32_t i = 0; i < count; i++) {
      const sbf_comfort *comfort = &source->comforts.at[c];
      if (bones[i] != (uint32_t)comfort->bone) continue;
      joints[i].comfort = sbri_quat_multiply(
          sbri_quat_normalize(comfort->rotation), rig->bones.rest_local[bones[i]].rotation);
      joints[i].comfort_weight = comfort->weight;
      joints[i].comfort_slack = sbri_sub(sbri_vec3(1, 1, 1), comfort->axes);
    }
}

/* Pole of the chain, moved with its bone. */
static sbf_vec3 pole_position(const sbri_rig *rig, const sbf_ik_chain *source, const sbr_transform *root,
    float scale, const sbr_transform *pose) {
  int32_t bone = source->pole_bone >= 0 ? source->pole_bone : rig->bones.parents[source->root];
  sbr_transform rest = {{0, 0, 0}, {0, 0, 0, 1}};
  if (bone >= 0) rest = rig->bones.rest[bone];
  const sbr_transform *now = bone >= 0 ? &pose[bone] : root;
  sbf_vec3 local = sbri_rotate(sbri_quat_conjugate(rest.rotation), sbri_sub(source->pole, rest.position));
  return sbri_add(now->position, sbri_rotate(now->rotation, sbri_scale(local, scale)));
}

static void reach(const sbri_rig *rig, uint32_t index, const sbri_limb_target *target, float scale,
    const sbr_transform *root, sbr_transform *pose) {
  const sbf_ik_chain *source = &rig->asset->ik_chains.at[index];
  sbri_ik_joint joints[SBRI_IK_MAX_JOINTS];
  uint32_t bones[SBRI_IK_MAX_JOINTS];
  sbri_ik_chain chain = {.joints = joints,
      .target = target->position,
      .target_rotation = target->rotation,
      .copy_rotation = source->copy_rotation,
      .has_pole = source->has_pole,
      .soft_reach = source->soft_reach,
      .tolerance = source->tolerance * scale,
      .iterations = source->iterations};
  chain.count = read_joints(rig, source->root, source->end, root, pose, joints, bones, &chain.base);
  if (chain.count == 0) return;
  if (source->has_pole) chain.pole = pole_position(rig, source, root, scale, pose);
  read_comforts(rig, source, joints, bones, chain.count);
  sbri_ik_solve(source->solver, &chain);
  write_joints(rig, &chain, bones, target->weight, pose);
}

/* ---- Chains with a common root and solver `fabrik`, solved as a tree ---- */

typedef struct limb_tree {
  sbri_ik_joint joints[SBRI_IK_MAX_JOINTS];
  uint32_t bones[SBRI_IK_MAX_JOINTS], parents[SBRI_IK_MAX_JOINTS], count;
  sbri_ik_goal goals[SBRI_IK_MAX_JOINTS];
  uint32_t goal_count;
} limb_tree;

static bool joins_tree(const sbri_rig *rig, const sbri_limb_target *targets, uint32_t index, int32_t root) {
  const sbf_ik_chain *chain = &rig->asset->ik_chains.at[index];
  return targets[index].weight > 0 && chain->solver == SBF_IK_SOLVER_FABRIK && chain->root == root;
}

static uint32_t find_in_tree(const limb_tree *tree, uint32_t bone) {
  uint32_t i = 0;
  while (i < tree->count && tree->bones[i] != bone) i++;
  return i;
}

static bool add_to_tree(
    limb_tree *tree, const sbri_ik_joint *joints, const uint32_t *bones, uint32_t count, sbf_vec3 target) {
  for (uint32_t i = 0; i < count; i++) {
    if (find_in_tree(tree, bones[i]) < tree->count) continue;
    if (tree->count == SBRI_IK_MAX_JOINTS) return false;
    tree->parents[tree->count] = i ? find_in_tree(tree, bones[i - 1]) : 0;
    tree->joints[tree->count] = joints[i];
    tree->bones[tree->count++] = bones[i];
  }
  tree->goals[tree->goal_count++] = (sbri_ik_goal){find_in_tree(tree, bones[count - 1]), target};
  return true;
}

/* Solves them as a tree; returns false if the chain at `first` is the only one of its root. */
static bool reach_as_tree(const sbri_rig *rig, const sbri_limb_target *targets, uint32_t first, float scale,
    const sbr_transform *root, sbr_transform *pose) {
  const sbf_ik_chain *source = &rig->asset->ik_chains.at[first];
  limb_tree tree = {.count = 0};
  sbri_ik_joint joints[SBRI_IK_MAX_JOINTS];
  uint32_t bones[SBRI_IK_MAX_JOINTS];
  sbr_transform base = *root;
  for (uint32_t i = first; i < rig->asset->ik_chains.count; i++) {
    if (!joins_tree(rig, targets, i, source->root)) continue;
    const sbf_ik_chain *one = &rig->asset->ik_chains.at[i];
    uint32_t count = read_joints(rig, one->root, one->end, root, pose, joints, bones, &base);
    if (count) read_comforts(rig, one, joints, bones, count);
    if (count && !add_to_tree(&tree, joints, bones, count, targets[i].position)) return false;
  }
  if (tree.goal_count < 2) return false;
  sbri_ik_tree problem = {.base = base,
      .joints = tree.joints,
      .parents = tree.parents,
      .count = tree.count,
      .goals = tree.goals,
      .goal_count = tree.goal_count,
      .tolerance = source->tolerance * scale,
      .iterations = source->iterations};
  sbri_fabrik_tree(&problem);
  for (uint32_t i = 0; i < tree.count; i++) {
    uint32_t b = tree.bones[i];
    const sbr_transform *before = i ? &pose[tree.bones[tree.parents[i]]] : &base;
    sbf_quat to = sbri_quat_normalize(sbri_quat_multiply(before->rotation, tree.joints[i].rotation));
    sbri_rig_rotate_bone(rig, b, sbri_quat_multiply(to, sbri_quat_conjugate(pose[b].rotation)), pose);
  }
  return true;
}

void sbri_limbs_reach(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose) {
  const sbri_limb_target *targets = sbri_limb_targets(rig, state);
  for (uint32_t i = 0; i < rig->asset->ik_chains.count; i++) {
    const sbf_ik_chain *chain = &rig->asset->ik_chains.at[i];
    bool done = false;
    if (!(targets[i].weight > 0)) continue;
    for (uint32_t k = 0; k < i; k++) done = done || joins_tree(rig, targets, k, chain->root);
    if (done && chain->solver == SBF_IK_SOLVER_FABRIK) continue; /* solved with the first chain of its tree */
    bool tree =
        chain->solver == SBF_IK_SOLVER_FABRIK && reach_as_tree(rig, targets, i, input->scale, root, pose);
    if (!tree) reach(rig, i, &targets[i], input->scale, root, pose);
  }
}
