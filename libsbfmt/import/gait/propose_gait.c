#include "import/gait/propose_gait.h"

#include <math.h>
#include <string.h>

#include "import/gait/gait_draft.h"
#include "import/gait/gait_parts.h"

enum { SHORTEST_STEP_TICKS = 2 }; /* control ticks; a foot that moves for less jumps */

/* Pole beyond the knee, away from the line between hip and ankle: the leg keeps its bending direction at
 * rest. A straight leg bends forward. */
static sbf_vec3 pole_of(const sbfi_gait_draft *d, const sbfi_leg_draft *leg) {
  sbf_vec3 hip = sbfi_draft_bone(d, leg->upper)->head, knee = sbfi_draft_bone(d, leg->lower)->head;
  sbf_vec3 ankle = sbfi_draft_bone(d, leg->end)->head;
  double along[3] = {
      (double)ankle.x - (double)hip.x, (double)ankle.y - (double)hip.y, (double)ankle.z - (double)hip.z};
  double to_knee[3] = {
      (double)knee.x - (double)hip.x, (double)knee.y - (double)hip.y, (double)knee.z - (double)hip.z};
  double squared = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
  double dot = to_knee[0] * along[0] + to_knee[1] * along[1] + to_knee[2] * along[2];
  double t = squared > 0 ? dot / squared : 0, out[3], size = 0;
  for (int k = 0; k < 3; k++) {
    out[k] = to_knee[k] - t * along[k];
    size += out[k] * out[k];
  }
  size = sqrt(size);
  bool bent = size > 0.01 * leg->reach;
  double scale = bent ? leg->reach / size : 0;
  return (sbf_vec3){(float)((double)knee.x + scale * out[0]), (float)((double)knee.y + scale * out[1]),
      (float)((double)knee.z + scale * out[2] + (bent ? 0 : leg->reach))};
}

/* Maximum distance of a foot from its home before the leg is fully extended. */
static double play_of(const sbfi_gait_draft *d, const sbfi_leg_draft *leg) {
  sbf_vec3 hip = sbfi_draft_bone(d, leg->upper)->head, ankle = sbfi_draft_bone(d, leg->end)->head;
  double x = (double)ankle.x - (double)hip.x, y = (double)ankle.y - (double)hip.y;
  double reach = 0.93 * leg->reach, left = reach * reach - x * x - y * y;
  return left > 0 ? sqrt(left) - fabs((double)ankle.z - (double)hip.z) : 0;
}

static bool write_ik_chains(sbfi_conversion *c, sbfi_gait_draft *d) {
  sbf_ik_chain *chains = sbf_asset_allocate(d->asset, d->leg_count, sizeof *chains);
  if (!chains) return false;
  for (uint32_t l = 0; l < d->leg_count; l++) {
    const sbfi_leg_draft *leg = &d->legs[l];
    sbf_ik_chain_init(&chains[l]);
    chains[l].name = sbfi_draft_bone(d, sbfi_draft_is_standing(leg))->name;
    chains[l].id = sbfi_new_id(c, "ik", chains[l].name);
    if (!chains[l].id) return false;
    chains[l].root = leg->upper;
    chains[l].end = sbfi_draft_is_standing(leg);
    chains[l].proposed = true;
    if (leg->lower == SBF_NONE) {
      chains[l].solver = SBF_IK_SOLVER_CCD;
      continue;
    }
    if (leg->toe != SBF_NONE) chains[l].solver = SBF_IK_SOLVER_CCD;
    chains[l].has_pole = true;
    chains[l].pole = pole_of(d, leg);
  }
  d->asset->ik_chains = (sbf_ik_chain_list){chains, d->leg_count};
  return true;
}

/* Number of legs of the same side in front of this one. */
static uint32_t legs_ahead(const sbfi_gait_draft *d, uint32_t leg) {
  uint32_t ahead = 0;
  double here = (double)sbfi_draft_bone(d, d->legs[leg].end)->head.z;
  for (uint32_t k = 0; k < d->leg_count; k++) {
    double z = (double)sbfi_draft_bone(d, d->legs[k].end)->head.z;
    ahead += d->legs[k].side == d->legs[leg].side && (z > here || (z == here && k < leg));
  }
  return ahead;
}

