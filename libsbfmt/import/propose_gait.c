#include "import/propose_gait.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_LEGS = 16, NO_BONE = SBF_NONE };

typedef struct leg_draft {
  int32_t upper, lower, foot;
  double reach;
  int32_t twin; /* place of the leg on the other side, or -1 */
} leg_draft;

typedef struct draft {
  sbf_asset *asset;
  double ground, height, length; /* lowest point, extent along y and z, of everything seen */
  leg_draft legs[MOST_LEGS];
  uint32_t leg_count;
  int32_t head;
  uint32_t *tail; /* bones from the leading one */
  uint32_t tail_count;
} draft;

static const sbf_bone *bone_at(const draft *d, int32_t bone) {
  return &d->asset->bones.at[bone];
}

static double distance(sbf_vec3 a, sbf_vec3 b) {
  double x = (double)a.x - b.x, y = (double)a.y - b.y, z = (double)a.z - b.z;
  return sqrt(x * x + y * y + z * z);
}

/* Whether a name holds a word, whatever its case. */
static bool says(const char *name, const char *word) {
  size_t length = strlen(word);
  for (; *name; name++) {
    size_t k = 0;
    while (k < length && tolower((unsigned char)name[k]) == word[k]) k++;
    if (k == length) return true;
  }
  return false;
}

static bool is_end(const sbf_bone *bone) {
  size_t length = strlen(bone->name);
  return length > 4 && strcmp(bone->name + length - 4, "_end") == 0;
}

/* Children that are bones of their own, without those that only mark a tip. */
static uint32_t children(const draft *d, int32_t bone, int32_t *only) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < d->asset->bones.count; i++) {
    if (bone_at(d, (int32_t)i)->parent != bone || is_end(bone_at(d, (int32_t)i))) continue;
    count++;
    *only = (int32_t)i;
  }
  return count;
}

static void measure(draft *d) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  const sbf_asset *a = d->asset;
  for (uint32_t b = 0; b < a->soft_bodies.count + a->render_meshes.count; b++) {
    const sbf_vec3_list points = b < a->soft_bodies.count
                                     ? a->soft_bodies.at[b].surface.positions
                                     : a->render_meshes.at[b - a->soft_bodies.count].mesh.positions;
    for (uint32_t i = 0; i < points.count; i++) {
      const double p[3] = {points.at[i].x, points.at[i].y, points.at[i].z};
      for (int k = 0; k < 3; k++) {
        low[k] = fmin(low[k], p[k]);
        high[k] = fmax(high[k], p[k]);
      }
    }
  }
  d->ground = low[1];
  d->height = high[1] - low[1];
  d->length = high[2] - low[2];
}

/* Lowest y of what a bone and the bones below it carry; INFINITY where they carry nothing. */
static double lowest_of(const draft *d, int32_t bone) {
  double lowest = INFINITY;
  for (uint32_t b = 0; b < d->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &d->asset->soft_bodies.at[b];
    int32_t above = body->bone;
    while (above >= 0 && above != bone) above = bone_at(d, above)->parent;
    if (above != bone) continue;
    for (uint32_t i = 0; i < body->surface.positions.count; i++)
      lowest = fmin(lowest, (double)body->surface.positions.at[i].y);
  }
  for (uint32_t m = 0; m < d->asset->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &d->asset->render_meshes.at[m];
    for (uint32_t i = 0, at = 0; mesh->skin && i < mesh->mesh.positions.count; i++) {
      for (uint32_t s = 0; s < mesh->skin->influence_counts.at[i]; s++, at++)
        if (mesh->skin->bones.at[at] == (uint32_t)bone && mesh->skin->weights.at[at] > 0.5f)
          lowest = fmin(lowest, (double)mesh->mesh.positions.at[i].y);
    }
  }
  return lowest;
}

/* A bone is a foot if it carries what touches the ground, hangs below two others in one line, and neither of
 * those carries a limb of its own. The highest such bone of a chain counts: toes go with it. */
static bool is_foot(const draft *d, int32_t foot) {
  const sbf_bone *bone = bone_at(d, foot);
  int32_t lower = bone->parent, upper = lower >= 0 ? bone_at(d, lower)->parent : NO_BONE, only;
  if (upper < 0 || is_end(bone) || bone_at(d, upper)->parent < 0) return false;
  if (children(d, lower, &only) != 1 || children(d, upper, &only) != 1) return false;
  double lowest = lowest_of(d, foot), tolerance = 0.08 * d->height;
  if (!isfinite(lowest)) lowest = (double)bone->head.y;
  if (lowest > d->ground + tolerance) return false;
  double hip = (double)bone_at(d, upper)->head.y, ankle = (double)bone->head.y;
  return hip - ankle > 0.2 * d->height && fabs((double)bone->head.x) > 0.02 * d->height;
}

