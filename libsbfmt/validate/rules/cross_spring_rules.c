/* Checks springs between bodies: existing levels and points, two different bodies, positive length, no
 * duplicates. */
#include "build/geometry/key_set.h"
#include "mechanics/vector.h"
#include "validate/rules/pin_states.h"
#include "validate/validation.h"

typedef struct side {
  const sbf_level *level; /* NULL: missing */
  uint8_t *pin_states;
} side;

static side side_of(sbfi_validation *v, int32_t body, uint32_t level, const char *path, char letter) {
  const sbf_soft_body *at = &v->asset->soft_bodies.at[body];
  side s = {NULL, NULL};
  if (level >= at->levels.count) {
    sbfi_found(v, SBF_CODE_CROSS_SPRING_LEVEL, path, -1, "level_%c is %u, but '%s' has %u level%s", letter,
        level, sbfi_label(at->name, at->id), at->levels.count, sbfi_plural(at->levels.count));
    return s;
  }
  s.level = &at->levels.at[level];
  s.pin_states = sbfi_scratch(v, s.level->positions.count, 1);
  if (s.pin_states) sbfi_find_pin_states(s.level, s.pin_states);
  return s;
}

static bool is_there(sbfi_validation *v, const side *s, uint32_t point, uint32_t spring, const char *path) {
  if (point < s->level->positions.count) return true;
  sbfi_found(v, SBF_CODE_CROSS_SPRING_POINT, path, spring,
      "spring %u names point %u, but the level has %u points", spring, point, s->level->positions.count);
  return false;
}

static void check_spring(sbfi_validation *v, const sbf_cross_springs *set, const side *a, const side *b,
    uint32_t i, const char *path) {
  const uint32_t *p = set->ends.at[i].at;
  if (!is_there(v, a, p[0], i, path) || !is_there(v, b, p[1], i, path)) return;
  sbfi_d3 direction =
      sbfi_d3_sub(sbfi_d3_of(a->level->positions.at[p[0]]), sbfi_d3_of(b->level->positions.at[p[1]]));
  double rest = set->rest_lengths.count ? (double)set->rest_lengths.at[i] : sbfi_d3_length(direction);
  if (rest == 0)
    sbfi_found(v, SBF_CODE_SPRING_NO_LENGTH, path, i, "spring %u between two bodies has no rest length", i);
  if (a->pin_states[p[0]] == SBFI_PINNED && b->pin_states[p[1]] == SBFI_PINNED)
    sbfi_found(
        v, SBF_CODE_SPRING_INERT, path, i, "spring %u joins two pinned points, %u and %u", i, p[0], p[1]);
}

static void find_duplicates(sbfi_validation *v, const sbf_cross_springs *set, const char *path) {
  sbfi_key_set known;
  if (!sbfi_key_set_init(&known, set->ends.count, &v->scratch)) {
    v->out_of_memory = true;
    return;
  }
  for (uint32_t i = 0; i < set->ends.count; i++) {
    const uint32_t *p = set->ends.at[i].at;
    uint32_t *first = sbfi_key_set_find(&known, (sbfi_key){{p[0], p[1], 0, 0}});
    if (*first == UINT32_MAX)
      *first = i;
    else
      sbfi_found(v, SBF_CODE_SPRING_DUPLICATE, path, i, "points %u and %u are already joined by spring %u",
          p[0], p[1], *first);
  }
}

void sbfi_check_cross_springs(sbfi_validation *v) {
  for (uint32_t c = 0; c < v->asset->cross_springs.count && !v->out_of_memory; c++) {
    const sbf_cross_springs *set = &v->asset->cross_springs.at[c];
    sbfi_path path = sbfi_path_of("/sbf/cross_springs[%u]", c + 1), ends = sbfi_path_of("%s/ends", path.text);
    side a = side_of(v, set->body_a, set->level_a, path.text, 'a');
    side b = side_of(v, set->body_b, set->level_b, path.text, 'b');
    if (set->body_a == set->body_b && set->level_a == set->level_b)
      sbfi_found(v, SBF_CODE_CROSS_SPRING_ONE_BODY, path.text, -1, "both ends are points of '%s'",
          sbfi_label(v->asset->soft_bodies.at[set->body_a].name, v->asset->soft_bodies.at[set->body_a].id));
    for (uint32_t i = 0; a.pin_states && b.pin_states && i < set->ends.count; i++)
      check_spring(v, set, &a, &b, i, ends.text);
    for (uint32_t i = 0; i < set->stiffness.count && set->ends.count; i++)
      if (set->stiffness.at[i] == 0)
        sbfi_found(
            v, SBF_CODE_SPRING_LIMP, sbfi_path_of("%s/stiffness", path.text).text, i, "the stiffness is 0");
    if (!v->out_of_memory) find_duplicates(v, set, ends.text);
  }
}
