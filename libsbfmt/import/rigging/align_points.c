/* Aligns an input with the rig's own meshes by shared points.
 *
 * The correspondence of points is unknown: order, unit, axes, handedness and offset may differ, and either
 * mesh may be only a part of the other. Candidate transforms come from common differences between files
 * (swapped axes, a usual unit, no offset), from the two bounding boxes, and from congruent triangles,
 * which define a complete transform. The score is the fraction of sampled points that fall onto a point of
 * the rig. Earlier candidates win ties, so a symmetric mesh gets its simplest transform. */
#include <math.h>
#include <string.h>

#include "import/rigging/align.h"
#include "import/rigging/point_finder.h"
#include "import/rigging/triangle_shapes.h"
#include "import/rigging/weigh.h"

enum {
  SAMPLES = 256,
  FIRST_SAMPLES = 16,
  SECOND_SAMPLES = 64,
  FITTED_SAMPLES = 512,
  MATCH_SAMPLES = 2000,
  SEED_TRIANGLES = 48,
  SEED_CANDIDATES = 400
};

/* Maximum distance of equal points as a fraction of the input's size. */
static const double TOLERANCE = 1e-4;
/* Minimum improvement by a later candidate. */
static const double BETTER = 5e-3;
/* Minimum decrease in the summed distance of objects to their namesakes for a mirror image to win, as a
 * fraction of the rig's size. */
static const double NAME_DISTANCE = 0.05;
/* Minimum significant fraction of points. */
static const double MIN_FRACTION = 0.1;

typedef struct search {
  const sbfi_rigging *r;
  sbfi_point_finder finder; /* of the rig's points */
  uint32_t samples[SAMPLES], sample_count;
  double quantum; /* resolution of the input's numbers in its own unit: decimals of its text */
  sbfi_matrix best;
  double best_fraction;
} search;

/* Resolution of numbers in a text: the step of which all are multiples; 0 if there is none. */
static double find_quantum(const sbf_vec3_list points) {
  for (double steps = 1e3; steps < 2e7; steps *= 10) {
    bool whole = true;
    for (uint32_t i = 0; whole && i < points.count; i++) {
      const float at[3] = {points.at[i].x, points.at[i].y, points.at[i].z};
      for (int k = 0; whole && k < 3; k++) {
        double scaled = (double)at[k] * steps;
        whole = fabs(scaled - floor(scaled + 0.5)) <= 1e-2 + fabs(scaled) * 1.2e-7;
      }
    }
    if (whole) return 1 / steps;
  }
  return 0;
}

double sbfi_match_tolerance(const sbfi_rigging *r, double scale, double quantum) {
  double size = r->input.size * scale;
  return fmin(fmax(TOLERANCE * size, 2 * quantum * scale), 20 * TOLERANCE * size);
}

double sbfi_input_quantum(const sbfi_rigging *r) {
  return find_quantum(r->input.mesh.positions);
}

static double fraction_of(const search *s, const sbfi_matrix *m, uint32_t from, uint32_t to) {
  double within = sbfi_match_tolerance(s->r, sbfi_similarity_scale(m), s->quantum);
  uint32_t hits = 0;
  for (uint32_t i = from; i < to; i++) {
    sbfi_d3 p = sbfi_d3_of(s->r->input.mesh.positions.at[s->samples[i]]);
    hits += sbfi_point_nearest(&s->finder, sbfi_similarity_apply(m, p), within, NULL) != UINT32_MAX;
  }
  return to > from ? (double)hits / (to - from) : 0;
}

bool sbfi_rig_has_no_size(const sbfi_rigging *r) {
  return !r->rig.scene->unit_known && r->rig.scene->mesh_count == 0;
}

bool sbfi_alignment_allowed(const sbfi_rigging *r, const sbfi_matrix *m) {
  const sbf_convert_options *options = r->c->options;
  double scale = sbfi_similarity_scale(m);
  if (options->unit_m > 0 && !sbfi_rig_has_no_size(r) && fabs(scale / options->unit_m - 1) > 1e-3)
    return false;
  int up = options->up == 'z' ? 2 : 1;
  if (options->up && !(m->at[1][up] > 0.999 * scale)) return false;
  if (!options->forward) return true;
  int forward = options->forward[strlen(options->forward) - 1] - 'x';
  return (options->forward[0] == '-' ? -1 : 1) * m->at[2][forward] > 0.999 * scale;
}

