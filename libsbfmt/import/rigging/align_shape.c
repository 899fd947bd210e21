/* Aligns an input with the rig's own meshes if they share no points but have similar shapes.
 *
 * Candidates are common differences between files, each centred in the rig's box or left in place. The
 * best are refined by iterative closest points (Besl and McKay 1992) with a free scale. The score is the
 * symmetric mean distance between the surfaces, so that a small input cannot hide in a large rig. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import/rigging/align.h"
#include "import/rigging/surface_finder.h"

enum { SAMPLES = 300, FIRST_SAMPLES = 40, KEPT = 4, PASSES = 12 };

/* Upper bound of a distance as a fraction of the rig's size. */
static const double FARTHEST = 0.2;
/* Points farther away belong to another character or an object that one holds. */
static const double MAX_GAP = 0.1;
/* Minimum relative improvement by a later candidate. */
static const double BETTER = 0.1;

typedef struct candidate {
  sbfi_matrix m;
  double error;
} candidate;

typedef struct search {
  const sbfi_rigging *r;
  sbfi_surface_finder input, rig;
  candidate best[KEPT]; /* best first */
  uint32_t count;
} search;

static uint32_t sample(const sbfi_scene_surface *s, uint32_t i) {
  return (uint32_t)((double)s->mesh.positions.count * fmod(0.5 + i * 0.6180339887498949, 1.0));
}

static double distance_to(const sbfi_surface_finder *to, sbfi_d3 position, double within) {
  sbfi_surface_location near;
  return sbfi_surface_nearest(to, position, NULL, within, &near) ? near.distance : within;
}

/* Mean distance of the samples as a fraction of the rig's size. */
static double error_of(const search *s, const sbfi_matrix *m, uint32_t samples) {
  double size = s->r->rig.size, scale = sbfi_similarity_scale(m), sum = 0;
  sbfi_matrix back;
  if (!sbfi_matrix_invert(m, &back)) return INFINITY;
  for (uint32_t i = 0; i < samples; i++) {
    sbfi_d3 p = sbfi_d3_of(s->r->input.mesh.positions.at[sample(&s->r->input, i)]);
    sbfi_d3 q = sbfi_d3_of(s->r->rig.mesh.positions.at[sample(&s->r->rig, i)]);
    sum += distance_to(&s->rig, sbfi_similarity_apply(m, p), FARTHEST * size);
    sum += scale * distance_to(&s->input, sbfi_similarity_apply(&back, q), FARTHEST * size / scale);
  }
  return sum / (2 * samples * size);
}

static void consider(search *s, const sbfi_matrix *m) {
  if (!sbfi_alignment_allowed(s->r, m)) return;
  const candidate *last = &s->best[KEPT - 1];
  if (s->count == KEPT && error_of(s, m, FIRST_SAMPLES) > 1.5 * last->error) return;
  candidate here = {*m, error_of(s, m, SAMPLES)};
  uint32_t at = s->count < KEPT ? s->count++ : KEPT;
  for (; at > 0 && here.error < s->best[at - 1].error * (1 - BETTER); at--)
    if (at < KEPT) s->best[at] = s->best[at - 1];
  if (at < KEPT) s->best[at] = here;
}

static sbfi_d3 middle_of(const sbfi_scene_surface *s) {
  return sbfi_d3_scale(sbfi_d3_add(sbfi_d3_of(s->low), sbfi_d3_of(s->high)), 0.5);
}

static void consider_all(search *s) {
  const sbfi_scene_surface *a = &s->r->input, *b = &s->r->rig;
  consider(s, &s->r->c->to_asset);
  for (uint32_t i = 0; i < SBFI_AXIS_ROTATIONS; i++) {
    sbfi_matrix axes = sbfi_axis_rotation(i);
    for (uint32_t unit = 0; unit < SBFI_USUAL_UNITS; unit++) {
      double scale = sbfi_usual_units[unit].unit_m;
      if (a->size * scale > 2 * b->size || a->size * scale < 0.5 * b->size) continue;
      sbfi_matrix m = sbfi_similarity_scaled(&axes, scale, (sbfi_d3){0, 0, 0});
      consider(s, &m);
      m = sbfi_similarity_scaled(
          &axes, scale, sbfi_d3_sub(middle_of(b), sbfi_similarity_apply(&m, middle_of(a))));
      consider(s, &m);
    }
    sbfi_matrix m = sbfi_similarity_scaled(&axes, b->size / a->size, (sbfi_d3){0, 0, 0});
    sbfi_d3 offset = sbfi_d3_sub(middle_of(b), sbfi_similarity_apply(&m, middle_of(a)));
    m = sbfi_similarity_scaled(&axes, b->size / a->size, offset);
    consider(s, &m);
  }
}

