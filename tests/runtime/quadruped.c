#include "quadruped.h"

#include "sbfmt/asset.h"

typedef struct bone_row {
  const char *name;
  int32_t parent;
  sbf_vec3 head;
} bone_row;

static const bone_row rows[] = {
    {"root", -1, {0, 0.30f, -0.3f}},
    {"hips", 0, {0, 0.30f, -0.3f}},
    {"spine", 1, {0, 0.30f, 0}},
    {"chest", 2, {0, 0.30f, 0.2f}},
    {"head", 3, {0, 0.35f, 0.4f}},
    {"tail1", 0, {0, 0.30f, -0.35f}},
    {"tail2", 5, {0, 0.30f, -0.5f}},
    {"tail3", 6, {0, 0.30f, -0.65f}},
    {"thigh.L", 1, {0.08f, 0.30f, -0.3f}},
    {"shin.L", 8, {0.12f, 0.17f, -0.22f}},
    {"foot.L", 9, {0.12f, 0.03f, -0.3f}},
    {"thigh.R", 1, {-0.08f, 0.30f, -0.3f}},
    {"shin.R", 11, {-0.12f, 0.17f, -0.22f}},
    {"foot.R", 12, {-0.12f, 0.03f, -0.3f}},
    {"arm.L", 3, {0.08f, 0.30f, 0.2f}},
    {"forearm.L", 14, {0.12f, 0.17f, 0.12f}},
    {"hand.L", 15, {0.12f, 0.03f, 0.2f}},
    {"arm.R", 3, {-0.08f, 0.30f, 0.2f}},
    {"forearm.R", 17, {-0.12f, 0.17f, 0.12f}},
    {"hand.R", 18, {-0.12f, 0.03f, 0.2f}},
};
enum { BONE_COUNT = sizeof rows / sizeof *rows };

static const int32_t feet[4] = {10, 13, 16, 19};
static const char *const chain_ids[4] = {"ik.hind.L", "ik.hind.R", "ik.fore.L", "ik.fore.R"};
static const uint32_t tail_bones[3] = {5, 6, 7};

sbf_asset *quadruped_asset(void) {
  sbf_asset *a = sbf_asset_create(NULL);
  sbf_bone *bones = sbf_asset_allocate(a, BONE_COUNT, sizeof *bones);
  for (int i = 0; i < BONE_COUNT; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = bones[i].name = rows[i].name;
    bones[i].parent = rows[i].parent;
    bones[i].head = rows[i].head;
  }
  a->bones = (sbf_bone_list){bones, BONE_COUNT};
  sbf_ik_chain *chains = sbf_asset_allocate(a, 4, sizeof *chains);
  sbf_leg *legs = sbf_asset_allocate(a, 4, sizeof *legs);
  for (int l = 0; l < 4; l++) {
    sbf_ik_chain_init(&chains[l]);
    chains[l].id = chain_ids[l];
    chains[l].end = feet[l];
    chains[l].root = feet[l] - 2;
    sbf_leg_init(&legs[l]);
    legs[l].name = rows[feet[l]].name;
    legs[l].ik = l;
    legs[l].home = rows[feet[l]].head;
    legs[l].sole = legs[l].home.y;
    legs[l].group = l == QUADRUPED_HIND_L || l == QUADRUPED_FORE_R;
  }
  a->ik_chains = (sbf_ik_chain_list){chains, 4};
  sbf_chain *chain = sbf_asset_allocate(a, 1, sizeof *chain);
  sbf_chain_init(chain);
  chain->id = "tail";
  chain->bones = (sbf_u32_list){tail_bones, 3};
  a->chains = (sbf_chain_list){chain, 1};
  sbf_tail *tail = sbf_asset_allocate(a, 1, sizeof *tail);
  sbf_tail_init(tail);
  tail->chain = 0;
  sbf_head_turn *head = sbf_asset_allocate(a, 1, sizeof *head);
  sbf_head_turn_init(head);
  head->bone = 4;
  sbf_gait *gait = sbf_asset_allocate(a, 1, sizeof *gait);
  sbf_gait_init(gait);
  gait->id = "walk";
  gait->body = 0;
  gait->hips = 1;
  gait->chest = 3;
  gait->step_trigger = 0.06f;
  gait->step_height = 0.04f;
  gait->step_duration = 0.2f;
  gait->legs = (sbf_leg_list){legs, 4};
  gait->tails = (sbf_tail_list){tail, 1};
  gait->head = head;
  a->gaits = (sbf_gait_list){gait, 1};
  return a;
}