static void consider(search *s, const sbfi_matrix *m) {
  if (!sbfi_alignment_allowed(s->r, m)) return;
  uint32_t first = s->sample_count < FIRST_SAMPLES ? s->sample_count : FIRST_SAMPLES;
  uint32_t second = s->sample_count < SECOND_SAMPLES ? s->sample_count : SECOND_SAMPLES;
  double fraction = fraction_of(s, m, 0, first);
  if (!(fraction > 0.4 * s->best_fraction)) return;
  fraction = (fraction * first + fraction_of(s, m, first, second) * (second - first)) / second;
  if (!(fraction > 0.7 * s->best_fraction) || fraction < 0.5 * MIN_FRACTION) return;
  fraction = (fraction * second + fraction_of(s, m, second, s->sample_count) * (s->sample_count - second)) /
             s->sample_count;
  if (fraction < s->best_fraction + BETTER) return;
  s->best = *m;
  s->best_fraction = fraction;
}

/* Golden ratio steps, so that any number of first samples is spread out. */
static uint32_t sample_of(uint32_t count, uint32_t samples, uint32_t i) {
  return count <= samples ? i : (uint32_t)((double)count * fmod(0.5 + i * 0.6180339887498949, 1.0));
}

static uint32_t common_divisor(uint32_t a, uint32_t b) {
  return b ? common_divisor(b, a % b) : a;
}

/* Takes all points if they are few, in the same steps: the first ones may belong to an object that the rig
 * does not have. */
static void sample_points(search *s) {
  uint32_t count = s->r->input.mesh.positions.count, step = (uint32_t)(0.618 * count) + 1;
  s->sample_count = count < SAMPLES ? count : SAMPLES;
  while (common_divisor(step, count) != 1) step++;
  for (uint32_t i = 0; i < s->sample_count; i++)
    s->samples[i] = count <= SAMPLES ? i * step % count : sample_of(count, SAMPLES, i);
}

/* Tries swapped axes and usual units without an offset. */
static void consider_usual(search *s) {
  for (uint32_t unit = 0; unit < SBFI_USUAL_UNITS; unit++) {
    double scale = sbfi_usual_units[unit].unit_m, size = s->r->input.size * scale;
    if (size > 1.5 * s->r->rig.size || size < 0.01 * s->r->rig.size) continue;
    for (uint32_t i = 0; i < SBFI_AXIS_ROTATIONS; i++) {
      sbfi_matrix axes = sbfi_axis_rotation(i);
      axes = sbfi_similarity_scaled(&axes, scale, (sbfi_d3){0, 0, 0});
      consider(s, &axes);
    }
  }
}

/* Tries transforms that match the two bounding boxes. */
static void consider_boxes(search *s) {
  const sbfi_scene_surface *a = &s->r->input, *b = &s->r->rig;
  sbfi_d3 low = sbfi_d3_of(a->low), high = sbfi_d3_of(a->high);
  sbfi_d3 from = sbfi_d3_scale(sbfi_d3_add(low, high), 0.5);
  sbfi_d3 to = sbfi_d3_scale(sbfi_d3_add(sbfi_d3_of(b->low), sbfi_d3_of(b->high)), 0.5);
  for (uint32_t i = 0; i < SBFI_AXIS_ROTATIONS; i++) {
    sbfi_matrix m = sbfi_axis_rotation(i);
    m = sbfi_similarity_scaled(&m, b->size / a->size, (sbfi_d3){0, 0, 0});
    sbfi_d3 offset = sbfi_d3_sub(to, sbfi_similarity_apply(&m, from));
    m = sbfi_similarity_scaled(&m, b->size / a->size, offset);
    consider(s, &m);
  }
}

/* --- Triangles of one shape ---------------------------------------------------------------------------- */

typedef struct seed {
  search *s;
  const sbfi_shaped_triangle *from;
  uint32_t candidates;
} seed;

