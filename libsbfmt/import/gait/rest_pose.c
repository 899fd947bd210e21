/* Proposes poses of a gait. */
#include "import/gait/rest_pose.h"

#include <math.h>
#include <string.h>

#include "motion/retargeting.h"

static const double STILL = 2e-3; /* rad; a bone that rotates less needs no key */

/* Poses of a walk: lengths and speeds in leg lengths, angles of an arm forward and back in radians. Bipeds
 * of the runtime's gait take such steps at these speeds. */
typedef struct arm_swing {
  const char *passing, *reaching;
  double speed, step, shoulder, elbow;
} arm_swing;

static const arm_swing swings[] = {{"arms passing slowly", "arm swing slow", 0.2, 0.125, 0.16, 0.08},
    {"arms passing", "arm swing", 1, 0.425, 0.32, 0.15}};

enum { SWINGS = sizeof swings / sizeof *swings };

/* Bones that keep their own pose: legs, which the gait poses, and the bones that carry them. */
static bool *find_excluded_bones(sbfi_conversion *c, const sbf_gait *gait) {
  const sbf_asset *a = c->asset;
  bool *alone = sbfi_arena_allocate(&c->scratch, a->bones.count, sizeof *alone);
  const sbfi_gait_draft d = {.asset = c->asset};
  if (!alone) return NULL;
  for (uint32_t l = 0; l < gait->legs.count; l++) {
    int32_t root = a->ik_chains.at[gait->legs.at[l].ik].root;
    for (uint32_t i = 0; i < a->bones.count; i++)
      if (sbfi_draft_is_below(&d, (int32_t)i, root) || sbfi_draft_is_below(&d, root, (int32_t)i))
        alone[i] = true;
  }
  for (int32_t bone = gait->body; bone != SBF_NONE; bone = a->bones.at[bone].parent) alone[bone] = true;
  return alone;
}

static double turned_by(const double q[4]) {
  return 2 * acos(fmin(1, fabs(q[3])));
}

/* Writes keys of the bones that rotate; false if memory runs out. */
static bool write_pose(sbfi_conversion *c, const char *name, const double (*rotations)[4],
    const bool *is_rotated, sbf_pose *pose) {
  uint32_t count = 0;
  sbf_pose_key *keys = sbfi_convert_allocate(c, c->asset->bones.count, sizeof *keys);
  sbf_pose_init(pose);
  pose->name = name;
  pose->id = sbfi_new_id(c, "pose", name);
  if (!keys || !pose->id) return false;
  for (uint32_t i = 0; i < c->asset->bones.count; i++) {
    if (!is_rotated[i]) continue;
    sbf_pose_key_init(&keys[count]);
    keys[count].bone = (int32_t)i;
    keys[count++].rotation = (sbf_quat){
        (float)rotations[i][0], (float)rotations[i][1], (float)rotations[i][2], (float)rotations[i][3]};
  }
  pose->keys = (sbf_pose_key_list){count ? keys : NULL, count};
  return true;
}

static void key_of(const double rest[4], const double posed[4], double key[4]) {
  double undo[4];
  sbfi_quatd_conjugate(rest, undo);
  sbfi_quatd_multiply(undo, posed, key);
}

/* Reads the first frame of a clip as rotations from rest. */
static bool use_clip(sbfi_conversion *c, const sbf_clip *clip, const bool *alone, double (*rotations)[4],
    bool *is_rotated, bool *any) {
  const sbf_asset *a = c->asset;
  sbfi_clip_poses poses;
  sbfi_bone_frame *frames = sbfi_arena_allocate(&c->scratch, a->bones.count, sizeof *frames);
  if (!frames || !sbfi_clip_poses_init(&poses, a, clip, &c->scratch)) return false;
  sbfi_clip_pose(&poses, 0, frames);
  for (uint32_t i = 0; i < a->bones.count; i++) {
    int32_t parent = a->bones.at[i].parent;
    double local[4], key[4];
    if (alone[i] || parent == SBF_NONE) continue;
    key_of(frames[parent].rotation, frames[i].rotation, local);
    key_of(poses.rest_local[i].rotation, local, key);
    if (turned_by(key) < STILL) continue;
    memcpy(rotations[i], key, sizeof key);
    is_rotated[i] = *any = true;
  }
  return true;
}

