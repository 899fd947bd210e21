#include "build/sections/blend_levels.h"

#include <string.h>

#include "mechanics/vector.h"

enum { MAX_POINTS = 16384, MAX_MEMBERS = 8, NO_CLUSTER = -1 };
/* On a scan, three quarters of the time were spent on one triangle in two hundred, mostly thin ones, which
 * contract again and again as their neighbours do, to no end. */
enum { MANY_POINTS = 262144, MAX_CONTRACTIONS = 64 };
/* Maximum ratio of clusters to points for a useful coarse level. */
static const double MAX_CLUSTERS = 0.7;
/* Minimum area of a coarse triangle relative to its squared longest side: thinner ones do not show the
 * surface's stretch. */
static const double MIN_AREA = 0.1;

typedef struct clusters {
  const sbfi_blend_surface *fine;
  int64_t *of_point; /* (points) NO_CLUSTER for a point without triangles */
  uint32_t count;
  uint32_t *begins, *members; /* points of each cluster, (count + 1) and (points) */
} clusters;

/* A sum of rows. */
typedef struct row_sum {
  sbfi_array weights; /* sbfi_blend_weight, in order of addition */
} row_sum;

static bool is_fixed(const sbfi_blend_surface *s, uint32_t point) {
  return s->fixed && s->fixed[point];
}

/* Creates a cluster of a point and its unassigned neighbours. */
static void make_cluster(clusters *c, uint32_t first, uint32_t *next) {
  const sbfi_blend_surface *s = c->fine;
  uint32_t begin = *next;
  c->begins[c->count] = begin;
  c->members[(*next)++] = first;
  c->of_point[first] = c->count;
  for (uint32_t i = s->begins[first]; i < s->begins[first + 1]; i++)
    for (int k = 0; k < 3; k++) {
      uint32_t point = s->triangles[s->at_point[i]][k];
      if (c->of_point[point] != NO_CLUSTER || is_fixed(s, point) != is_fixed(s, first)) continue;
      if (*next - begin == MAX_MEMBERS) break;
      c->of_point[point] = c->count;
      c->members[(*next)++] = point;
    }
  c->count++;
}

static bool make_clusters(clusters *c, sbfi_arena *arena) {
  const sbfi_blend_surface *s = c->fine;
  uint32_t next = 0;
  c->of_point = sbfi_arena_allocate(arena, (size_t)s->point_count + 1, sizeof *c->of_point);
  c->begins = sbfi_arena_allocate(arena, (size_t)s->point_count + 1, sizeof *c->begins);
  c->members = sbfi_arena_allocate(arena, (size_t)s->point_count + 1, sizeof *c->members);
  if (!c->of_point || !c->begins || !c->members) return false;
  for (uint32_t p = 0; p < s->point_count; p++) c->of_point[p] = NO_CLUSTER;
  for (uint32_t p = 0; p < s->point_count; p++)
    if (c->of_point[p] == NO_CLUSTER && s->begins[p + 1] > s->begins[p]) make_cluster(c, p, &next);
  c->begins[c->count] = next;
  return true;
}

static bool add_row(row_sum *sum, const sbfi_blend_row *row, double factor) {
  for (uint32_t i = 0; i < row->count; i++) {
    const sbfi_blend_weight weight = {row->at[i].bone, factor * row->at[i].value};
    if (!sbfi_array_append(&sum->weights, &weight, 1)) return false;
  }
  return true;
}

/* Converts the sum to a row: drops negligible and negative weights, normalizes, and resets the sum. */
static bool finish_row(row_sum *sum, sbfi_blend_row *to, sbfi_arena *arena) {
  sbfi_blend_weight *at = sum->weights.at;
  uint32_t count = (uint32_t)sum->weights.count, merged = 0, kept = 0;
  double total = 0;
  for (uint32_t i = 1; i < count; i++) {
    sbfi_blend_weight moved = at[i];
    uint32_t k = i;
    for (; k > 0 && at[k - 1].bone > moved.bone; k--) at[k] = at[k - 1];
    at[k] = moved;
  }
  for (uint32_t i = 0; i < count; i++)
    if (merged && at[merged - 1].bone == at[i].bone)
      at[merged - 1].value += at[i].value;
    else
      at[merged++] = at[i];
  for (uint32_t i = 0; i < merged; i++)
    if (at[i].value > SBFI_BLEND_NEGLIGIBLE) total += at[i].value, at[kept++] = at[i];
  for (uint32_t i = 0; i < kept; i++) at[i].value /= total;
  if (to->capacity < kept) {
    to->at = sbfi_arena_allocate(arena, kept, sizeof *to->at);
    if (!to->at) return false;
    to->capacity = kept;
  }
  if (kept) memcpy(to->at, at, kept * sizeof *at);
  to->count = kept;
  sum->weights.count = 0;
  return true;
}

/* Mean row of each cluster. */
static sbfi_blend_row *mean_rows(
    const clusters *c, const sbfi_blend_row *from, row_sum *sum, sbfi_arena *arena) {
  sbfi_blend_row *rows = sbfi_arena_allocate(arena, (size_t)c->count + 1, sizeof *rows);
  for (uint32_t i = 0; rows && i < c->count; i++) {
    double members = c->begins[i + 1] - c->begins[i];
    for (uint32_t m = c->begins[i]; m < c->begins[i + 1]; m++)
      if (!add_row(sum, &from[c->members[m]], 1 / members)) return NULL;
    if (!finish_row(sum, &rows[i], arena)) return NULL;
  }
  return rows;
}

