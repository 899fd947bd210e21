/* Interprets bone names of other programs: which part of a body they mean. Prefixes, separators, case and
 * the notation of sides differ; the words for parts are few. */
#include <string.h>

#include "motion/retargeting.h"

enum { WORD_SIZE = 64 };
typedef enum side { NO_SIDE, LEFT, RIGHT } side;

typedef struct meaning {
  char part[WORD_SIZE]; /* lower case words, joined; "" if none is left */
  side side;
} meaning;

static bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}
static bool is_letter(char c) {
  return is_upper(c) || (c >= 'a' && c <= 'z');
}

/* Reads the next word of a name in lower case; separators, digits and capitals divide words. */
static bool next_word(const char **at, char word[WORD_SIZE]) {
  const char *c = *at;
  size_t length = 0;
  while (*c && !is_letter(*c)) c++;
  for (; is_letter(*c); c++) {
    bool begins = is_upper(*c) && length && (!is_upper(c[-1]) || (is_letter(c[1]) && !is_upper(c[1])));
    if (begins) break;
    if (length + 1 < WORD_SIZE) word[length++] = (char)(*c | 0x20);
  }
  word[length] = 0;
  *at = c;
  return length > 0;
}

static bool is_among(const char *word, const char *const *list) {
  for (; *list; list++)
    if (strcmp(word, *list) == 0) return true;
  return false;
}

static const struct {
  const char *part, *words[10];
} synonyms[] = {
    {"hips", {"hips", "pelvis", "cog"}},
    {"spine", {"spine", "chest", "body", "upperchest", "torso", "abdomen", "lowerback", "waist", "bodylow",
                  "bodyup"}},
    {"thigh", {"thigh", "upleg", "upperleg", "femur"}},
    {"shin", {"shin", "lowerleg", "lowleg", "calf", "knee", "tibia"}},
    {"foot", {"foot", "ankle"}},
    {"toe", {"toe", "toes", "toebase", "ball"}},
    {"clavicle", {"clavicle", "shoulder", "collar", "collarbone"}},
    {"upperarm", {"upperarm", "uparm", "humerus"}},
    {"forearm", {"forearm", "lowerarm", "lowarm", "elbow"}},
    {"hand", {"hand", "wrist"}},
    {"head", {"head", "skull"}},
    {"index", {"index", "handindex"}},
    {"thumb", {"thumb", "handthumb"}},
    {"middle", {"middle", "handmiddle"}},
    {"ring", {"ring", "handring"}},
    {"pinky", {"pinky", "handpinky", "little"}},
};

static void read_meaning(const char *name, meaning *m) {
  static const char *const left[] = {"l", "left", NULL}, *const right[] = {"r", "right", NULL};
  static const char *const idle[] = {"mixamorig", "bip", "def", "org", "b", "jnt", "joint", "bone", NULL};
  const char *colon = strrchr(name, ':');
  char word[WORD_SIZE];
  *m = (meaning){.side = NO_SIDE};
  for (const char *at = colon ? colon + 1 : name; next_word(&at, word);) {
    if (is_among(word, left) && m->side == NO_SIDE)
      m->side = LEFT;
    else if (is_among(word, right) && m->side == NO_SIDE)
      m->side = RIGHT;
    else if (!is_among(word, idle) && strlen(m->part) + strlen(word) < WORD_SIZE)
      strcat(m->part, word);
  }
  for (size_t i = 0; i < sizeof synonyms / sizeof *synonyms; i++)
    for (size_t k = 0; k < sizeof synonyms[i].words / sizeof *synonyms[i].words && synonyms[i].words[k]; k++)
      if (strcmp(m->part, synonyms[i].words[k]) == 0) {
        strcpy(m->part, synonyms[i].part);
        return;
      }
}

int sbfi_name_side(const char *name) {
  meaning m;
  read_meaning(name, &m);
  return m.side == LEFT ? 1 : m.side == RIGHT ? -1 : 0;
}

/* --- Words that mean different parts in different skeletons ------------------------------------------- */

static bool has_part(const meaning *all, uint32_t count, const char *part, side s) {
  for (uint32_t i = 0; i < count; i++)
    if (all[i].side == s && strcmp(all[i].part, part) == 0) return true;
  return false;
}

