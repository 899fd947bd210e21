/* Springs: between two different points, of some length, each pair once, not between two held points. */
#include <stdlib.h>

#include "sbfmt/mechanics.h"
#include "validate/validation.h"

typedef struct pair {
  uint32_t low, high, set, place;
} pair;

static int compare_pairs(const void *a, const void *b) {
  const pair *x = a, *y = b;
  if (x->low != y->low) return x->low < y->low ? -1 : 1;
  if (x->high != y->high) return x->high < y->high ? -1 : 1;
  if (x->set != y->set) return x->set < y->set ? -1 : 1;
  return x->place < y->place ? -1 : x->place > y->place;
}

static double rest_length(const sbf_level *level, const sbf_spring_set *set, uint32_t i) {
  if (set->rest_lengths.count) return (double)set->rest_lengths.at[i];
  sbf_vec3 a = level->positions.at[set->ends.at[i].at[0]], b = level->positions.at[set->ends.at[i].at[1]];
  return a.x == b.x && a.y == b.y && a.z == b.z ? 0 : 1;
}

static void check_set(sbfi_validation *v, const sbf_level *level, const sbf_spring_set *set,
    const uint8_t *held, const char *path) {
  for (uint32_t i = 0; i < set->ends.count; i++) {
    const uint32_t *p = set->ends.at[i].at;
    if (p[0] == p[1])
      sbfi_found(v, SBF_CODE_SPRING_SAME_POINT, path, i, "spring %u joins point %u to itself", i, p[0]);
    else if (rest_length(level, set, i) == 0)
      sbfi_found(v, SBF_CODE_SPRING_NO_LENGTH, path, i, "spring %u has no rest length", i);
    if (p[0] != p[1] && held[p[0]] && held[p[1]])
      sbfi_found(
          v, SBF_CODE_SPRING_INERT, path, i, "spring %u joins two held points, %u and %u", i, p[0], p[1]);
  }
}

static void find_duplicates(sbfi_validation *v, const sbf_level *level, uint32_t body, uint32_t place) {
  size_t count = 0, at = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) count += level->springs.at[s].ends.count;
  if (count == 0) return;
  pair *pairs = sbfi_arena_allocate(&v->scratch, count, sizeof *pairs);
  if (!pairs) {
    v->out_of_memory = true;
    return;
  }
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++) {
      const uint32_t *p = level->springs.at[s].ends.at[i].at;
      bool turned = p[0] > p[1];
      pairs[at++] = (pair){p[turned], p[!turned], s, i};
    }
  qsort(pairs, count, sizeof *pairs, compare_pairs);
  for (size_t i = 1; i < count; i++)
    if (pairs[i].low == pairs[i - 1].low && pairs[i].high == pairs[i - 1].high)
      sbfi_found(v, SBF_CODE_SPRING_DUPLICATE,
          sbfi_path_of("/sbf/soft_body[%u]/level[%u]/spring_set[%u]", body + 1, place + 1, pairs[i].set + 1)
              .text,
          pairs[i].place, "points %u and %u are joined already by spring %u of set %u", pairs[i].low,
          pairs[i].high, pairs[i - 1].place, pairs[i - 1].set + 1);
}

static void check_level(sbfi_validation *v, const sbf_level *level, uint32_t body, uint32_t place) {
  uint8_t *held = sbfi_arena_allocate(&v->scratch, level->positions.count + 1u, 1);
  if (!held) {
    v->out_of_memory = true;
    return;
  }
  sbf_level_held_points(level, held);
  for (uint32_t s = 0; s < level->springs.count; s++)
    check_set(v, level, &level->springs.at[s], held,
        sbfi_path_of("/sbf/soft_body[%u]/level[%u]/spring_set[%u]", body + 1, place + 1, s + 1).text);
  find_duplicates(v, level, body, place);
  if (level->model == SBF_ELASTIC_MODEL_SPRINGS && level->springs.count == 0)
    sbfi_found(v, SBF_CODE_LEVEL_EMPTY,
        sbfi_path_of("/sbf/soft_body[%u]/level[%u]", body + 1, place + 1).text, -1,
        "the level's model is springs and it has none");
}

void sbfi_check_springs(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < v->asset->soft_bodies.at[b].levels.count && !v->out_of_memory; l++)
      check_level(v, &v->asset->soft_bodies.at[b].levels.at[l], b, l);
}
