#include "build/weights/surface_laplacian.h"

#include <stdlib.h>

#include "build/geometry/box_tree.h"

/* Minimum distance up to which sites of a shell are tied to the nearest site of another; otherwise up to
 * twice the smallest such distance of the shell. */
static const double TIE_DISTANCE = 0.01, TIE_WEIGHT = 2;

typedef struct entry {
  uint32_t row, column;
  double value;
} entry;

typedef struct other_shells {
  const sbfi_weight_mesh *mesh;
  uint32_t shell;
} other_shells;

static int compare_entries(const void *left, const void *right) {
  const entry *a = left, *b = right;
  if (a->row != b->row) return a->row < b->row ? -1 : 1;
  if (a->column != b->column) return a->column < b->column ? -1 : 1;
  return a->value < b->value ? -1 : a->value > b->value; /* so that sums do not depend on the sort */
}

static bool add_both(sbfi_array *entries, uint32_t a, uint32_t b, double value) {
  const entry pair[2] = {{a, b, value}, {b, a, value}};
  return sbfi_array_append(entries, pair, 2);
}

/* Half the cotangent of each corner belongs to the opposite edge; obtuse corners count as right angles, so
 * that no weight is negative. */
static bool add_triangles(const sbfi_weight_mesh *m, sbfi_array *entries) {
  for (uint32_t t = 0; t < m->triangle_count; t++) {
    const uint32_t *c = m->triangles[t];
    for (int k = 0; k < 3; k++) {
      uint32_t a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      sbfi_d3 apex = sbfi_d3_of(m->sites[c[k]]);
      sbfi_d3 to_a = sbfi_d3_sub(sbfi_d3_of(m->sites[a]), apex),
              to_b = sbfi_d3_sub(sbfi_d3_of(m->sites[b]), apex);
      double sine = sbfi_d3_length(sbfi_d3_cross(to_a, to_b)), cosine = sbfi_d3_dot(to_a, to_b);
      double value = sine > 0 ? fmin(fmax(cosine / sine / 2, 1e-3), 1e3) : 1e-3;
      if (!add_both(entries, a, b, value)) return false;
    }
  }
  return true;
}

static double distance_to_other(const void *user, uint32_t site, const double point[3]) {
  const other_shells *of = user;
  if (of->mesh->shell_of_site[site] == of->shell) return INFINITY;
  sbfi_d3 separation =
      sbfi_d3_sub(sbfi_d3_of(of->mesh->sites[site]), (sbfi_d3){point[0], point[1], point[2]});
  return sbfi_d3_dot(separation, separation);
}

static bool tie_shells(const sbfi_weight_mesh *m, sbfi_array *entries, sbfi_arena *arena) {
  if (m->shell_count < 2) return true;
  sbfi_box_tree tree;
  sbfi_box *boxes = sbfi_arena_allocate(arena, m->site_count, sizeof *boxes);
  uint32_t *other = sbfi_arena_allocate(arena, m->site_count, sizeof *other);
  double *squared = sbfi_arena_allocate(arena, m->site_count, sizeof *squared);
  if (!boxes || !other || !squared) return false;
  for (uint32_t i = 0; i < m->site_count; i++) {
    sbf_vec3 at = m->sites[i];
    boxes[i] = (sbfi_box){{at.x, at.y, at.z}, {at.x, at.y, at.z}};
  }
  if (!sbfi_box_tree_build(&tree, boxes, m->site_count, arena)) return false;
  for (uint32_t s = 0; s < m->shell_count; s++) {
    const uint32_t *sites = m->sites_by_shell + m->shells[s].first_site;
    const other_shells of = {m, s};
    double min = INFINITY;
    for (uint32_t i = 0; i < m->shells[s].site_count; i++) {
      sbf_vec3 at = m->sites[sites[i]];
      /* The maximum distance at which sites are tied. */
      double within = fmax(4 * min, TIE_DISTANCE * TIE_DISTANCE);
      squared[i] = isfinite(min) ? within * (1 + 1e-9) : INFINITY;
      other[i] = sbfi_box_tree_nearest(
          &tree, (double[]){(double)at.x, (double)at.y, (double)at.z}, distance_to_other, &of, &squared[i]);
      if (other[i] != UINT32_MAX) min = fmin(min, squared[i]);
    }
    double max = fmax(4 * min, TIE_DISTANCE * TIE_DISTANCE);
    for (uint32_t i = 0; i < m->shells[s].site_count; i++)
      if (other[i] != UINT32_MAX && squared[i] <= max && !add_both(entries, sites[i], other[i], TIE_WEIGHT))
        return false;
  }
  return true;
}

static bool collect(
    sbfi_surface_laplacian *l, const sbfi_weight_mesh *m, sbfi_array *entries, sbfi_arena *arena) {
  entry *all = entries->at;
  qsort(all, entries->count, sizeof *all, compare_entries);
  size_t count = 0;
  for (size_t i = 0; i < entries->count; i++) {
    if (count && all[count - 1].row == all[i].row && all[count - 1].column == all[i].column)
      all[count - 1].value += all[i].value;
    else
      all[count++] = all[i];
  }
  l->begins = sbfi_arena_allocate(arena, (size_t)m->site_count + 1, sizeof *l->begins);
  l->columns = sbfi_arena_allocate(arena, count + 1, sizeof *l->columns);
  l->values = sbfi_arena_allocate(arena, count + 1, sizeof *l->values);
  l->diagonal = sbfi_arena_allocate(arena, m->site_count, sizeof *l->diagonal);
  if (!l->begins || !l->columns || !l->values || !l->diagonal) return false;
  for (size_t i = 0; i < count; i++) {
    l->begins[all[i].row + 1]++;
    l->columns[i] = all[i].column;
    l->values[i] = all[i].value;
    l->diagonal[all[i].row] += all[i].value;
  }
  for (uint32_t i = 0; i < m->site_count; i++) l->begins[i + 1] += l->begins[i];
  return true;
}

bool sbfi_surface_laplacian_make(sbfi_surface_laplacian *l, const sbfi_weight_mesh *m, sbfi_arena *arena) {
  sbfi_array entries;
  *l = (sbfi_surface_laplacian){0};
  sbfi_array_init(&entries, &arena->allocator, sizeof(entry));
  bool good = sbfi_array_reserve(&entries, 6 * (size_t)m->triangle_count) && add_triangles(m, &entries) &&
              tie_shells(m, &entries, arena) && collect(l, m, &entries, arena);
  sbfi_array_free(&entries);
  return good;
}