static uint32_t count_part(const meaning *all, uint32_t count, const char *part, side s) {
  uint32_t found = 0;
  for (uint32_t i = 0; i < count; i++) found += all[i].side == s && strcmp(all[i].part, part) == 0;
  return found;
}

/* Renames the bones of a side called `part` in order to `parts`, from `first` on. */
static void rename_parts(
    meaning *all, uint32_t count, const char *part, side s, const char *const *parts, uint32_t first) {
  for (uint32_t i = 0; i < count; i++) {
    if (all[i].side != s || strcmp(all[i].part, part) != 0 || !parts[first]) continue;
    strcpy(all[i].part, parts[first++]);
  }
}

/* Whether the bones of a side called hip point down as thighs do, and not outwards to the thighs. */
static bool hips_run_down(const sbf_asset *asset, const meaning *all, side s) {
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    const sbf_quat q = asset->bones.at[i].rotation;
    if (all[i].side != s || strcmp(all[i].part, "hip") != 0) continue;
    if (1 - 2 * ((double)q.x * (double)q.x + (double)q.z * (double)q.z) > -0.5) return false;
  }
  return true;
}

static void resolve(const sbf_asset *asset, meaning *all) {
  static const char *const leg[] = {"thigh", "shin", "foot", "toe", NULL};
  static const char *const arm[] = {"upperarm", "forearm", "hand", NULL};
  static const char *const hips[] = {"hips", NULL};
  uint32_t count = asset->bones.count;
  for (int s = LEFT; s <= RIGHT; s++) {
    if (!has_part(all, count, "thigh", (side)s) && hips_run_down(asset, all, (side)s))
      rename_parts(all, count, "hip", (side)s, leg, 0);
    bool has_thigh = has_part(all, count, "thigh", (side)s);
    if (count_part(all, count, "leg", (side)s) > 1 || !has_thigh || !has_part(all, count, "shin", (side)s))
      rename_parts(all, count, "leg", (side)s, leg, has_thigh);
    rename_parts(all, count, "arm", (side)s, arm, has_part(all, count, "upperarm", (side)s));
  }
  rename_parts(all, count, "hip", NO_SIDE, hips, 0);
  if (!has_part(all, count, "hips", NO_SIDE)) rename_parts(all, count, "root", NO_SIDE, hips, 0);
}

static meaning *meanings_of(const sbf_asset *asset, sbfi_arena *scratch) {
  meaning *all = sbfi_arena_allocate(scratch, asset->bones.count + 1, sizeof *all);
  for (uint32_t i = 0; all && i < asset->bones.count; i++) read_meaning(asset->bones.at[i].name, &all[i]);
  if (all) resolve(asset, all);
  return all;
}

/* --- Matching ----------------------------------------------------------------------------------------- */

static bool same_meaning(const meaning *a, const meaning *b) {
  return a->side == b->side && a->part[0] && strcmp(a->part, b->part) == 0;
}

/* Index among `m` bones for number `k` of `n`, proportionally; the last matches the last. */
static uint32_t fraction_of(uint32_t k, uint32_t n, uint32_t m) {
  return (uint32_t)(((uint64_t)(k + 1) * m + n - 1) / n) - 1;
}

static void match_chains(const sbf_asset *from, const sbf_asset *to, sbfi_bone_match *matches) {
  for (uint32_t i = 0; i < to->retarget_chains.count; i++) {
    const sbf_retarget_chain *chain = &to->retarget_chains.at[i];
    meaning here, there;
    read_meaning(chain->name, &here);
    for (uint32_t j = 0; j < from->retarget_chains.count; j++) {
      const sbf_retarget_chain *other = &from->retarget_chains.at[j];
      read_meaning(other->name, &there);
      if (!other->bones.count || (strcmp(chain->name, other->name) != 0 && !same_meaning(&here, &there)))
        continue;
      for (uint32_t k = 0; k < chain->bones.count; k++)
        if (matches[chain->bones.at[k]].source == SBF_NONE)
          matches[chain->bones.at[k]].source =
              (int32_t)other->bones.at[fraction_of(k, chain->bones.count, other->bones.count)];
      break;
    }
  }
}