static bool consider_triangle(void *user, const sbfi_shaped_triangle *to) {
  seed *at = user;
  sbfi_d3 a[3], b[3];
  for (int k = 0; k < 3; k++) {
    a[k] = sbfi_d3_of(at->s->r->input.mesh.positions.at[at->from->points[k]]);
    b[k] = sbfi_d3_of(at->s->r->rig.mesh.positions.at[to->points[k]]);
  }
  for (int mirrored = 0; mirrored < 2; mirrored++) {
    sbfi_matrix m;
    if (!sbfi_similarity_of_triangle(a, b, mirrored, &m)) continue;
    double scale = sbfi_similarity_scale(&m) * at->s->r->input.size;
    if (scale > 3 * at->s->r->rig.size || scale < 0.01 * at->s->r->rig.size) continue;
    /* The triangle's rounding error is magnified by the ratio of the whole to the triangle. */
    sbfi_matrix snapped = sbfi_similarity_snapped(&m, at->s->r->rig.size, 3e-3);
    sbfi_d3 moved = sbfi_d3_sub(b[0], sbfi_similarity_apply(&snapped, a[0]));
    if (sbfi_d3_length(moved) > 1e-5 * at->s->r->rig.size) {
      sbfi_d3 offset = {snapped.at[0][3] + moved.x, snapped.at[1][3] + moved.y, snapped.at[2][3] + moved.z};
      snapped = sbfi_similarity_scaled(&snapped, sbfi_similarity_scale(&snapped), offset);
    }
    consider(at->s, &snapped);
    consider(at->s, &m);
  }
  return ++at->candidates < SEED_CANDIDATES;
}

/* Large triangles of rare shapes are most distinctive. */
static double worth(const sbfi_triangle_shapes *rig, const sbfi_shaped_triangle *t) {
  uint32_t like = sbfi_triangle_shapes_count(rig, t);
  return like ? (double)t->longest / (1 + sqrt((double)like)) : 0;
}

static bool consider_triangles(search *s, sbfi_arena *arena) {
  sbfi_triangle_shapes input, rig;
  if (!sbfi_triangle_shapes_make(&input, &s->r->input, arena) ||
      !sbfi_triangle_shapes_make(&rig, &s->r->rig, arena))
    return false;
  double *priorities = sbfi_arena_allocate(arena, input.count + 1, sizeof *priorities);
  if (!priorities) return false;
  for (uint32_t i = 0; i < input.count; i++) priorities[i] = worth(&rig, &input.triangles[i]);
  for (uint32_t turn = 0; turn < SEED_TRIANGLES && s->best_fraction < 0.999; turn++) {
    uint32_t best = 0;
    for (uint32_t i = 1; i < input.count; i++)
      if (priorities[i] > priorities[best]) best = i;
    if (!input.count || priorities[best] <= 0) break;
    seed at = {s, &input.triangles[best], 0};
    priorities[best] = 0;
    sbfi_triangle_shapes_find(&rig, at.from, consider_triangle, &at);
  }
  return true;
}

/* --- The best of them, more exactly -------------------------------------------------------------------- */

typedef struct pairs {
  sbfi_d3 *from, *to;
  uint32_t count;
  double squared; /* sum of squared distances */
} pairs;

/* Compares `samples` points, spread over all. */
static void find_pairs(const search *s, const sbfi_matrix *m, uint32_t samples, pairs *p) {
  const sbf_vec3_list points = s->r->input.mesh.positions;
  double within = sbfi_match_tolerance(s->r, sbfi_similarity_scale(m), s->quantum), distance;
  p->count = 0;
  p->squared = 0;
  for (uint32_t i = 0; i < samples; i++) {
    sbfi_d3 from = sbfi_d3_of(points.at[sample_of(points.count, samples, i)]),
            at = sbfi_similarity_apply(m, from);
    uint32_t near = sbfi_point_nearest(&s->finder, at, within, &distance);
    if (near == UINT32_MAX) continue;
    p->from[p->count] = from;
    p->to[p->count++] = sbfi_d3_of(s->finder.points[near]);
    p->squared += distance * distance;
  }
}

static bool is_mirrored(const sbfi_matrix *m) {
  return sbfi_matrix_determinant(m) < 0;
}

/* A nearly symmetric character fits nearly as well when mirrored. All points decide instead of a sample,
 * and if they are inconclusive, the names of objects: those named left must be at the rig's left. */