static void find_legs(draft *d) {
  for (uint32_t i = 0; i < d->asset->bones.count && d->leg_count < MOST_LEGS; i++) {
    int32_t foot = (int32_t)i, lower = bone_at(d, foot)->parent;
    if (!is_foot(d, foot)) continue;
    bool toe = false;
    for (uint32_t l = 0; l < d->leg_count; l++)
      for (int32_t b = lower; b >= 0; b = bone_at(d, b)->parent) toe |= b == d->legs[l].foot;
    if (toe) continue;
    int32_t upper = bone_at(d, lower)->parent;
    double reach = distance(bone_at(d, upper)->head, bone_at(d, lower)->head) +
                   distance(bone_at(d, lower)->head, bone_at(d, foot)->head);
    d->legs[d->leg_count++] = (leg_draft){upper, lower, foot, reach, -1};
  }
  for (uint32_t a = 0; a < d->leg_count; a++)
    for (uint32_t b = 0; b < d->leg_count; b++) {
      sbf_vec3 mirrored = bone_at(d, d->legs[b].foot)->head;
      mirrored.x = -mirrored.x;
      if (a != b && distance(mirrored, bone_at(d, d->legs[a].foot)->head) < 0.1 * d->height)
        d->legs[a].twin = (int32_t)b;
    }
}

static bool is_leg_bone(const draft *d, int32_t bone) {
  for (uint32_t l = 0; l < d->leg_count; l++)
    for (int32_t b = d->legs[l].foot; b >= 0; b = bone_at(d, b)->parent) {
      if (b == bone) return true;
      if (b == d->legs[l].upper) break;
    }
  return false;
}

/* By name, else the foremost leaf that is no leg and lies ahead of the legs. */
static void find_head(draft *d) {
  d->head = NO_BONE;
  double best = -INFINITY, foremost = -INFINITY;
  for (uint32_t i = 0; i < d->asset->bones.count; i++)
    if (says(bone_at(d, (int32_t)i)->name, "head") && !is_end(bone_at(d, (int32_t)i))) {
      d->head = (int32_t)i;
      return;
    }
  for (uint32_t l = 0; l < d->leg_count; l++)
    foremost = fmax(foremost, (double)bone_at(d, d->legs[l].foot)->head.z);
  for (uint32_t i = 0; i < d->asset->bones.count; i++) {
    const sbf_bone *bone = bone_at(d, (int32_t)i);
    int32_t only;
    if (children(d, (int32_t)i, &only) || is_leg_bone(d, (int32_t)i) || is_end(bone) || bone->parent < 0)
      continue;
    if (fabs((double)bone->head.x) > 0.05 * d->height || (double)bone->head.z < foremost) continue;
    if ((double)bone->head.z <= best) continue;
    best = (double)bone->head.z;
    d->head = (int32_t)i;
  }
}

/* From a first tail bone on: one child after the other. */
static bool take_tail(draft *d, int32_t first) {
  d->tail = sbf_asset_allocate(d->asset, d->asset->bones.count, sizeof *d->tail);
  if (!d->tail) return false;
  int32_t bone = first, only = NO_BONE;
  d->tail[d->tail_count++] = (uint32_t)bone;
  while (children(d, bone, &only) == 1) {
    bone = only;
    d->tail[d->tail_count++] = (uint32_t)bone;
  }
  return true;
}

/* By name, else a chain of at least two bones that leads away behind the legs. */
static bool find_tail(draft *d) {
  int32_t first = NO_BONE;
  double rearmost = INFINITY;
  for (uint32_t l = 0; l < d->leg_count; l++)
    rearmost = fmin(rearmost, (double)bone_at(d, d->legs[l].upper)->head.z);
  for (uint32_t i = 0; i < d->asset->bones.count && first == NO_BONE; i++)
    if (says(bone_at(d, (int32_t)i)->name, "tail") && !is_end(bone_at(d, (int32_t)i))) first = (int32_t)i;
  for (uint32_t i = 0; i < d->asset->bones.count && first == NO_BONE; i++) {
    int32_t only = NO_BONE;
    const sbf_bone *bone = bone_at(d, (int32_t)i);
    if (bone->parent < 0 || is_leg_bone(d, (int32_t)i) || children(d, (int32_t)i, &only) != 1) continue;
    bool back = (double)bone->head.z <= rearmost && (double)bone_at(d, only)->head.z < (double)bone->head.z;
    if (back && fabs((double)bone_at(d, only)->head.x) < 0.05 * d->height) first = (int32_t)i;
  }
  return first == NO_BONE || take_tail(d, first);
}

