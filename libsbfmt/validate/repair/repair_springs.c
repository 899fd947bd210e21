/* Removes springs without effect: from a point to itself or between two pinned points; of identical
 * springs it keeps the first. */
#include "build/springs/pair_set.h"
#include "validate/repair/repair.h"
#include "validate/rules/pin_states.h"

/* A spring as set and index. */
typedef struct spring {
  const sbf_spring_set *set;
  uint32_t index;
} spring;

static float stated(sbf_f32_list values, uint32_t index) {
  return values.count == 0 ? -1 : values.at[values.count == 1 ? 0 : index];
}

static bool are_equal(spring a, spring b) {
  return stated(a.set->rest_lengths, a.index) == stated(b.set->rest_lengths, b.index) &&
         stated(a.set->stiffness, a.index) == stated(b.set->stiffness, b.index) &&
         stated(a.set->damping, a.index) == stated(b.set->damping, b.index) &&
         stated(a.set->compression_ratio, a.index) == stated(b.set->compression_ratio, b.index) &&
         a.set->extra == b.set->extra && a.set->strain_min == b.set->strain_min &&
         a.set->strain_max == b.set->strain_max && a.set->yield_strain == b.set->yield_strain &&
         a.set->tear_strain == b.set->tear_strain;
}

static spring spring_of(const sbf_level *level, uint32_t number) {
  uint32_t set = 0;
  for (; number >= level->springs.at[set].ends.count; set++) number -= level->springs.at[set].ends.count;
  return (spring){&level->springs.at[set], number};
}

typedef struct dropping {
  sbfi_repair *m;
  const sbf_level *level;
  uint8_t *pin_states, *dropped; /* dropped: of all sets, concatenated */
  sbfi_pair_set known;           /* numbers of springs over all sets */
  const char *path;
} dropping;

static void evaluate_set(dropping *d, uint32_t number, uint32_t begin) {
  const sbf_spring_set *set = &d->level->springs.at[number];
  uint32_t same = 0, inert = 0, repeated = 0, firsts[3] = {0, 0, 0};
  for (uint32_t i = 0; i < set->ends.count; i++) {
    const uint32_t *p = set->ends.at[i].at;
    uint8_t *dropped = &d->dropped[begin + i];
    if (p[0] == p[1]) {
      *dropped = 1;
      if (same++ == 0) firsts[0] = i;
    } else if (d->pin_states[p[0]] == SBFI_PINNED && d->pin_states[p[1]] == SBFI_PINNED) {
      *dropped = 1;
      if (inert++ == 0) firsts[1] = i;
    } else {
      uint32_t first = sbfi_pair_set_add(&d->known, p[0], p[1], begin + i);
      if (first == begin + i || !are_equal(spring_of(d->level, first), (spring){set, i})) continue;
      *dropped = 1;
      if (repeated++ == 0) firsts[2] = i;
    }
  }
  ((sbf_spring_set *)sbfi_writable(set))->inert_count += inert;
  sbfi_path path = sbfi_path_of("%s/spring_set[%u]/ends", d->path, number + 1);
  sbfi_count_repair(d->m, SBF_CODE_SPRING_SAME_POINT, same, path.text, firsts[0],
      "%u spring%s from a point to itself removed", same, sbfi_plural(same));
  sbfi_count_repair(d->m, SBF_CODE_SPRING_INERT, inert, path.text, firsts[1],
      "%u spring%s between pinned points removed", inert, sbfi_plural(inert));
  sbfi_count_repair(d->m, SBF_CODE_SPRING_DUPLICATE, repeated, path.text, firsts[2],
      "%u repeated spring%s removed", repeated, sbfi_plural(repeated));
}

static void drop_values(sbf_f32_list *values, const uint8_t *dropped) {
  if (values->count > 1) sbfi_list_drop(values, sizeof *values->at, dropped);
}

static void drop_springs(sbf_spring_set *set, const uint8_t *dropped) {
  uint32_t kept = 0, count = set->ends.count;
  for (uint32_t i = 0; i < count; i++) kept += !dropped[i];
  if (kept == count) return;
  sbfi_colors_drop(&set->color_counts, dropped, count);
  if (set->rest_lengths.count) sbfi_list_drop(&set->rest_lengths, sizeof *set->rest_lengths.at, dropped);
  drop_values(&set->stiffness, dropped);
  drop_values(&set->damping, dropped);
  drop_values(&set->compression_ratio, dropped);
  sbfi_list_drop(&set->ends, sizeof *set->ends.at, dropped);
}

static void repair_level(sbfi_repair *m, const sbf_level *level, const char *path) {
  size_t count = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) count += level->springs.at[s].ends.count;
  dropping d = {.m = m,
      .level = level,
      .pin_states = sbfi_repair_scratch(m, level->positions.count, 1),
      .dropped = sbfi_repair_scratch(m, count, 1),
      .path = path};
  if (!d.pin_states || !d.dropped) return;
  if (!sbfi_pair_set_init(&d.known, count, &m->scratch)) {
    m->out_of_memory = true;
    return;
  }
  sbfi_find_pin_states(level, d.pin_states);
  for (uint32_t s = 0, begin = 0; s < level->springs.count; begin += level->springs.at[s++].ends.count)
    evaluate_set(&d, s, begin);
  for (uint32_t s = 0, begin = 0; s < level->springs.count; s++) {
    uint32_t in_set = level->springs.at[s].ends.count;
    drop_springs(sbfi_writable(&level->springs.at[s]), d.dropped + begin);
    begin += in_set;
  }
}

void sbfi_repair_springs(sbfi_repair *m) {
  for (uint32_t b = 0; b < m->asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < m->asset->soft_bodies.at[b].levels.count && !m->out_of_memory; l++) {
      sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]/level[%u]", b + 1, l + 1);
      repair_level(m, &m->asset->soft_bodies.at[b].levels.at[l], path.text);
    }
}