static void try_mirrors(search *s, pairs *p) {
  uint32_t count = s->r->input.mesh.positions.count;
  sbfi_d3 low = sbfi_d3_of(s->r->rig.low), high = sbfi_d3_of(s->r->rig.high);
  const double middle[3] = {(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
  sbfi_matrix from = s->best;
  find_pairs(s, &from, count, p);
  uint32_t max = p->count;
  double separation = sbfi_names_distance(s->r, &from), near = NAME_DISTANCE * s->r->rig.size;
  bool is_plain = !is_mirrored(&from);
  for (int i = 0; i < 6 && (max < count || separation > near || !is_plain); i++) {
    sbfi_matrix mirror = sbfi_matrix_identity(); /* about the centre, or about the origin */
    mirror.at[i / 2][i / 2] = -1;
    mirror.at[i / 2][3] = i % 2 ? 0 : 2 * middle[i / 2];
    sbfi_matrix m = sbfi_matrix_multiply(&mirror, &from);
    if (!sbfi_alignment_allowed(s->r, &m)) continue;
    find_pairs(s, &m, count, p);
    if (p->count < max) continue;
    double named = sbfi_names_distance(s->r, &m);
    /* Samples of a symmetric mesh may fit its mirror image better: prefers the one without a mirror if
     * they are equally good. */
    double min_nearer = !is_plain && !is_mirrored(&m) ? -near : near;
    if (p->count == max && separation - named < min_nearer) continue;
    max = p->count;
    separation = named;
    is_plain = !is_mirrored(&m);
    s->best = m;
  }
}

/* Fits by least squares, and snaps to a usual transform if that is as good. */
static void fit(search *s, pairs *p) {
  uint32_t count = s->r->input.mesh.positions.count,
           samples = count < FITTED_SAMPLES ? count : FITTED_SAMPLES;
  find_pairs(s, &s->best, samples, p);
  uint32_t max = p->count;
  double squared = p->squared;
  for (int pass = 0; pass < 4; pass++) {
    sbfi_matrix m;
    if (!sbfi_similarity_fit(p->from, p->to, p->count, is_mirrored(&s->best), s->r->c->options->unit_m, &m))
      break;
    if (pass == 3) m = sbfi_similarity_snapped(&s->best, s->r->rig.size, 3e-4);
    if (pass == 3 && !sbfi_alignment_allowed(s->r, &m)) break;
    find_pairs(s, &m, samples, p);
    /* A usual transform may be slightly worse, because the difference is only rounding. */
    double allowed =
        squared + (pass == 3 ? 3 * squared + 1e-12 * s->r->rig.size * s->r->rig.size * samples : 0);
    if (p->count < max || (p->count == max && p->squared > allowed)) continue;
    s->best = m;
    max = p->count;
    squared = p->squared;
  }
}

static bool refine(search *s, sbfi_arena *arena, double *fraction) {
  uint32_t count = s->r->input.mesh.positions.count;
  pairs p = {sbfi_arena_allocate(arena, count, sizeof *p.from),
      sbfi_arena_allocate(arena, count, sizeof *p.to), 0, 0};
  if (!p.from || !p.to) return false;
  try_mirrors(s, &p);
  /* the stated transform is right and stays */
  bool is_stated = memcmp(&s->best, &s->r->c->to_asset, sizeof s->best) == 0;
  if (!is_stated) fit(s, &p);
  uint32_t samples = count < MATCH_SAMPLES ? count : MATCH_SAMPLES;
  find_pairs(s, &s->best, samples, &p);
  *fraction = (double)p.count / samples;
  return true;
}

bool sbfi_align_by_points(sbfi_rigging *r, bool *found) {
  sbfi_arena scratch;
  search s = {.r = r, .quantum = sbfi_input_quantum(r)};
  const sbf_vec3_list rig = r->rig.mesh.positions;
  *found = false;
  if (!rig.count || !r->input.mesh.positions.count || !(r->input.size > 0) || !(r->rig.size > 0)) return true;
  sbfi_arena_init(&scratch, &r->c->scratch.allocator, 0);
  double within = sbfi_match_tolerance(r, r->rig.size / r->input.size, s.quantum);
  bool good = sbfi_point_finder_make(&s.finder, rig.at, rig.count, within, &scratch);
  sample_points(&s);
  if (good) {
    consider(&s, &r->c->to_asset);
    if (s.best_fraction < 0.999) consider_usual(&s);
    if (s.best_fraction < 0.999) consider_boxes(&s);
    if (s.best_fraction < 0.999) good = consider_triangles(&s, &scratch);
    *found = good && s.best_fraction >= MIN_FRACTION;
    if (*found) good = refine(&s, &scratch, &r->alignment.matched);
    if (*found) r->alignment.to_asset = s.best;
    r->alignment.is_stated = memcmp(&r->alignment.to_asset, &r->c->to_asset, sizeof s.best) == 0;
  }
  sbfi_arena_free(&scratch);
  return good;
}
