/* Interior structure as lines: springs by their kinds, and the edges of lattices, with their strain. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "web.h"

enum { LATTICE = SBF_SPRING_KIND_COUNT };

/* A line between two points of the concatenated lists of all bodies. */
typedef struct line {
  uint32_t ends[2];
  uint32_t kind; /* of sbf_spring_kind, or LATTICE */
  float rest;    /* m */
} line;

typedef struct web_lines {
  uint32_t line_count, point_count, body_count;
  line *lines;
  uint32_t *first;  /* (body_count) point */
  uint32_t *counts; /* (body_count) points */
  sbf_vec3 *points;
  float *vertices; /* (line_count x 2 x 5) position, kind, strain */
} web_lines;

void WEB_CALL(web_lines_free)(web_lines *w) {
  if (!w) return;
  free(w->lines);
  free(w->first);
  free(w->counts);
  free(w->points);
  free(w->vertices);
  free(w);
}

static float length(sbf_vec3 a, sbf_vec3 b) {
  float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return sqrtf(x * x + y * y + z * z);
}

static int compare_lines(const void *a, const void *b) {
  return memcmp(a, b, sizeof((line *)0)->ends);
}

static void add_springs(web_lines *w, const sbf_level *level, uint32_t first) {
  for (uint32_t s = 0; s < level->springs.count; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    for (uint32_t i = 0; i < set->ends.count; i++) {
      const uint32_t *p = set->ends.at[i].at;
      w->lines[w->line_count++] = (line){{first + p[0], first + p[1]}, (uint32_t)set->kind,
          set->rest_lengths.count ? set->rest_lengths.at[i]
                                  : length(level->positions.at[p[0]], level->positions.at[p[1]])};
    }
  }
}

static void add_lattice(web_lines *w, const sbf_level *level, uint32_t first) {
  static const int pairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  line *lines = w->lines + w->line_count;
  uint32_t count = 0, kept = 0;
  for (uint32_t t = 0; t < level->lattice.tetrahedra.count; t++)
    for (int k = 0; k < 6; k++) {
      const uint32_t *p = level->lattice.tetrahedra.at[t].at;
      uint32_t a = p[pairs[k][0]], b = p[pairs[k][1]];
      lines[count++] = (line){{first + (a < b ? a : b), first + (a < b ? b : a)}, LATTICE,
          length(level->positions.at[a], level->positions.at[b])};
    }
  qsort(lines, count, sizeof *lines, compare_lines);
  for (uint32_t i = 0; i < count; i++)
    if (kept == 0 || compare_lines(&lines[i], &lines[kept - 1]) != 0) lines[kept++] = lines[i];
  w->line_count += kept;
}

/* The level that a model of `level` simulates for a body, as far as the number of points tells. */
static const sbf_level *level_of(const sbf_soft_body *body, uint32_t point_count, uint32_t level) {
  const sbf_level *best = NULL;
  for (uint32_t l = 0; l < body->levels.count; l++) {
    const sbf_level *one = &body->levels.at[l];
    if (one->positions.count != point_count) continue;
    if (!best || l <= level) best = one;
  }
  return best;
}

/* Lines of a character's bodies as its model simulates them. NULL: no memory. */
web_lines *WEB_CALL(web_lines_create)(
    const sbf_asset *asset, const sbr_world *world, uint32_t character, uint32_t level) {
  web_lines *w = calloc(1, sizeof *w);
  uint32_t bodies = asset->soft_bodies.count, max = 0;
  if (!w) return NULL;
  w->body_count = bodies;
  w->first = calloc(bodies + 1u, sizeof *w->first);
  w->counts = calloc(bodies + 1u, sizeof *w->counts);
  const sbf_level **levels = calloc(bodies + 1u, sizeof *levels);
  bool good = w->first && w->counts && levels;
  for (uint32_t b = 0; good && b < bodies; b++) {
    w->first[b] = w->point_count;
    w->counts[b] = sbr_character_get_points(world, (sbr_character_id){character}, b, NULL, 0);
    w->point_count += w->counts[b];
    levels[b] = level_of(&asset->soft_bodies.at[b], w->counts[b], level);
    if (!levels[b]) continue;
    max += 6 * levels[b]->lattice.tetrahedra.count;
    for (uint32_t s = 0; s < levels[b]->springs.count; s++) max += levels[b]->springs.at[s].ends.count;
  }
  w->points = malloc((w->point_count + 1u) * sizeof *w->points);
  w->lines = malloc((max + 1u) * sizeof *w->lines);
  good = good && w->points && w->lines;
  for (uint32_t b = 0; good && b < bodies; b++) {
    if (!levels[b]) continue;
    add_springs(w, levels[b], w->first[b]);
    add_lattice(w, levels[b], w->first[b]);
  }
  free(levels);
  w->vertices = malloc((w->line_count * 10u + 1u) * sizeof *w->vertices);
  if (good && w->vertices) return w;
  web_lines_free(w);
  return NULL;
}

uint32_t WEB_CALL(web_lines_count)(const web_lines *w) {
  return w->line_count;
}
/* Ten numbers per line, of the last tick: position (3), kind and strain of each end. */
const float *WEB_CALL(web_lines_update)(web_lines *w, const sbr_world *world, uint32_t character) {
  for (uint32_t b = 0; b < w->body_count; b++)
    sbr_character_get_points(world, (sbr_character_id){character}, b, w->points + w->first[b], w->counts[b]);
  for (uint32_t i = 0; i < w->line_count; i++) {
    const line *l = &w->lines[i];
    sbf_vec3 a = w->points[l->ends[0]], b = w->points[l->ends[1]];
    float strain = l->rest > 0 ? length(a, b) / l->rest - 1 : 0, kind = (float)l->kind;
    const float numbers[10] = {a.x, a.y, a.z, kind, strain, b.x, b.y, b.z, kind, strain};
    memcpy(w->vertices + 10 * (size_t)i, numbers, sizeof numbers);
  }
  return w->vertices;
}
