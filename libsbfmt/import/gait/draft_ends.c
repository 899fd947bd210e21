/* Finds head and tail, first by name, then by shape. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "import/gait/gait_draft.h"
#include "import/gait/named_chains.h"

enum { MIN_TAIL = 2 }; /* minimum number of bones of a tail recognized by shape alone */

/* Whether a name contains a word, ignoring case. */
static bool contains_word(const char *name, const char *word) {
  size_t length = strlen(word);
  for (; *name; name++) {
    size_t k = 0;
    while (k < length && tolower((unsigned char)name[k]) == word[k]) k++;
    if (k == length) return true;
  }
  return false;
}

static bool is_leg_bone(const sbfi_gait_draft *d, int32_t bone) {
  for (uint32_t l = 0; l < d->leg_count; l++)
    if (sbfi_draft_is_below(d, bone, d->legs[l].limb)) return true;
  return false;
}

/* Whether the bone or a descendant carries legs. */
static bool has_legs(const sbfi_gait_draft *d, int32_t bone) {
  for (uint32_t l = 0; l < d->leg_count; l++)
    if (sbfi_draft_is_below(d, d->legs[l].limb, bone)) return true;
  return false;
}

static bool is_middle(const sbfi_gait_draft *d, int32_t bone) {
  return d->shapes[bone].moves_points && d->shapes[bone].side == 0 && !is_leg_bone(d, bone);
}

/* Whether the bone or an ancestor is named a tail. */
static bool is_called_tail(const sbfi_gait_draft *d, int32_t bone) {
  for (; bone != SBF_NONE; bone = sbfi_draft_bone(d, bone)->parent)
    if (contains_word(sbfi_draft_bone(d, bone)->name, "tail")) return true;
  return false;
}

int32_t sbfi_draft_named_head(const sbfi_gait_draft *d) {
  for (int pass = 0; pass < 2; pass++) /* the first pass requires a bone with points of its own */
    for (uint32_t i = 0; i < d->asset->bones.count; i++) {
      int32_t bone = (int32_t)i;
      bool holds = pass || !d->has_mesh || d->shapes[i].points;
      if (holds && is_middle(d, bone) && !has_legs(d, bone) &&
          contains_word(sbfi_draft_bone(d, bone)->name, "head"))
        return bone;
    }
  return SBF_NONE;
}

/* Finds the end farthest in front of the feet, or the highest end if all legs hang on one bone. Ears, eyes
 * and jaws count as part of their parent bone. */
static int32_t head_by_shape(const sbfi_gait_draft *d) {
  double foremost = -INFINITY, best = -INFINITY;
  int32_t head = SBF_NONE;
  for (uint32_t l = 0; l < d->leg_count; l++)
    foremost = fmax(foremost, (double)sbfi_draft_bone(d, d->legs[l].end)->head.z);
  for (uint32_t i = 0; i < d->asset->bones.count; i++) {
    const sbf_bone *bone = sbfi_draft_bone(d, (int32_t)i);
    if (!is_middle(d, (int32_t)i) || d->shapes[i].middle_children || bone->parent == SBF_NONE ||
        is_called_tail(d, (int32_t)i))
      continue;
    bool upright = d->chest == SBF_NONE && (double)bone->head.y - d->ground > 0.6 * d->height;
    if (!upright && (double)bone->head.z <= foremost) continue;
    double score = upright ? (double)bone->head.y : (double)bone->head.z;
    if (score <= best) continue;
    best = score;
    head = (int32_t)i;
  }
  int32_t parent = head != SBF_NONE ? sbfi_draft_bone(d, head)->parent : SBF_NONE;
  bool shared = parent != SBF_NONE && d->shapes[parent].children > 1 && is_middle(d, parent);
  return shared && !has_legs(d, parent) && parent != d->hips && parent != d->chest ? parent : head;
}

/* Lists bones from `first` on while each has one child. Returns their number. */
static uint32_t follow(const sbfi_gait_draft *d, int32_t first, uint32_t *bones) {
  uint32_t count = 0;
  for (int32_t bone = first; bone != SBF_NONE; bone = sbfi_draft_only_child(d, bone))
    bones[count++] = (uint32_t)bone;
  return count;
}

/* Whether a chain leads back from behind the hips, is longer than its drop, and has no other children. */
static bool is_tail_chain(const sbfi_gait_draft *d, const uint32_t *bones, uint32_t count) {
  if (count < MIN_TAIL || d->shapes[bones[count - 1]].children) return false;
  const sbf_vec3 from = sbfi_draft_bone(d, (int32_t)bones[0])->head;
  const sbf_vec3 to = sbfi_draft_bone(d, (int32_t)bones[count - 1])->head;
  double back = (double)from.z - (double)to.z, rearmost = INFINITY;
  for (uint32_t l = 0; l < d->leg_count; l++)
    rearmost = fmin(rearmost, (double)sbfi_draft_bone(d, d->legs[l].upper)->head.z);
  return back > 0.5 * fabs((double)from.y - (double)to.y) && (double)to.z < rearmost &&
         back > 0.05 * (d->high_z - d->low_z);
}

static bool find_tail(sbfi_gait_draft *d) {
  uint32_t count = d->asset->bones.count;
  d->tail = sbf_asset_allocate(d->asset, count, sizeof *d->tail);
  if (!d->tail) return false;
  for (int by_shape = 0; by_shape < 2; by_shape++)
    for (uint32_t i = 0; i < count; i++) {
      int32_t bone = (int32_t)i;
      if (!is_middle(d, bone) || has_legs(d, bone)) continue;
      if (d->head != SBF_NONE &&
          (sbfi_draft_is_below(d, bone, d->head) || sbfi_draft_is_below(d, d->head, bone)))
        continue;
      if (!by_shape && !contains_word(sbfi_draft_bone(d, bone)->name, "tail")) continue;
      d->tail_count = follow(d, bone, d->tail);
      if (!by_shape || is_tail_chain(d, d->tail, d->tail_count)) return true;
      d->tail_count = 0;
    }
  return true;
}

bool sbfi_draft_ends(sbfi_gait_draft *d) {
  d->head = sbfi_chain_head(d->asset);
  if (d->head == SBF_NONE) d->head = sbfi_draft_named_head(d);
  if (d->head == SBF_NONE) d->head = head_by_shape(d);
  return find_tail(d);
}