static sbf_vec3 middle_of(const clusters *c, uint32_t cluster) {
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t m = c->begins[cluster]; m < c->begins[cluster + 1]; m++)
    sum = sbfi_d3_add(sum, sbfi_d3_of(c->fine->positions[c->members[m]]));
  return sbfi_d3_rounded(sbfi_d3_scale(sum, 1.0 / (c->begins[cluster + 1] - c->begins[cluster])));
}

static bool is_thin(const sbf_vec3 *positions, const uint32_t corners[3]) {
  double longest = 0;
  sbfi_d3 sides[3];
  for (int k = 0; k < 3; k++) {
    sides[k] = sbfi_d3_sub(sbfi_d3_of(positions[corners[(k + 1) % 3]]), sbfi_d3_of(positions[corners[k]]));
    if (sbfi_d3_dot(sides[k], sides[k]) > longest) longest = sbfi_d3_dot(sides[k], sides[k]);
  }
  return !(sbfi_d3_length(sbfi_d3_cross(sides[0], sides[1])) > 2 * MIN_AREA * longest);
}

/* Builds the surface of the clusters. */
static bool make_coarse(sbfi_blend_surface *to, const clusters *c, row_sum *sum, sbfi_arena *arena) {
  const sbfi_blend_surface *s = c->fine;
  sbf_vec3 *positions = sbfi_arena_allocate(arena, (size_t)c->count + 1, sizeof *positions);
  uint8_t *fixed = sbfi_arena_allocate(arena, (size_t)c->count + 1, 1);
  *to = (sbfi_blend_surface){.bones = s->bones,
      .joints = s->joints,
      .point_count = c->count,
      .positions = positions,
      .rows = mean_rows(c, s->rows, sum, arena),
      .before = mean_rows(c, s->before, sum, arena),
      .triangles = sbfi_arena_allocate(arena, (size_t)s->triangle_count + 1, sizeof *to->triangles),
      .soft = s->soft,
      .fixed = fixed,
      .changed = sbfi_arena_allocate(arena, (size_t)c->count + 1, 1)};
  if (!positions || !fixed || !to->rows || !to->before || !to->triangles || !to->changed) return false;
  for (uint32_t i = 0; i < c->count; i++) {
    positions[i] = middle_of(c, i);
    fixed[i] = is_fixed(s, c->members[c->begins[i]]);
  }
  for (uint32_t t = 0; t < s->triangle_count; t++) {
    uint32_t *at = to->triangles[to->triangle_count];
    for (int k = 0; k < 3; k++) at[k] = (uint32_t)c->of_point[s->triangles[t][k]];
    bool whole = at[0] != at[1] && at[1] != at[2] && at[2] != at[0];
    to->triangle_count += whole && !is_thin(positions, at);
  }
  return sbfi_blend_surface_index(to, arena);
}

/* Adds the mean correction of the clusters of the point and of its neighbours. */
static bool correct_point(const clusters *c, const sbfi_blend_surface *coarse, const sbfi_blend_row *old,
    uint32_t point, row_sum *sum, sbfi_arena *arena) {
  const sbfi_blend_surface *s = c->fine;
  uint32_t triangles = s->begins[point + 1] - s->begins[point];
  bool any = false;
  if (is_fixed(s, point) || triangles == 0) return true;
  double fraction = 1.0 / (3.0 * triangles);
  for (uint32_t i = s->begins[point]; i < s->begins[point + 1]; i++)
    for (int k = 0; k < 3; k++) {
      uint32_t cluster = (uint32_t)c->of_point[s->triangles[s->at_point[i]][k]];
      if (!coarse->changed[cluster]) continue;
      any = true;
      if (!add_row(sum, &coarse->rows[cluster], fraction) || !add_row(sum, &old[cluster], -fraction))
        return false;
    }
  if (!any) return true;
  s->changed[point] = 1;
  return add_row(sum, &s->rows[point], 1) && finish_row(sum, &s->rows[point], arena);
}

static bool relax_coarse(sbfi_blend_surface *surface, const clusters *c, row_sum *sum, sbfi_arena *arena) {
  sbfi_blend_surface coarse;
  uint32_t left;
  /* Rows are overwritten: recomputes the old ones. */
  const sbfi_blend_row *old = mean_rows(c, surface->rows, sum, arena);
  if (!old || !make_coarse(&coarse, c, sum, arena) || !sbfi_blend_levels_relax(&coarse, &left, arena))
    return false;
  for (uint32_t p = 0; p < surface->point_count; p++)
    if (!correct_point(c, &coarse, old, p, sum, arena)) return false;
  return true;
}

bool sbfi_blend_levels_relax(sbfi_blend_surface *surface, uint32_t *left, sbfi_arena *arena) {
  clusters c = {.fine = surface};
  if (surface->point_count > MAX_POINTS) {
    if (!make_clusters(&c, arena)) return false;
    row_sum sum;
    sbfi_array_init(&sum.weights, &arena->allocator, sizeof(sbfi_blend_weight));
    bool helps = c.count < MAX_CLUSTERS * surface->point_count;
    bool good = !helps || relax_coarse(surface, &c, &sum, arena);
    sbfi_array_free(&sum.weights);
    if (!good) return false;
    if (helps && surface->point_count > MANY_POINTS) surface->max_contractions = MAX_CONTRACTIONS;
  }
  return sbfi_blend_surface_relax(surface, left, arena);
}
