#include "measured_ragdoll.h"

#include "measured_bodies.h"
#include "measuring.h"

const ragdoll_part ragdoll_parts[RAGDOLL_PARTS] = {
    {-1, {0, 1, 0}, {0, 1, 0}, {0.3f, 0.18f, 0.18f}, 10},                               /* 0 pelvis */
    {0, {0, 1.09f, 0}, {0, 1.17f, 0}, {0.26f, 0.16f, 0.16f}, 9},                        /* 1 belly */
    {1, {0, 1.25f, 0}, {0, 1.36f, 0}, {0.3f, 0.22f, 0.18f}, 14},                        /* 2 chest */
    {2, {0, 1.5f, 0}, {0, 1.62f, 0}, {0.16f, 0.24f, 0.2f}, 5},                          /* 3 head */
    {2, {0.03f, 1.42f, 0}, {0.09f, 1.42f, 0}, {0.12f, 0.08f, 0.1f}, 1.5f},              /* 4 shoulder */
    {4, {0.15f, 1.42f, 0}, {0.3f, 1.42f, 0}, {0.3f, 0.09f, 0.09f}, 2},                  /* 5 upper arm */
    {5, {0.45f, 1.42f, 0}, {0.57f, 1.42f, 0}, {0.24f, 0.08f, 0.08f}, 1.3f},             /* 6 forearm */
    {6, {0.69f, 1.42f, 0}, {0.77f, 1.42f, 0}, {0.16f, 0.04f, 0.09f}, 0.5f},             /* 7 hand */
    {2, {-0.03f, 1.42f, 0}, {-0.09f, 1.42f, 0}, {0.12f, 0.08f, 0.1f}, 1.5f},            /* 8 */
    {8, {-0.15f, 1.42f, 0}, {-0.3f, 1.42f, 0}, {0.3f, 0.09f, 0.09f}, 2},                /* 9 */
    {9, {-0.45f, 1.42f, 0}, {-0.57f, 1.42f, 0}, {0.24f, 0.08f, 0.08f}, 1.3f},           /* 10 */
    {10, {-0.69f, 1.42f, 0}, {-0.77f, 1.42f, 0}, {0.16f, 0.04f, 0.09f}, 0.5f},          /* 11 */
    {0, {0.09f, 0.93f, 0}, {0.09f, 0.73f, 0}, {0.14f, 0.4f, 0.14f}, 7},                 /* 12 thigh */
    {12, {0.09f, 0.52f, 0}, {0.09f, 0.31f, 0}, {0.1f, 0.4f, 0.1f}, 3.5f},               /* 13 shin */
    {13, {0.09f, 0.1f, 0}, {0.09f, 0.05f, 0.04f}, {0.09f, 0.1f, 0.18f}, 0.9f},          /* 14 foot */
    {14, {0.09f, 0.03f, 0.13f}, {0.09f, 0.03f, 0.17f}, {0.09f, 0.06f, 0.08f}, 0.2f},    /* 15 toes */
    {0, {-0.09f, 0.93f, 0}, {-0.09f, 0.73f, 0}, {0.14f, 0.4f, 0.14f}, 7},               /* 16 */
    {16, {-0.09f, 0.52f, 0}, {-0.09f, 0.31f, 0}, {0.1f, 0.4f, 0.1f}, 3.5f},             /* 17 */
    {17, {-0.09f, 0.1f, 0}, {-0.09f, 0.05f, 0.04f}, {0.09f, 0.1f, 0.18f}, 0.9f},        /* 18 */
    {18, {-0.09f, 0.03f, 0.13f}, {-0.09f, 0.03f, 0.17f}, {0.09f, 0.06f, 0.08f}, 0.2f}}; /* 19 */

static void *allocate(sbf_asset *asset, size_t count, size_t size) {
  void *memory = asset ? sbf_asset_allocate(asset, count, size) : NULL;
  if (!memory) bench_fail("memory ran out");
  return memory;
}

static sbf_vec3 off(sbf_vec3 at, sbf_vec3 from) {
  return (sbf_vec3){at.x - from.x, at.y - from.y, at.z - from.z};
}

static void join(sbf_asset *asset, sbf_joint *joint, int number) {
  const ragdoll_part *part = &ragdoll_parts[number], *parent = &ragdoll_parts[part->parent];
  sbf_limit *limits = allocate(asset, 2, sizeof *limits);
  sbf_joint_init(joint);
  joint->id = "joint";
  joint->kind = SBF_JOINT_KIND_SPHERICAL;
  joint->body_a = part->parent, joint->body_b = number;
  joint->frame_a = (sbf_frame){off(part->joint, parent->middle), {0, 0, 0, 1}};
  joint->frame_b = (sbf_frame){off(part->joint, part->middle), {0, 0, 0, 1}};
  sbf_limit_init(&limits[0]), sbf_limit_init(&limits[1]);
  limits[0].target = SBF_JOINT_AXIS_SWING, limits[0].max = RAGDOLL_SWING;
  limits[1].target = SBF_JOINT_AXIS_TWIST, limits[1].min = -RAGDOLL_TWIST, limits[1].max = RAGDOLL_TWIST;
  joint->limits = (sbf_limit_list){limits, 2};
}

sbf_asset *ragdoll_asset(void) {
  sbf_asset *asset = sbf_asset_create(NULL);
  sbf_rigid_body *bodies = allocate(asset, RAGDOLL_PARTS, sizeof *bodies);
  sbf_bone *bones = allocate(asset, RAGDOLL_PARTS, sizeof *bones);
  sbf_joint *joints = allocate(asset, RAGDOLL_PARTS, sizeof *joints);
  uint32_t joint_count = 0;
  for (int i = 0; i < RAGDOLL_PARTS; i++) {
    const ragdoll_part *part = &ragdoll_parts[i];
    sbf_rigid_body_init(&bodies[i]);
    bodies[i].id = "part";
    bodies[i].bone = i;
    bodies[i].motion = SBF_BODY_MOTION_DYNAMIC;
    bodies[i].center = part->middle;
    bodies[i].mass = part->mass;
    bodies[i].hull = box_hull(asset, part->middle, part->size);
    sbf_bone_init(&bones[i]);
    bones[i].id = "bone";
    bones[i].parent = part->parent;
    bones[i].head = part->joint;
    if (part->parent >= 0) join(asset, &joints[joint_count++], i);
  }
  asset->rigid_bodies = (sbf_rigid_body_list){bodies, RAGDOLL_PARTS};
  asset->bones = (sbf_bone_list){bones, RAGDOLL_PARTS};
  asset->joints = (sbf_joint_list){joints, joint_count};
  return asset;
}