/* Moves the samples towards the nearest surface. */
static sbfi_matrix drawn(const search *s, sbfi_matrix m) {
  sbfi_d3 from[SAMPLES], to[SAMPLES];
  bool mirrored = sbfi_matrix_determinant(&m) < 0;
  for (int pass = 0; pass < PASSES; pass++) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < SAMPLES; i++) {
      sbfi_surface_location near;
      sbfi_d3 p = sbfi_d3_of(s->r->input.mesh.positions.at[sample(&s->r->input, i)]);
      double within = FARTHEST / (1 + pass) * s->r->rig.size;
      if (!sbfi_surface_nearest(&s->rig, sbfi_similarity_apply(&m, p), NULL, within, &near)) continue;
      from[count] = p;
      to[count++] = sbfi_surface_point(&s->r->rig, &near);
    }
    sbfi_matrix next;
    if (count < SAMPLES / 4 ||
        !sbfi_similarity_fit(from, to, count, mirrored, s->r->c->options->unit_m, &next))
      break;
    m = next;
  }
  return m;
}

bool sbfi_align_by_shape(sbfi_rigging *r, double *error) {
  sbfi_arena scratch;
  search s = {.r = r};
  *error = INFINITY;
  if (!r->rig.mesh.polygon_sizes.count || !(r->input.size > 0) || !(r->rig.size > 0)) return true;
  sbfi_arena_init(&scratch, &r->c->scratch.allocator, 0);
  bool good = sbfi_surface_finder_make(&s.input, &r->input, &scratch) &&
              sbfi_surface_finder_make(&s.rig, &r->rig, &scratch);
  if (good) consider_all(&s);
  for (uint32_t i = 0; good && i < s.count; i++) {
    double size = r->rig.size;
    sbfi_matrix better = drawn(&s, s.best[i].m), snapped = sbfi_similarity_snapped(&better, size, 0.02);
    if (error_of(&s, &better, SAMPLES) < s.best[i].error * (1 - BETTER) && sbfi_alignment_allowed(r, &better))
      s.best[i] = (candidate){better, error_of(&s, &better, SAMPLES)};
    if (error_of(&s, &snapped, SAMPLES) < s.best[i].error * (1 + BETTER) &&
        sbfi_alignment_allowed(r, &snapped))
      s.best[i] = (candidate){snapped, error_of(&s, &snapped, SAMPLES)};
    if (s.best[i].error >= *error * (1 - BETTER)) continue;
    *error = s.best[i].error;
    r->alignment.to_asset = s.best[i].m;
  }
  r->alignment.is_stated = memcmp(&r->alignment.to_asset, &r->c->to_asset, sizeof r->c->to_asset) == 0;
  sbfi_arena_free(&scratch);
  return good;
}

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y;
}

bool sbfi_median_gap(const sbfi_rigging *r, double *median) {
  sbfi_arena scratch;
  sbfi_surface_finder rig;
  double distances[SAMPLES];
  uint32_t count = 0;
  sbfi_arena_init(&scratch, &r->c->scratch.allocator, 0);
  bool good = sbfi_surface_finder_make(&rig, &r->rig, &scratch);
  for (uint32_t i = 0; good && i < SAMPLES; i++) {
    sbfi_d3 p = sbfi_d3_of(r->input.mesh.positions.at[sample(&r->input, i)]);
    p = sbfi_similarity_apply(&r->alignment.to_asset, p);
    double distance = distance_to(&rig, p, MAX_GAP * r->rig.size) / r->rig.size;
    if (distance < MAX_GAP) distances[count++] = distance;
  }
  if (count) qsort(distances, count, sizeof *distances, compare);
  *median = count ? distances[count / 2] : 0;
  sbfi_arena_free(&scratch);
  return good;
}
