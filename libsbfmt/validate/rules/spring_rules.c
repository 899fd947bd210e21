/* Checks springs: two different points, positive length, no duplicates, not between two pinned points. */
#include <math.h>

#include "build/springs/pair_set.h"
#include "validate/rules/pin_states.h"
#include "validate/rules/strain_order.h"
#include "validate/validation.h"

/* A spring with an initial length outside these fractions of its rest length jerks. */
static const double MAX_STRETCH = 2, MIN_STRETCH = 0.5;

typedef struct spring_level {
  sbfi_validation *v;
  const sbf_level *at;
  uint8_t *pin_states;
  const char *path;
} spring_level;

static double distance_at_rest(const sbf_level *level, const uint32_t ends[2]) {
  sbf_vec3 a = level->positions.at[ends[0]], b = level->positions.at[ends[1]];
  double x = (double)a.x - b.x, y = (double)a.y - b.y, z = (double)a.z - b.z;
  return sqrt(x * x + y * y + z * z);
}

static void check_length(const spring_level *l, const sbf_spring_set *set, uint32_t i, const char *path) {
  double distance = distance_at_rest(l->at, set->ends.at[i].at);
  double rest = set->rest_lengths.count ? (double)set->rest_lengths.at[i] : distance;
  if (rest == 0)
    sbfi_found(l->v, SBF_CODE_SPRING_NO_LENGTH, path, i, "spring %u has no rest length", i);
  else if (distance > MAX_STRETCH * rest || distance < MIN_STRETCH * rest)
    sbfi_found(l->v, SBF_CODE_SPRING_STRAINED, path, i,
        "spring %u has the rest length %.4g m and is %.4g m long at rest", i, rest, distance);
}

static void check_set(const spring_level *l, uint32_t number) {
  const sbf_spring_set *set = &l->at->springs.at[number];
  sbfi_path path = sbfi_path_of("%s/spring_set[%u]", l->path, number + 1);
  sbfi_path ends = sbfi_path_of("%s/ends", path.text), stiffness = sbfi_path_of("%s/stiffness", path.text);
  for (uint32_t i = 0; i < set->ends.count; i++) {
    const uint32_t *p = set->ends.at[i].at;
    if (p[0] == p[1]) {
      sbfi_found(
          l->v, SBF_CODE_SPRING_SAME_POINT, ends.text, i, "spring %u joins point %u to itself", i, p[0]);
      continue;
    }
    check_length(l, set, i, ends.text);
    if (l->pin_states[p[0]] == SBFI_PINNED && l->pin_states[p[1]] == SBFI_PINNED)
      sbfi_found(l->v, SBF_CODE_SPRING_INERT, ends.text, i, "spring %u joins two pinned points, %u and %u", i,
          p[0], p[1]);
  }
  for (uint32_t i = 0; i < set->stiffness.count && set->ends.count; i++)
    if (set->stiffness.at[i] == 0)
      sbfi_found(l->v, SBF_CODE_SPRING_LIMP, stiffness.text, i,
          set->stiffness.count < set->ends.count ? "the springs of the set have a stiffness of 0"
                                                 : "spring %u has a stiffness of 0",
          i);
  if (l->at->model != SBF_ELASTIC_MODEL_SPRINGS && !set->extra && set->ends.count)
    sbfi_found(l->v, SBF_CODE_SPRING_IDLE, path.text, -1,
        "the %s springs belong to a level of another model and are not marked extra",
        sbf_spring_kind_name(set->kind));
  sbfi_check_strain_order(l->v,
      &(sbfi_strains){set->strain_min, set->strain_max, set->yield_strain, set->tear_strain}, path.text);
}

static void find_duplicates(const spring_level *l) {
  size_t count = 0;
  const sbf_spring_set_list sets = l->at->springs;
  sbfi_pair_set known;
  for (uint32_t s = 0; s < sets.count; s++) count += sets.at[s].ends.count;
  if (count == 0) return;
  if (!sbfi_pair_set_init(&known, count, &l->v->scratch)) {
    l->v->out_of_memory = true;
    return;
  }
  for (uint32_t s = 0, number = 0; s < sets.count; s++) {
    sbfi_path path = sbfi_path_of("%s/spring_set[%u]/ends", l->path, s + 1);
    for (uint32_t i = 0; i < sets.at[s].ends.count; i++, number++) {
      const uint32_t *p = sets.at[s].ends.at[i].at;
      if (p[0] == p[1]) continue;
      uint32_t first = sbfi_pair_set_add(&known, p[0], p[1], number), set = 0;
      if (first == number) continue;
      for (; first >= sets.at[set].ends.count; set++) first -= sets.at[set].ends.count;
      sbfi_found(l->v, SBF_CODE_SPRING_DUPLICATE, path.text, i,
          "points %u and %u are already joined by spring %u of set %u", p[0], p[1], first, set + 1);
    }
  }
}

static void check_level(sbfi_validation *v, const sbf_level *level, const char *path) {
  spring_level l = {v, level, sbfi_scratch(v, level->positions.count, 1), path};
  if (!l.pin_states) return;
  sbfi_find_pin_states(level, l.pin_states);
  for (uint32_t s = 0; s < level->springs.count; s++) check_set(&l, s);
  find_duplicates(&l);
  if (level->model == SBF_ELASTIC_MODEL_SPRINGS && level->springs.count == 0)
    sbfi_found(v, SBF_CODE_LEVEL_EMPTY, path, -1, "the level's model is springs, but it has none");
}

void sbfi_check_springs(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < v->asset->soft_bodies.at[b].levels.count && !v->out_of_memory; l++)
      check_level(v, &v->asset->soft_bodies.at[b].levels.at[l],
          sbfi_path_of("/sbf/soft_body[%u]/level[%u]", b + 1, l + 1).text);
}
