#include "build/weights/surface_laplacian.h"

#include <stdlib.h>

#include "build/geometry/box_tree.h"

/* Minimum distance up to which sites of a shell are tied to the nearest site of another; otherwise up to
 * twice the smallest such distance of the shell. */
static const double TIE_DISTANCE = 0.01, TIE_WEIGHT = 2;

typedef struct entry {
  uint32_t column;
  double value;
} entry;

/* Entries by row, counted first and then filled in: a list of all, sorted, would need three times the
 * memory. */
typedef struct rows {
  uint32_t *begins; /* (site_count + 1) */
  uint32_t *ends;   /* (site_count) while they are filled in */
  entry *entries;   /* NULL while they are counted */
} rows;

typedef struct other_shells {
  const sbfi_weight_mesh *mesh;
  uint32_t shell;
} other_shells;

static int compare_entries(const void *left, const void *right) {
  const entry *a = left, *b = right;
  if (a->column != b->column) return a->column < b->column ? -1 : 1;
  return a->value < b->value ? -1 : a->value > b->value; /* so that sums do not depend on the sort */
}

static void add(rows *r, uint32_t row, uint32_t column, double value) {
  if (r->entries)
    r->entries[r->ends[row]++] = (entry){column, value};
  else
    r->begins[row + 1]++;
}

static void add_both(rows *r, uint32_t a, uint32_t b, double value) {
  add(r, a, b, value);
  add(r, b, a, value);
}

/* Half the cotangent of each corner belongs to the opposite edge; obtuse corners count as right angles, so
 * that no weight is negative. */
static void add_triangles(const sbfi_weight_mesh *m, rows *r) {
  for (uint32_t t = 0; t < m->triangle_count; t++) {
    const uint32_t *c = m->triangles[t];
    for (int k = 0; k < 3; k++) {
      uint32_t a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      sbfi_d3 apex = sbfi_d3_of(m->sites[c[k]]);
      sbfi_d3 to_a = sbfi_d3_sub(sbfi_d3_of(m->sites[a]), apex),
              to_b = sbfi_d3_sub(sbfi_d3_of(m->sites[b]), apex);
      double sine = sbfi_d3_length(sbfi_d3_cross(to_a, to_b)), cosine = sbfi_d3_dot(to_a, to_b);
      double value = sine > 0 ? fmin(fmax(cosine / sine / 2, 1e-3), 1e3) : 1e-3;
      add_both(r, a, b, value);
    }
  }
}

static double distance_to_other(const void *user, uint32_t site, const double point[3]) {
  const other_shells *of = user;
  if (of->mesh->shell_of_site[site] == of->shell) return INFINITY;
  sbfi_d3 separation =
      sbfi_d3_sub(sbfi_d3_of(of->mesh->sites[site]), (sbfi_d3){point[0], point[1], point[2]});
  return sbfi_d3_dot(separation, separation);
}

/* Finds the site of another shell to which each site is tied; UINT32_MAX: none. */
static bool find_ties(const sbfi_weight_mesh *m, uint32_t *ties, sbfi_arena *arena) {
  if (m->shell_count < 2) {
    for (uint32_t i = 0; i < m->site_count; i++) ties[i] = UINT32_MAX;
    return true;
  }
  sbfi_box_tree tree;
  sbfi_box *boxes = sbfi_arena_allocate(arena, m->site_count, sizeof *boxes);
  double *squared = sbfi_arena_allocate(arena, m->site_count, sizeof *squared);
  if (!boxes || !squared) return false;
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
      uint32_t *tie = &ties[sites[i]];
      sbf_vec3 at = m->sites[sites[i]];
      /* The maximum distance at which sites are tied. */
      double within = fmax(4 * min, TIE_DISTANCE * TIE_DISTANCE);
      squared[i] = isfinite(min) ? within * (1 + 1e-9) : INFINITY;
      *tie = sbfi_box_tree_nearest(
          &tree, (double[]){(double)at.x, (double)at.y, (double)at.z}, distance_to_other, &of, &squared[i]);
      if (*tie != UINT32_MAX) min = fmin(min, squared[i]);
    }
    double max = fmax(4 * min, TIE_DISTANCE * TIE_DISTANCE);
    for (uint32_t i = 0; i < m->shells[s].site_count; i++)
      if (!(squared[i] <= max)) ties[sites[i]] = UINT32_MAX;
  }
  return true;
}