static void match_names(const sbf_asset *from, const sbf_asset *to, sbfi_bone_match *matches) {
  for (uint32_t i = 0; i < to->bones.count; i++)
    for (uint32_t j = 0; j < from->bones.count && matches[i].source == SBF_NONE; j++)
      if (to->bones.at[i].name[0] && strcmp(to->bones.at[i].name, from->bones.at[j].name) == 0)
        matches[i].source = (int32_t)j;
}

static void match_meanings(const meaning *there, uint32_t there_count, const meaning *here,
    uint32_t here_count, uint32_t *of_part, sbfi_bone_match *matches) {
  for (uint32_t i = 0; i < here_count; i++) {
    uint32_t before = 0, own = 0, count = 0;
    if (matches[i].source != SBF_NONE || !here[i].part[0]) continue;
    for (uint32_t k = 0; k < here_count; k++) {
      if (!same_meaning(&here[k], &here[i])) continue;
      before += k < i;
      own++;
    }
    for (uint32_t k = 0; k < there_count; k++)
      if (same_meaning(&there[k], &here[i])) of_part[count++] = k;
    if (count) matches[i].source = (int32_t)of_part[fraction_of(before, own, count)];
  }
}

static sbfi_part part_of(const meaning *m) {
  static const char *const limbs[] = {"shin", "upperarm", "forearm", NULL};
  if (strcmp(m->part, "hips") == 0) return SBFI_PART_HIPS;
  if (strcmp(m->part, "thigh") == 0) return SBFI_PART_THIGH;
  if (strcmp(m->part, "hand") == 0) return SBFI_PART_HAND;
  return is_among(m->part, limbs) ? SBFI_PART_LIMB : SBFI_PART_OTHER;
}

static bool has_hips(const sbf_asset *asset, const sbfi_bone_match *matches) {
  for (uint32_t i = 0; i < asset->bones.count; i++)
    if (matches[i].part == SBFI_PART_HIPS) return true;
  return false;
}

/* Parts of a chain called leg or arm if their own names are unknown: the two main bones, those before (a
 * collar bone), those after (hand or foot). Legs hang on hips. */
static void name_parts_by_chains(const sbf_asset *to, sbfi_bone_match *matches) {
  for (uint32_t i = 0; i < to->retarget_chains.count; i++) {
    const sbf_u32_list bones = to->retarget_chains.at[i].bones;
    meaning m;
    read_meaning(to->retarget_chains.at[i].name, &m);
    bool leg = strcmp(m.part, "leg") == 0, arm = strcmp(m.part, "arm") == 0;
    if (bones.count < 2 || (!leg && !arm)) continue;
    uint32_t upper = arm && bones.count > 3 ? bones.count - 3 : 0;
    const sbfi_part parts[3] = {
        leg ? SBFI_PART_THIGH : SBFI_PART_LIMB, SBFI_PART_LIMB, arm ? SBFI_PART_HAND : SBFI_PART_OTHER};
    for (uint32_t k = 0; k < 3 && upper + k < bones.count; k++) {
      sbfi_bone_match *match = &matches[bones.at[upper + k]];
      if (match->part == SBFI_PART_OTHER) match->part = parts[k];
    }
    int32_t limb_root = to->bones.at[bones.at[0]].parent;
    if (leg && limb_root != SBF_NONE && !has_hips(to, matches)) matches[limb_root].part = SBFI_PART_HIPS;
  }
}

int64_t sbfi_match_bones(
    const sbf_asset *from, const sbf_asset *to, sbfi_arena *scratch, sbfi_bone_match *matches) {
  meaning *there = meanings_of(from, scratch), *here = meanings_of(to, scratch);
  uint32_t *of_part = sbfi_arena_allocate(scratch, from->bones.count + 1, sizeof *of_part);
  if (!there || !here || !of_part) return -1;
  for (uint32_t i = 0; i < to->bones.count; i++)
    matches[i] = (sbfi_bone_match){.source = SBF_NONE, .part = part_of(&here[i])};
  match_chains(from, to, matches);
  name_parts_by_chains(to, matches);
  match_names(from, to, matches);
  match_meanings(there, from->bones.count, here, to->bones.count, of_part, matches);
  int64_t count = 0;
  for (uint32_t i = 0; i < to->bones.count; i++) count += matches[i].source != SBF_NONE;
  return count;
}