/* The legs of a pair alternate, and so do consecutive pairs: groups are diagonals. */
static bool write_legs(sbfi_gait_draft *d, sbf_gait *gait) {
  sbf_leg *legs = sbf_asset_allocate(d->asset, d->leg_count, sizeof *legs);
  if (!legs) return false;
  for (uint32_t l = 0; l < d->leg_count; l++) {
    const sbfi_leg_draft *from = &d->legs[l];
    int32_t stands = sbfi_draft_is_standing(from);
    double lowest = d->shapes[stands].low_below;
    sbf_leg_init(&legs[l]);
    legs[l].name = sbfi_draft_bone(d, stands)->name;
    legs[l].ik = (int32_t)l;
    legs[l].home = sbfi_draft_bone(d, stands)->head;
    legs[l].sole = (float)fmax(0, (double)legs[l].home.y - (isfinite(lowest) ? lowest : d->ground));
    legs[l].jump_margin = (float)(0.5 * from->reach);
    legs[l].group = (legs_ahead(d, l) + (from->side > 0)) % 2;
  }
  gait->legs = (sbf_leg_list){legs, d->leg_count};
  return true;
}

/* Lengths scale with the shortest leg, and times with its square root, as for a pendulum, down to what the
 * control tick can resolve. */
static void set_steps(const sbfi_gait_draft *d, sbf_gait *gait) {
  double play = INFINITY, reach = INFINITY;
  for (uint32_t l = 0; l < d->leg_count; l++) {
    play = fmin(play, play_of(d, &d->legs[l]));
    reach = fmin(reach, d->legs[l].reach);
  }
  gait->step_trigger = (float)fmax(0.08 * reach, fmin(0.22 * reach, 0.45 * play));
  gait->step_height = (float)(0.12 * reach);
  gait->walk_speed = (float)(0.4 * reach);
  gait->step_duration =
      (float)fmax(0.42 * sqrt(reach), SHORTEST_STEP_TICKS * (double)d->asset->environment.control_tick);
}

static bool write_head(sbfi_gait_draft *d, sbf_gait *gait) {
  if (d->head == SBF_NONE) return true;
  sbf_head_turn *head = sbf_asset_allocate(d->asset, 1, sizeof *head);
  if (!head) return false;
  sbf_head_turn_init(head);
  head->bone = d->head;
  gait->head = head;
  return true;
}

static bool write_chain(
    sbfi_conversion *c, const char *name, sbf_chain_kind kind, const uint32_t *bones, uint32_t count) {
  sbf_chain *chain = sbfi_convert_allocate(c, 1, sizeof *chain);
  if (!chain) return false;
  sbf_chain_init(chain);
  chain->id = sbfi_new_id(c, "chain", name);
  chain->name = sbf_asset_copy_text(c->asset, name);
  if (!chain->id || !chain->name) return false;
  chain->kind = kind;
  chain->bones = (sbf_u32_list){bones, count};
  chain->proposed = true;
  c->asset->chains = (sbf_chain_list){chain, 1};
  return true;
}

static bool write_tail(sbfi_conversion *c, sbfi_gait_draft *d, sbf_gait *gait) {
  if (d->tail_count == 0) return true;
  sbf_tail *tail = sbf_asset_allocate(d->asset, 1, sizeof *tail);
  if (!tail || !write_chain(c, "tail", SBF_CHAIN_KIND_LAG, d->tail, d->tail_count)) return false;
  sbf_tail_init(tail);
  tail->chain = 0;
  gait->tails = (sbf_tail_list){tail, 1};
  return true;
}

/* For crawlers: each bone follows the one before at its rest distance. */
static bool write_spine(sbfi_conversion *c, sbfi_gait_draft *d) {
  float *spacing = sbf_asset_allocate(d->asset, d->spine_count, sizeof *spacing);
  if (!spacing || !write_chain(c, "spine", SBF_CHAIN_KIND_DISTANCE, d->spine, d->spine_count)) return false;
  for (uint32_t i = 0; i + 1 < d->spine_count; i++)
    spacing[i] = (float)sbfi_draft_distance(d, (int32_t)d->spine[i], (int32_t)d->spine[i + 1]);
  spacing[d->spine_count - 1] = sbfi_draft_bone(d, (int32_t)d->spine[d->spine_count - 1])->length;
  sbf_chain *chain = (sbf_chain *)(uintptr_t)d->asset->chains.at; /* created above and still writable */
  chain->spacing = (sbf_f32_list){spacing, d->spine_count};
  return true;
}

static bool write_gait(sbfi_conversion *c, sbfi_gait_draft *d) {
  sbf_gait *gait = sbf_asset_allocate(d->asset, 1, sizeof *gait);
  if (!gait || !write_ik_chains(c, d)) return false;
  sbf_gait_init(gait);
  gait->id = sbfi_new_id(c, "gait", "walk");
  gait->name = "walk";
  if (!gait->id) return false;
  gait->proposed = true;
  gait->hips = d->hips;
  gait->chest = d->chest;
  gait->body = d->legs[0].limb;
  while (sbfi_draft_bone(d, gait->body)->parent != SBF_NONE)
    gait->body = sbfi_draft_bone(d, gait->body)->parent;
  set_steps(d, gait);
  bool good = write_legs(d, gait) && write_head(d, gait);
  if (!good || !(d->row ? write_spine(c, d) : write_tail(c, d, gait))) return false;
  d->asset->gaits = (sbf_gait_list){gait, 1};
  return true;
}

