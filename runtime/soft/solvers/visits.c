/* Spring order of the relaxation scheme, whose result depends on it. Internal springs come first, as listed.
 * Structural and then shear springs follow, each by a walk over the points that visits every spring of a
 * point in the order listed. Each of these springs is thus visited twice, once from each end. */
#include "soft/solvers/visits.h"

#include <math.h>

typedef struct visit_list {
  const sbri_island *island;
  const sbri_body *body;
  sbri_visit *at;
  uint32_t count;
} visit_list;

static float rest_length(const sbri_body *body, const sbf_spring_set *set, uint32_t i) {
  if (set->rest_lengths.count) return set->rest_lengths.at[i];
  sbf_vec3 a = body->level->positions.at[set->ends.at[i].at[0]],
           b = body->level->positions.at[set->ends.at[i].at[1]];
  float x = b.x - a.x, y = b.y - a.y, z = b.z - a.z;
  return sqrtf(x * x + y * y + z * z);
}

static void add(visit_list *list, const sbf_spring_set *set, uint32_t i, int from) {
  uint32_t a = list->body->slots.from_point[set->ends.at[i].at[from]];
  uint32_t b = list->body->slots.from_point[set->ends.at[i].at[!from]];
  if (a >= list->island->free_count && b >= list->island->free_count) return;
  list->at[list->count++] = (sbri_visit){a, b, rest_length(list->body, set, i)};
}

/* Springs at each point, over all sets of one kind: `begins` (points + 1), `members` as set and index. */
typedef struct point_springs {
  uint32_t *begins;
  sbf_uint2 *members; /* twice the index in the set, plus the point's end of the spring; and the set */
} point_springs;

static bool sort_by_point(
    point_springs *p, const sbf_level *level, sbf_spring_kind kind, sbfi_arena *scratch) {
  uint32_t points = level->positions.count;
  p->begins = sbfi_arena_allocate(scratch, (size_t)points + 2, sizeof *p->begins);
  if (!p->begins) return false;
  size_t total = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    if (set->kind != kind) continue;
    total += 2 * (size_t)set->ends.count;
    for (uint32_t i = 0; i < set->ends.count; i++)
      for (int end = 0; end < 2; end++) p->begins[set->ends.at[i].at[end] + 2]++;
  }
  for (uint32_t i = 0; i < points; i++) p->begins[i + 2] += p->begins[i + 1];
  p->members = sbfi_arena_allocate(scratch, total ? total : 1, sizeof *p->members);
  if (!p->members) return false;
  for (uint32_t s = 0; s < level->springs.count; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    for (uint32_t i = 0; set->kind == kind && i < set->ends.count; i++)
      for (int end = 0; end < 2; end++)
        p->members[p->begins[set->ends.at[i].at[end] + 1]++] = (sbf_uint2){{2 * i + (uint32_t)end, s}};
  }
  return true;
}

static bool walk(visit_list *list, sbf_spring_kind kind, sbfi_arena *scratch) {
  const sbf_level *level = list->body->level;
  point_springs p;
  if (!sort_by_point(&p, level, kind, scratch)) return false;
  for (uint32_t point = 0; point < level->positions.count; point++)
    for (uint32_t i = p.begins[point]; i < p.begins[point + 1]; i++) {
      const uint32_t *member = p.members[i].at;
      add(list, &level->springs.at[member[1]], member[0] / 2, (int)(member[0] % 2));
    }
  return true;
}

bool sbri_visits_make(sbr_model *model, sbri_island *island) {
  size_t max = 0;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbf_level *level = model->bodies[island->bodies[b]].level;
    for (uint32_t s = 0; s < level->springs.count; s++) max += 2 * (size_t)level->springs.at[s].ends.count;
  }
  visit_list list = {.island = island};
  list.at = sbfi_arena_allocate(&model->arena, max ? max : 1, sizeof *list.at);
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  bool good = list.at != NULL;
  for (uint32_t b = 0; good && b < island->body_count; b++) {
    list.body = &model->bodies[island->bodies[b]];
    const sbf_level *level = list.body->level;
    for (uint32_t s = 0; s < level->springs.count; s++) {
      const sbf_spring_set *set = &level->springs.at[s];
      for (uint32_t i = 0; set->kind == SBF_SPRING_KIND_INTERNAL && i < set->ends.count; i++)
        add(&list, set, i, 0);
    }
    good = walk(&list, SBF_SPRING_KIND_STRUCTURAL, &scratch) && walk(&list, SBF_SPRING_KIND_SHEAR, &scratch);
  }
  sbfi_arena_free(&scratch);
  island->springs.visits = list.at;
  island->springs.visit_count = list.count;
  return good;
}
