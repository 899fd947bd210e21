/* Element forces of a large island, computed by several tasks.
 *
 * Each task computes a range of blocks (model/elements.h, sbri_force_parts). Points that only one part
 * touches, or the first of several, receive their forces directly; other parts store each of their forces in
 * an entry, and sbri_join_forces adds these in the order of the blocks. So every sum has the order, and the
 * bits, of one task that computes all.
 *
 * Between two substeps the sums and entries are 0: sbri_divided_begin clears them at the beginning of the
 * tick, and the reader of a range of sums clears it.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_DIVIDED_FORCES_H
#define SBRI_DIVIDED_FORCES_H

#include "soft/solvers/tetrahedron_forces.h"

/* Whether several tasks compute the forces of the tetrahedra. */
static inline bool sbri_are_forces_divided(const sbri_island_tick *t) {
  bool divided = t->tasks && t->island->tetrahedra.parts && !t->reactions;
  for (uint32_t b = 0; divided && b < t->island->body_count; b++) /* keeping a volume uses element_forces */
    divided = !t->model->bodies[t->island->bodies[b]].volume.is_preserved;
  return divided;
}

static inline void sbri_divided_begin(const sbri_island_tick *t) {
  if (!sbri_are_forces_divided(t)) return;
  const sbri_force_parts *parts = t->island->tetrahedra.parts;
  memset(t->scratch.element_forces, 0, t->island->slot_count * sizeof *t->scratch.element_forces);
  memset(t->scratch.element_forces + parts->first_entry, 0,
      parts->entry_count * sizeof *t->scratch.element_forces);
}

typedef struct sbri_force_work {
  const sbri_island_tick *tick;
  bool checks;
  sbri_tetrahedron_watch watches[SBRI_MAX_PARTS];
} sbri_force_work;

/* A task. */
static inline void sbri_force_part(void *context, uint32_t part) {
  sbri_force_work *work = context;
  const sbri_force_parts *parts = work->tick->island->tetrahedra.parts;
  sbri_tetrahedron_watch watch; /* its own, so that tasks do not write to one cache line */
  sbri_watch_begin(&watch);
  sbri_add_tetrahedron_forces(
      work->tick, work->checks ? &watch : NULL, parts, parts->begins[part], parts->begins[part + 1]);
  work->watches[part] = watch;
}

/* The same as sbri_tetrahedron_pass, except that entries remain to be joined. */
static inline void sbri_divided_tetrahedron_pass(const sbri_island_tick *t, bool checks) {
  sbri_force_work work = {.tick = t, .checks = checks};
  uint32_t count = t->island->tetrahedra.parts->count;
  float stiffening = 1, min_ratio = 1;
  sbri_run_tasks(t, sbri_force_part, &work, count);
  for (uint32_t p = 0; p < count && checks; p++) {
    float stiffest = sbri_watch_stiffening(&work.watches[p]), min = sbri_watch_min_ratio(&work.watches[p]);
    stiffening = stiffest > stiffening ? stiffest : stiffening;
    min_ratio = min < min_ratio ? min : min_ratio;
  }
  if (checks) *t->solids.stiffening = stiffening, *t->solids.min_ratio = min_ratio;
}

/* Adds the entries of the slots from `begin` to `end` and clears them. */
static inline void sbri_join_forces(const sbri_island_tick *t, uint32_t begin, uint32_t end) {
  const sbri_force_parts *parts = t->island->tetrahedra.parts;
  sbri_point *sums = t->scratch.element_forces, *entries = sums + parts->first_entry;
  uint32_t low = 0, high = parts->shared_count;
  while (low < high) { /* the first shared slot that is not before `begin` */
    uint32_t middle = low + (high - low) / 2;
    if (parts->shared_slots[middle] < begin)
      low = middle + 1;
    else
      high = middle;
  }
  for (uint32_t i = low; i < parts->shared_count && parts->shared_slots[i] < end; i++) {
    sbri_point sum = sums[parts->shared_slots[i]];
    for (uint32_t e = parts->entry_begins[i]; e < parts->entry_begins[i + 1]; e++) {
      sum.x += entries[e].x, sum.y += entries[e].y, sum.z += entries[e].z;
      entries[e] = (sbri_point){0, 0, 0, 0};
    }
    sums[parts->shared_slots[i]] = sum;
  }
}

/* Clears the sums of the slots from `begin` to `end`. */
static inline void sbri_clear_forces(const sbri_island_tick *t, uint32_t begin, uint32_t end) {
  memset(t->scratch.element_forces + begin, 0, (end - begin) * sizeof *t->scratch.element_forces);
}

#endif
