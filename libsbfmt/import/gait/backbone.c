/* Finds the backbone: the longest path through the bones of the middle, nose first. */
#include "import/gait/gait_parts.h"

static const double MIN_SPAN = 0.35; /* fraction of the length; a shorter path is not a backbone */

typedef struct bone_chain_path {
  double length; /* to the far end of the longest path downwards, m */
  int32_t next;  /* child on that path, or SBF_NONE */
} bone_chain_path;

static bool is_named_mouth(const sbfi_rig_view *view, uint32_t bone) {
  return sbfi_words_of(sbfi_draft_bone(&view->draft, (int32_t)bone)->name) >> SBFI_WORD_MOUTH & 1;
}

/* Selects candidates for the backbone: bones of the middle except tongue and jaw. With `without_symmetry` it
 * adds limbs without a mirror image, because the spine of a rig that is not straight leaves the middle. */
static void find_candidates(const sbfi_rig_view *view, bool without_symmetry, bool *candidates) {
  const sbfi_gait_draft *d = &view->draft;
  for (uint32_t i = 0; i < d->asset->bones.count; i++) {
    bool in_pair = d->shapes[i].side != 0 && !without_symmetry;
    for (uint32_t l = 0; l < view->limb_count && without_symmetry && !in_pair; l++)
      in_pair = view->limbs[l].twin != SBF_NONE && sbfi_draft_is_below(d, (int32_t)i, view->limbs[l].root);
    candidates[i] = d->shapes[i].moves_points && !in_pair && !is_named_mouth(view, i);
  }
}

/* Finds the two longest paths downwards from each bone of the middle, and the bone on the overall longest
 * path. */
static int32_t find_directions(
    const sbfi_rig_view *view, const bool *candidates, bone_chain_path *first, bone_chain_path *second) {
  const sbfi_gait_draft *d = &view->draft;
  double longest = 0;
  int32_t top = SBF_NONE;
  for (uint32_t i = d->asset->bones.count; i-- > 0;) {
    const sbf_bone *bone = sbfi_draft_bone(d, (int32_t)i);
    if (!candidates[i]) continue;
    if (first[i].next == SBF_NONE) first[i].length = (double)bone->length;
    if (first[i].length + second[i].length >= longest) {
      longest = first[i].length + second[i].length;
      top = (int32_t)i;
    }
    if (bone->parent == SBF_NONE) continue;
    bone_chain_path down = {first[i].length + sbfi_draft_distance(d, bone->parent, (int32_t)i), (int32_t)i};
    bone_chain_path *one = &first[bone->parent], *two = &second[bone->parent];
    if (one->next == SBF_NONE || down.length > one->length) {
      *two = *one;
      *one = down;
    } else if (two->next == SBF_NONE || down.length > two->length) {
      *two = down;
    }
  }
  return top;
}

/* Whether the path begins at the tail. A bone named as the head decides, otherwise the end farther back is
 * the tail. */
static bool begins_with_tail(const sbfi_rig_view *view, const uint32_t *path, uint32_t count) {
  for (uint32_t i = 0; i < count / 2; i++) {
    bool first = sbfi_words_of(sbfi_draft_bone(&view->draft, (int32_t)path[i])->name) >> SBFI_WORD_HEAD & 1;
    uint32_t opposite = path[count - 1 - i];
    bool last = sbfi_words_of(sbfi_draft_bone(&view->draft, (int32_t)opposite)->name) >> SBFI_WORD_HEAD & 1;
    if (first != last) return last;
  }
  return (double)sbfi_draft_head(&view->draft, (int32_t)path[0]).z <
         (double)sbfi_draft_head(&view->draft, (int32_t)path[count - 1]).z;
}

static void reverse(uint32_t *bones, uint32_t count) {
  for (uint32_t i = 0; i < count / 2; i++) {
    uint32_t bone = bones[i];
    bones[i] = bones[count - 1 - i];
    bones[count - 1 - i] = bone;
  }
}

typedef struct backbone_work {
  bone_chain_path *first, *second;
  bool *candidates;
  uint32_t *bones, count;
} backbone_work;

static bool begin(backbone_work *w, sbf_asset *asset, sbfi_arena *scratch) {
  uint32_t count = asset->bones.count;
  w->first = sbfi_arena_allocate(scratch, count, sizeof *w->first);
  w->second = sbfi_arena_allocate(scratch, count, sizeof *w->second);
  w->candidates = sbfi_arena_allocate(scratch, count, sizeof *w->candidates);
  w->bones = sbf_asset_allocate(asset, count, sizeof *w->bones);
  for (uint32_t i = 0; i < count && w->first && w->second; i++)
    w->first[i].next = w->second[i].next = SBF_NONE;
  return w->first && w->second && w->candidates && w->bones;
}

/* Whether the topmost bone, which joins both halves, is between them along z. A control bone of the whole
 * body often is not. */
static bool is_between(const sbfi_rig_view *view, const backbone_work *w, int32_t top) {
  double z = (double)sbfi_draft_head(&view->draft, top).z;
  double one = (double)sbfi_draft_head(&view->draft, (int32_t)w->bones[w->count - 1]).z;
  double two = (double)sbfi_draft_head(&view->draft, w->first[top].next).z;
  return (z - one) * (z - two) <= 0;
}

/* Lists the bones along the hierarchy, regardless of the body's shape: up one half to the top and down the
 * other. */
static void list_bones(const sbfi_rig_view *view, bool without_symmetry, backbone_work *w) {
  find_candidates(view, without_symmetry, w->candidates);
  int32_t top = find_directions(view, w->candidates, w->first, w->second);
  if (top == SBF_NONE) return;
  for (int32_t bone = w->second[top].next; bone != SBF_NONE; bone = w->first[bone].next)
    if (view->holds[bone]) w->bones[w->count++] = (uint32_t)bone;
  reverse(w->bones, w->count);
  bool passed = w->count && w->first[top].next != SBF_NONE && !is_between(view, w, top);
  for (int32_t bone = passed ? w->first[top].next : top; bone != SBF_NONE; bone = w->first[bone].next)
    if (view->holds[bone]) w->bones[w->count++] = (uint32_t)bone;
  if (w->count >= 2 && begins_with_tail(view, w->bones, w->count)) reverse(w->bones, w->count);
}

/* Distance along z between the heads of the first and the last bone, m. */
static double span_of(const sbfi_rig_view *view, const backbone_work *w) {
  if (w->count < 2) return 0;
  return fabs((double)sbfi_draft_head(&view->draft, (int32_t)w->bones[0]).z -
              (double)sbfi_draft_head(&view->draft, (int32_t)w->bones[w->count - 1]).z);
}

bool sbfi_find_backbone(
    const sbfi_rig_view *view, sbf_asset *asset, sbfi_arena *scratch, sbf_u32_list *bones) {
  backbone_work straight = {.count = 0}, without_symmetry = {.count = 0};
  *bones = (sbf_u32_list){NULL, 0};
  if (!begin(&straight, asset, scratch)) return false;
  list_bones(view, false, &straight);
  if (span_of(view, &straight) < MIN_SPAN * sbfi_view_extent(view, 2)) {
    if (!begin(&without_symmetry, asset, scratch)) return false;
    list_bones(view, true, &without_symmetry);
    if (span_of(view, &without_symmetry) > span_of(view, &straight)) straight = without_symmetry;
  }
  if (straight.count >= 2) *bones = (sbf_u32_list){straight.bones, straight.count};
  return true;
}