/* The bone on which a leg hangs. */
static int32_t girdle(const draft *d, const leg_draft *leg) {
  return bone_at(d, leg->upper)->parent;
}

/* Fore and hind: by the girdles' place; one girdle serves as hips alone. */
static void find_girdles(const draft *d, int32_t *hips, int32_t *chest) {
  *hips = *chest = NO_BONE;
  for (uint32_t l = 0; l < d->leg_count; l++) {
    int32_t bone = girdle(d, &d->legs[l]);
    if (*hips == NO_BONE || bone_at(d, bone)->head.z < bone_at(d, *hips)->head.z) *hips = bone;
    if (*chest == NO_BONE || bone_at(d, bone)->head.z > bone_at(d, *chest)->head.z) *chest = bone;
  }
  if (*chest == *hips) *chest = NO_BONE;
}

static const char *proposed_id(draft *d, const char *kind, const char *name) {
  char *id = sbf_asset_allocate(d->asset, strlen(kind) + strlen(name) + 2, 1);
  if (!id) return NULL;
  sprintf(id, "%s.%s", kind, name);
  for (char *at = id; *at; at++)
    if ((unsigned char)*at <= ' ') *at = '_';
  return id;
}

/* Beyond the knee, away from the line between hip and ankle: the leg goes on bending as it is bent at rest. A
 * straight leg bends forward. */
static sbf_vec3 pole_of(const draft *d, const leg_draft *leg) {
  sbf_vec3 hip = bone_at(d, leg->upper)->head, knee = bone_at(d, leg->lower)->head;
  sbf_vec3 ankle = bone_at(d, leg->foot)->head;
  double along[3] = {(double)ankle.x - hip.x, (double)ankle.y - hip.y, (double)ankle.z - hip.z};
  double to_knee[3] = {(double)knee.x - hip.x, (double)knee.y - hip.y, (double)knee.z - hip.z}, out[3];
  double squared = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
  double t = (to_knee[0] * along[0] + to_knee[1] * along[1] + to_knee[2] * along[2]) / squared, size = 0;
  for (int k = 0; k < 3; k++) {
    out[k] = to_knee[k] - t * along[k];
    size += out[k] * out[k];
  }
  size = sqrt(size);
  double scale = size > 0.01 * leg->reach ? leg->reach / size : 0;
  sbf_vec3 pole = {
      (float)(knee.x + scale * out[0]), (float)(knee.y + scale * out[1]), (float)(knee.z + scale * out[2])};
  if (scale == 0) pole.z += (float)leg->reach;
  return pole;
}

/* How far a foot may fall behind or get ahead of its home before the leg is stretched. */
static double play_of(const draft *d, const leg_draft *leg) {
  sbf_vec3 hip = bone_at(d, leg->upper)->head, ankle = bone_at(d, leg->foot)->head;
  double x = (double)ankle.x - hip.x, y = (double)ankle.y - hip.y, z = (double)ankle.z - hip.z;
  double reach = 0.93 * leg->reach, left = reach * reach - x * x - y * y;
  return left > 0 ? sqrt(left) - fabs(z) : 0;
}

static bool write_chains(draft *d) {
  sbf_ik_chain *chains = sbf_asset_allocate(d->asset, d->leg_count, sizeof *chains);
  if (!chains) return false;
  for (uint32_t l = 0; l < d->leg_count; l++) {
    sbf_ik_chain_init(&chains[l]);
    chains[l].name = bone_at(d, d->legs[l].foot)->name;
    chains[l].id = proposed_id(d, "ik", chains[l].name);
    if (!chains[l].id) return false;
    chains[l].root = d->legs[l].upper;
    chains[l].end = d->legs[l].foot;
    chains[l].has_pole = true;
    chains[l].pole = pole_of(d, &d->legs[l]);
    chains[l].proposed = true;
  }
  d->asset->ik_chains = (sbf_ik_chain_list){chains, d->leg_count};
  return true;
}