/* Converts rotations in asset space, relative to the parent's, to rotations from rest in the bone's own
 * frame. */
static void convert_to_bone_frames(const sbf_asset *a, const bool *is_rotated, double (*rotations)[4]) {
  for (uint32_t i = 0; i < a->bones.count; i++) {
    const sbf_quat q = a->bones.at[i].rotation;
    const double rest[4] = {(double)q.x, (double)q.y, (double)q.z, (double)q.w};
    double undo[4];
    if (!is_rotated[i]) continue;
    sbfi_quatd_conjugate(rest, undo);
    sbfi_quatd_multiply(undo, rotations[i], rotations[i]);
    sbfi_quatd_multiply(rotations[i], rest, rotations[i]);
  }
}

static const sbf_clip *find_idle(const sbf_asset *a) {
  const sbf_clip *best = NULL;
  size_t shortest = 0;
  for (uint32_t i = 0; i < a->clips.count; i++) {
    size_t length = strlen(a->clips.at[i].name); /* prefers Idle over Idle_Bored */
    if (!sbfi_clip_is_idle(a->clips.at[i].name) || (best && length >= shortest)) continue;
    best = &a->clips.at[i];
    shortest = length;
  }
  return best;
}

typedef struct pose_work {
  double (*rotations)[4];
  bool *is_rotated;
} pose_work;

static bool start(sbfi_conversion *c, pose_work *w) {
  w->rotations = sbfi_arena_allocate(&c->scratch, c->asset->bones.count, sizeof *w->rotations);
  w->is_rotated = sbfi_arena_allocate(&c->scratch, c->asset->bones.count, sizeof *w->is_rotated);
  return w->rotations && w->is_rotated;
}

/* Rotation of a bone's frame in asset space in the pose. */
static void posed_rotation(const sbf_asset *a, const pose_work *pose, int32_t bone, double to[4]) {
  const sbf_quat q = a->bones.at[bone].rotation;
  const double rest[4] = {(double)q.x, (double)q.y, (double)q.z, (double)q.w};
  int32_t parent = a->bones.at[bone].parent;
  memcpy(to, rest, sizeof rest);
  if (parent != SBF_NONE) {
    const sbf_quat p = a->bones.at[parent].rotation;
    const double parent_rest[4] = {(double)p.x, (double)p.y, (double)p.z, (double)p.w};
    double above[4], local[4];
    posed_rotation(a, pose, parent, above);
    key_of(parent_rest, rest, local);
    sbfi_quatd_multiply(above, local, to);
  }
  if (pose->is_rotated[bone]) sbfi_quatd_multiply(to, pose->rotations[bone], to);
}

static void swing(const sbf_asset *a, const pose_work *rest, int32_t bone, double angle, pose_work *to) {
  double posed[4], undo[4];
  if (bone == SBF_NONE) return;
  const double about[4] = {-sin(angle / 2), 0, 0, cos(angle / 2)}; /* moves a hanging bone forward */
  posed_rotation(a, rest, bone, posed);
  sbfi_quatd_conjugate(posed, undo);
  sbfi_quatd_multiply(undo, about, to->rotations[bone]);
  sbfi_quatd_multiply(to->rotations[bone], posed, to->rotations[bone]);
  to->is_rotated[bone] = true;
}

/* Length of the shortest leg, m: sum of the distances between the heads of its bones. */
static double leg_length(const sbf_asset *a, const sbf_gait *gait) {
  const sbfi_gait_draft d = {.asset = (sbf_asset *)(uintptr_t)a}; /* not modified here */
  double shortest = INFINITY;
  for (uint32_t l = 0; l < gait->legs.count; l++) {
    const sbf_ik_chain *chain = &a->ik_chains.at[gait->legs.at[l].ik];
    double length = 0;
    for (int32_t bone = chain->end; bone != chain->root; bone = a->bones.at[bone].parent)
      length += sbfi_draft_distance(&d, bone, a->bones.at[bone].parent);
    shortest = fmin(shortest, length);
  }
  return shortest;
}