/* Root with most of the skin in its subtree. */
static int32_t main_root(const sbf_asset *a, const uint32_t *holds, sbfi_arena *scratch) {
  uint32_t *below = sbfi_arena_allocate(scratch, a->bones.count, sizeof *below);
  int32_t best = 0;
  if (!below) return SBF_NONE;
  for (uint32_t i = a->bones.count; i-- > 0;) {
    below[i] += holds[i];
    if (a->bones.at[i].parent != SBF_NONE) below[a->bones.at[i].parent] += below[i];
  }
  for (uint32_t i = 0; i < a->bones.count; i++)
    if (a->bones.at[i].parent == SBF_NONE && (a->bones.at[best].parent != SBF_NONE || below[i] > below[best]))
      best = (int32_t)i;
  return best;
}

typedef bool proposer(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait);

static bool propose_other(sbfi_conversion *c, sbfi_locomotion_kind kind) {
  static proposer *const proposers[SBFI_LOCOMOTION_KINDS] = {[SBFI_LOCOMOTION_SWIM] = sbfi_propose_swim,
      [SBFI_LOCOMOTION_FLY] = sbfi_propose_fly,
      [SBFI_LOCOMOTION_SLITHER] = sbfi_propose_slither,
      [SBFI_LOCOMOTION_CRAWL] = sbfi_propose_crawl,
      [SBFI_LOCOMOTION_ROLL] = sbfi_propose_roll};
  static const sbf_gait_kind kinds[SBFI_LOCOMOTION_KINDS] = {SBF_GAIT_KIND_WALK, SBF_GAIT_KIND_SWIM,
      SBF_GAIT_KIND_FLY, SBF_GAIT_KIND_SLITHER, SBF_GAIT_KIND_CRAWL, SBF_GAIT_KIND_ROLL, SBF_GAIT_KIND_NONE};
  sbfi_rig_view view;
  sbf_gait *gait = sbfi_convert_allocate(c, 1, sizeof *gait);
  if (!gait || !sbfi_view_rig(&view, c->asset, 0, &c->scratch)) return false;
  sbf_gait_init(gait);
  gait->name = sbfi_locomotion_name(kind);
  gait->id = sbfi_new_id(c, "gait", gait->name);
  gait->kind = kinds[kind];
  gait->proposed = true;
  gait->body = main_root(c->asset, view.holds, &c->scratch);
  if (!gait->id || gait->body == SBF_NONE || !proposers[kind](c, &view, gait)) return false;
  c->asset->gaits = (sbf_gait_list){gait, 1};
  return true;
}

static void report_no_legs(sbfi_conversion *c) {
  sbfi_convert_warn(c, SBF_CODE_RIG_NO_LEGS,
      "fewer than two limbs of the rig reach the ground: no gait is proposed and the character moves as a "
      "whole; choose another kind with --gait KIND");
}

/* Proposes hopping for characters that should walk but have no legs. */
static bool propose_walk(sbfi_conversion *c) {
  sbfi_gait_draft d = {.asset = c->asset};
  if (!sbfi_draft_shapes(&d, &c->scratch) || !sbfi_draft_legs(&d, &c->scratch)) return false;
  if (d.leg_count > 1) /* one leg is not enough to walk */
    return sbfi_draft_row(&d) && sbfi_draft_ends(&d) && write_gait(c, &d);
  if (c->locomotion && c->locomotion->second == SBFI_LOCOMOTION_CRAWL) {
    sbfi_convert_warn(c, SBF_CODE_GAIT_KIND,
        "its gait is crawl instead of walk, because fewer than two limbs of the rig reach the ground");
    return propose_other(c, SBFI_LOCOMOTION_CRAWL);
  }
  report_no_legs(c);
  return true;
}

sbf_status sbfi_propose_gait(sbfi_conversion *c) {
  const sbf_asset *a = c->asset;
  if (a->bones.count == 0 || a->gaits.count || a->chains.count || a->ik_chains.count) return SBF_OK;
  sbfi_locomotion_kind kind = c->locomotion ? c->locomotion->kind : SBFI_LOCOMOTION_WALK;
  bool good = true;
  if (kind == SBFI_LOCOMOTION_WALK)
    good = propose_walk(c);
  else if (kind == SBFI_LOCOMOTION_NONE)
    report_no_legs(c);
  else
    good = propose_other(c, kind);
  return good ? SBF_OK : sbfi_convert_no_memory(c);
}