static void add_ties(const sbfi_weight_mesh *m, const uint32_t *ties, rows *r) {
  for (uint32_t i = 0; i < m->site_count; i++)
    if (ties[i] != UINT32_MAX) add_both(r, i, ties[i], TIE_WEIGHT);
}

/* Sorts each row and adds up entries of the same column. Returns the number of entries left. */
static size_t merge_entries(rows *r, uint32_t row_count) {
  size_t count = 0;
  for (uint32_t row = 0; row < row_count; row++) {
    entry *at = r->entries + r->begins[row];
    uint32_t old_count = r->ends[row] - r->begins[row];
    const size_t first = count;
    qsort(at, old_count, sizeof *at, compare_entries);
    for (uint32_t i = 0; i < old_count; i++) {
      if (count > first && r->entries[count - 1].column == at[i].column)
        r->entries[count - 1].value += at[i].value;
      else
        r->entries[count++] = at[i];
    }
    r->ends[row] = (uint32_t)count;
  }
  return count;
}

static bool collect(
    sbfi_surface_laplacian *l, const rows *r, uint32_t row_count, size_t count, sbfi_arena *arena) {
  l->begins = sbfi_arena_allocate(arena, (size_t)row_count + 1, sizeof *l->begins);
  l->columns = sbfi_arena_allocate(arena, count + 1, sizeof *l->columns);
  l->values = sbfi_arena_allocate(arena, count + 1, sizeof *l->values);
  l->diagonal = sbfi_arena_allocate(arena, row_count, sizeof *l->diagonal);
  if (!l->begins || !l->columns || !l->values || !l->diagonal) return false;
  for (uint32_t row = 0, i = 0; row < row_count; l->begins[++row] = i)
    for (; i < r->ends[row]; i++) {
      l->columns[i] = r->entries[i].column;
      l->values[i] = r->entries[i].value;
      l->diagonal[row] += r->entries[i].value;
    }
  return true;
}

/* Turns the counts into ranges, and allocates the entries. */
static bool begin_rows(rows *r, uint32_t row_count, const sbf_allocator *allocator) {
  for (uint32_t row = 0; row < row_count; row++) {
    if (r->begins[row + 1] > UINT32_MAX - r->begins[row]) return false;
    r->begins[row + 1] += r->begins[row];
    r->ends[row] = r->begins[row];
  }
  r->entries = sbfi_allocate(allocator, ((size_t)r->begins[row_count] + 1) * sizeof *r->entries);
  return r->entries != NULL;
}

bool sbfi_surface_laplacian_make(sbfi_surface_laplacian *l, const sbfi_weight_mesh *m, sbfi_arena *arena) {
  const sbf_allocator *allocator = &arena->allocator;
  rows r = {.begins = sbfi_arena_allocate(arena, (size_t)m->site_count + 1, sizeof *r.begins),
      .ends = sbfi_arena_allocate(arena, (size_t)m->site_count + 1, sizeof *r.ends)};
  uint32_t *ties = sbfi_arena_allocate(arena, (size_t)m->site_count + 1, sizeof *ties);
  *l = (sbfi_surface_laplacian){0};
  if (!r.begins || !r.ends || !ties || !find_ties(m, ties, arena)) return false;
  bool good = true;
  for (int pass = 0; good && pass < 2; pass++) {
    add_triangles(m, &r);
    add_ties(m, ties, &r);
    if (pass == 0) good = begin_rows(&r, m->site_count, allocator);
  }
  good = good && collect(l, &r, m->site_count, merge_entries(&r, m->site_count), arena);
  if (r.entries) sbfi_free(allocator, r.entries, ((size_t)r.begins[m->site_count] + 1) * sizeof *r.entries);
  return good;
}