/* Writes two poses of each walk, for the middle and the end of a half cycle. When the opposite leg lands,
 * the arm on the first leg's side is in front. */
static bool write_swings(sbfi_conversion *c, const sbf_gait *gait, const sbfi_arm_draft *arms, uint32_t count,
    const pose_work *rest, sbf_pose *poses) {
  const sbf_asset *a = c->asset;
  double first_side = (double)gait->legs.at[0].home.x, leg = leg_length(a, gait);
  for (int k = 0; k < 2 * SWINGS; k++) {
    const arm_swing *of = &swings[k / 2];
    bool reaches = k % 2;
    pose_work w;
    if (!start(c, &w)) return false;
    for (uint32_t i = 0; i < count; i++) {
      double ahead = !reaches ? 0 : arms[i].side * first_side > 0 ? 1 : -1;
      swing(a, rest, arms[i].upper, of->shoulder * ahead, &w);
      swing(a, rest, arms[i].lower, of->elbow * ahead, &w);
    }
    if (!write_pose(c, reaches ? of->reaching : of->passing, (const double(*)[4])w.rotations, w.is_rotated,
            &poses[k]))
      return false;
    poses[k].distance = (float)(of->step * leg * (reaches ? 1 : 0.5));
    poses[k].speed = (float)(of->speed * leg);
    poses[k].mirrored = true;
  }
  return true;
}

static bool propose(sbfi_conversion *c, sbf_gait *gait) {
  const sbf_asset *a = c->asset;
  const sbf_clip *idle = find_idle(a);
  bool any = false;
  bool *alone = find_excluded_bones(c, gait);
  sbfi_rig_view view;
  sbfi_arm_draft arms[2];
  pose_work rest;
  sbf_pose *poses = sbfi_convert_allocate(c, 1 + 2 * SWINGS, sizeof *poses);
  if (!alone || !poses || !start(c, &rest) || !sbfi_view_rig(&view, a, 0, &c->scratch)) return false;
  if (idle && !use_clip(c, idle, alone, rest.rotations, rest.is_rotated, &any)) return false;
  uint32_t arm_count = sbfi_draft_arms(&view, gait, arms), count = 0;
  if (!idle) {
    sbfi_pose_draft draft = {rest.rotations, rest.is_rotated, a->bones.count};
    any = sbfi_lower_arms(&view, arms, arm_count, &draft);
    convert_to_bone_frames(a, rest.is_rotated, rest.rotations);
  }
  if (any) {
    if (!write_pose(c, "stance", (const double(*)[4])rest.rotations, rest.is_rotated, &poses[count++]))
      return false;
    gait->rest_pose = 0;
    if (idle)
      sbfi_convert_warn(c, SBF_CODE_REST_POSE_PROPOSED,
          "it stands and moves in the pose of the first frame of clip '%s'; its rest shape is the bind pose",
          idle->name);
    else
      sbfi_convert_warn(c, SBF_CODE_REST_POSE_PROPOSED,
          "its arms, which point sideways in the rig, were lowered, because no clip shows it standing");
  }
  if (arm_count == 2) {
    if (!write_swings(c, gait, arms, arm_count, &rest, &poses[count])) return false;
    count += 2 * SWINGS;
  }
  if (count) c->asset->poses = (sbf_pose_list){poses, count};
  return true;
}

sbf_status sbfi_propose_rest_pose(sbfi_conversion *c) {
  const sbf_asset *a = c->asset;
  if (a->gaits.count != 1 || !a->gaits.at[0].proposed || a->poses.count) return SBF_OK;
  sbf_gait *gait = (sbf_gait *)(uintptr_t)&a->gaits.at[0]; /* proposed by this pass and still writable */
  return propose(c, gait) ? SBF_OK : sbfi_convert_no_memory(c);
}