/* Diagonal pairs: left and right of a pair take turns, and so do pairs one behind the other. */
static void group_legs(const draft *d, sbf_leg *legs) {
  for (uint32_t l = 0; l < d->leg_count; l++) {
    uint32_t ahead = 0; /* pairs of legs ahead of this one on its side */
    const sbf_bone *foot = bone_at(d, d->legs[l].foot);
    for (uint32_t k = 0; k < d->leg_count; k++) {
      const sbf_bone *other = bone_at(d, d->legs[k].foot);
      ahead += k != l && (other->head.x > 0) == (foot->head.x > 0) &&
               (double)other->head.z > (double)foot->head.z + 0.02 * d->height;
    }
    legs[l].group = (ahead + (foot->head.x > 0)) % 2;
  }
}

static bool write_gait(draft *d) {
  sbf_leg *legs = sbf_asset_allocate(d->asset, d->leg_count, sizeof *legs);
  sbf_gait *gait = sbf_asset_allocate(d->asset, 1, sizeof *gait);
  if (!legs || !gait) return false;
  double play = INFINITY, reach = INFINITY;
  for (uint32_t l = 0; l < d->leg_count; l++) {
    const leg_draft *from = &d->legs[l];
    sbf_leg_init(&legs[l]);
    legs[l].name = bone_at(d, from->foot)->name;
    legs[l].ik = (int32_t)l;
    legs[l].home = bone_at(d, from->foot)->head;
    double lowest = lowest_of(d, from->foot);
    legs[l].sole = (float)fmax(0, legs[l].home.y - (isfinite(lowest) ? lowest : d->ground));
    legs[l].jump_margin = (float)(0.5 * from->reach);
    play = fmin(play, play_of(d, from));
    reach = fmin(reach, from->reach);
  }
  group_legs(d, legs);
  sbf_gait_init(gait);
  gait->id = "gait.walk";
  gait->name = "walk";
  gait->proposed = true;
  gait->legs = (sbf_leg_list){legs, d->leg_count};
  find_girdles(d, &gait->hips, &gait->chest);
  gait->body = gait->hips;
  while (bone_at(d, gait->body)->parent >= 0) gait->body = bone_at(d, gait->body)->parent;
  gait->step_trigger = (float)fmax(0.08 * reach, fmin(0.22 * reach, 0.45 * play));
  gait->step_height = (float)(0.12 * reach);
  gait->walk_speed = (float)(0.4 * reach);
  gait->step_duration = (float)(0.42 * sqrt(reach)); /* as pendulums: time goes with the root of length */
  if (d->head != NO_BONE) {
    sbf_head_turn *head = sbf_asset_allocate(d->asset, 1, sizeof *head);
    if (!head) return false;
    sbf_head_turn_init(head);
    head->bone = d->head;
    gait->head = head;
  }
  d->asset->gaits = (sbf_gait_list){gait, 1};
  return true;
}

static bool write_tail(draft *d) {
  if (d->tail_count == 0) return true;
  sbf_chain *chain = sbf_asset_allocate(d->asset, 1, sizeof *chain);
  sbf_tail *tail = sbf_asset_allocate(d->asset, 1, sizeof *tail);
  if (!chain || !tail) return false;
  sbf_chain_init(chain);
  chain->id = "chain.tail";
  chain->name = "tail";
  chain->bones = (sbf_u32_list){d->tail, d->tail_count};
  chain->proposed = true;
  d->asset->chains = (sbf_chain_list){chain, 1};
  sbf_tail_init(tail);
  tail->chain = 0;
  sbf_gait *gait = (sbf_gait *)(uintptr_t)d->asset->gaits.at; /* made above: still ours to fill */
  gait->tails = (sbf_tail_list){tail, 1};
  return true;
}

sbf_status sbfi_propose_gait(sbf_asset *asset, sbfi_reporter *reporter, sbf_diagnostic *error) {
  if (asset->bones.count == 0 || asset->gaits.count) return SBF_OK;
  draft d = {.asset = asset};
  measure(&d);
  if (d.height > 0) find_legs(&d);
  if (d.leg_count == 0) {
    sbf_diagnostic warning;
    sbfi_diagnose(&warning, SBF_CODE_RIG_NO_LEGS,
        "no chain of thigh, shin and foot ends at the ground: no gait is proposed, and the character moves "
        "as a "
        "whole; add a gait to the bundle to make it walk");
    sbfi_report(reporter, &warning);
    return SBF_OK;
  }
  find_head(&d);
  if (!find_tail(&d) || !write_chains(&d) || !write_gait(&d) || !write_tail(&d))
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while proposing a gait");
  return SBF_OK;
}
