/* Compares shapes of surfaces by numbers that do not depend on unit, axes, mirroring, order or splitting
 * of points: area and ratios of principal moments. Compares each frame of each clip, and searches between
 * frames around the best ones. */
#include "import/rigging/clip_moments.h"

#include <math.h>

#include "import/rigging/rig_pose.h"
#include "import/rigging/similarity.h"
#include "import/scene/trs.h"
#include "mechanics/symmetric_eigen.h"
#include "motion/quatd.h"

/* Step between frames, s; it is longer if the limit of posed points needs it. Frames to search around, and
 * search steps. */
static const double FRAME = 1.0 / 24, MAX_POINTS = 1e7;
enum { SAMPLES = 8, REFINED = 18 };
/* Maximum difference at a frame for a search around it; maximum difference for a comparison of points;
 * difference that counts as equal. Points without weights can be anywhere. */
static const double ALIKE = 0.03, ALIKE_BETWEEN = 2e-3, SAME = 1e-6;
/* Relative tolerance of triangle counts: programs drop some flat or duplicate triangles. */
static const double SAME_COUNT = 0.01;

typedef struct shape {
  double numbers[3];
} shape;

typedef struct search {
  const sbfi_rigging *r;
  shape input;
  sbfi_scene_node *nodes;
  sbfi_matrix *worlds, *motions;
  sbf_vec3 *positions;
  sbfi_clip_moment best[SAMPLES]; /* best first */
  uint32_t count;
} search;

/* --- Shapes -------------------------------------------------------------------------------------------- */

/* Adds area, first and second moments of a triangle about the origin. */
static void add_triangle(sbfi_d3 a, sbfi_d3 b, sbfi_d3 c, double sums[10]) {
  double area = 0.5 * sbfi_d3_length(sbfi_d3_cross(sbfi_d3_sub(b, a), sbfi_d3_sub(c, a)));
  const double p[3][3] = {{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}};
  double sum[3];
  for (int k = 0; k < 3; k++) sum[k] = p[0][k] + p[1][k] + p[2][k];
  sums[0] += area;
  for (int k = 0; k < 3; k++) sums[1 + k] += area / 3 * sum[k];
  for (int k = 0, at = 4; k < 3; k++)
    for (int j = k; j < 3; j++, at++)
      sums[at] += area / 12 * (p[0][k] * p[0][j] + p[1][k] * p[1][j] + p[2][k] * p[2][j] + sum[k] * sum[j]);
}

static shape shape_of(const sbfi_scene_surface *surface, const sbf_vec3 *positions) {
  const sbf_polygon_mesh *mesh = &surface->mesh;
  const uint32_t *corners = mesh->polygon_points.at;
  double sums[10] = {0}, vectors[9];
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++)
      add_triangle(sbfi_d3_of(positions[corners[0]]), sbfi_d3_of(positions[corners[k - 1]]),
          sbfi_d3_of(positions[corners[k]]), sums);
  if (!(sums[0] > 0)) return (shape){{0, 0, 0}};
  double moments[9];
  for (int k = 0, at = 4; k < 3; k++)
    for (int j = k; j < 3; j++, at++)
      moments[3 * k + j] = moments[3 * j + k] =
          sums[at] / sums[0] - sums[1 + k] * sums[1 + j] / (sums[0] * sums[0]);
  sbfi_symmetric_compute_eigen(3, moments, vectors);
  double min = fmin(moments[0], fmin(moments[4], moments[8]));
  double max = fmax(moments[0], fmax(moments[4], moments[8]));
  double trace = moments[0] + moments[4] + moments[8];
  return (shape){{min / trace, max / trace, sums[0] / (50 * trace)}};
}

static double difference(const shape *a, const shape *b) {
  double sum = 0;
  for (int k = 0; k < 3; k++) sum += fabs(a->numbers[k] - b->numbers[k]);
  return sum;
}

static uint32_t count_triangles(const sbfi_scene_surface *surface) {
  return surface->mesh.polygon_points.count - 2 * surface->mesh.polygon_sizes.count;
}

/* --- Moments of a clip --------------------------------------------------------------------------------- */

/* Index of the last key before a time, and the fraction towards the next one. */
static uint32_t key_before(const float *times, uint32_t count, double time, double *t) {
  uint32_t at = 0;
  while (at + 1 < count && (double)times[at + 1] <= time) at++;
  *t = 0;
  if (at + 1 < count && time > (double)times[at])
    *t = (time - (double)times[at]) / ((double)times[at + 1] - (double)times[at]);
  return at;
}

static void mix_vectors(const sbf_vec3 *keys, uint32_t at, double t, double to[3]) {
  sbfi_d3 from = sbfi_d3_of(keys[at]);
  sbfi_d3 p = t > 0 ? sbfi_d3_add(from, sbfi_d3_scale(sbfi_d3_sub(sbfi_d3_of(keys[at + 1]), from), t)) : from;
  to[0] = p.x, to[1] = p.y, to[2] = p.z;
}

static void blend_rotations(const sbf_quat *keys, uint32_t at, double t, double to[4]) {
  const sbf_quat a = keys[at], b = keys[t > 0 ? at + 1 : at];
  const double from[4] = {(double)a.x, (double)a.y, (double)a.z, (double)a.w};
  const double until[4] = {(double)b.x, (double)b.y, (double)b.z, (double)b.w};
  sbfi_quatd_slerp(from, until, t, to);
}

static void pose_at(search *s, const sbfi_scene_clip *clip, double time) {
  const sbfi_scene *rig = s->r->rig.scene;
  for (uint32_t n = 0; n < rig->node_count; n++) s->nodes[n] = rig->nodes[n];
  for (uint32_t i = 0; i < clip->channel_count; i++) {
    const sbfi_scene_channel *channel = &clip->channels[i];
    sbfi_trs trs = sbfi_trs_decompose(&rig->nodes[channel->node].local);
    double t;
    uint32_t at = key_before(channel->position_times, channel->position_count, time, &t);
    if (channel->position_count) mix_vectors(channel->positions, at, t, trs.position);
    at = key_before(channel->rotation_times, channel->rotation_count, time, &t);
    if (channel->rotation_count) blend_rotations(channel->rotations, at, t, trs.rotation);
    at = key_before(channel->scale_times, channel->scale_count, time, &t);
    if (channel->scale_count) mix_vectors(channel->scales, at, t, trs.scale);
    if (channel->position_count || channel->rotation_count || channel->scale_count)
      s->nodes[channel->node].local = sbfi_trs_compose(&trs);
  }
  sbfi_scene_set_worlds(s->nodes, rig->node_count);
  for (uint32_t n = 0; n < rig->node_count; n++) s->worlds[n] = s->nodes[n].world;
}

static double difference_at(search *s, const sbfi_scene_clip *clip, double time) {
  pose_at(s, clip, time);
  sbfi_pose_positions(s->r, s->worlds, s->motions, s->positions);
  shape here = shape_of(&s->r->rig, s->positions);
  return difference(&here, &s->input);
}

static void keep(search *s, sbfi_clip_moment pose) {
  uint32_t at = s->count < SAMPLES ? s->count++ : SAMPLES;
  for (; at > 0 && pose.difference < s->best[at - 1].difference; at--)
    if (at < SAMPLES) s->best[at] = s->best[at - 1];
  if (at < SAMPLES) s->best[at] = pose;
}

/* Keeps frames that are local minima. */
static void measure_clip(search *s, const sbfi_scene_clip *clip, double step) {
  double before = INFINITY, here = INFINITY;
  uint32_t frames = (uint32_t)((double)clip->duration_s / step) + 1;
  for (uint32_t i = 0; i <= frames; i++) {
    double after = i < frames ? difference_at(s, clip, i * step) : INFINITY;
    if (i && here <= before && here < after) keep(s, (sbfi_clip_moment){clip, (i - 1) * step, here});
    before = here;
    here = after;
  }
}

/* Golden section search between the neighbouring frames. */
static void refine(search *s, sbfi_clip_moment *pose, double step) {
  const double part = 0.6180339887498949;
  double low = fmax(pose->time_s - step, 0), high = fmin(pose->time_s + step, (double)pose->clip->duration_s);
  double a = high - part * (high - low), b = low + part * (high - low);
  double at_a = difference_at(s, pose->clip, a), at_b = difference_at(s, pose->clip, b);
  for (int i = 0; i < REFINED && pose->difference > SAME; i++) {
    bool left = at_a < at_b;
    if (left ? at_a < pose->difference : at_b < pose->difference) {
      pose->time_s = left ? a : b;
      pose->difference = left ? at_a : at_b;
    }
    if (left) {
      high = b, b = a, at_b = at_a;
      a = high - part * (high - low);
      at_a = difference_at(s, pose->clip, a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + part * (high - low);
      at_b = difference_at(s, pose->clip, b);
    }
  }
}

static bool reserve(search *s) {
  sbfi_arena *arena = &s->r->c->scratch;
  size_t nodes = s->r->rig.scene->node_count, points = s->r->rig.mesh.positions.count;
  s->nodes = sbfi_arena_allocate(arena, nodes + 1, sizeof *s->nodes);
  s->worlds = sbfi_arena_allocate(arena, nodes + 1, sizeof *s->worlds);
  s->motions = sbfi_arena_allocate(arena, nodes + 1, sizeof *s->motions);
  s->positions = sbfi_arena_allocate(arena, points + 1, sizeof *s->positions);
  return s->nodes && s->worlds && s->motions && s->positions;
}

bool sbfi_clip_moments_find(
    const sbfi_rigging *r, sbfi_clip_moment poses[SBFI_MAX_CLIP_MOMENTS], uint32_t *count) {
  const sbfi_scene *rig = r->rig.scene;
  search s = {.r = r};
  double frames = 0, input = count_triangles(&r->input), own = count_triangles(&r->rig);
  *count = 0;
  for (uint32_t i = 0; i < rig->clip_count; i++) frames += (double)rig->clips[i].duration_s / FRAME + 1;
  if (!(frames > 0) || !(input > 0) || fabs(input - own) > SAME_COUNT * own) return true;
  if (!reserve(&s)) return false;
  double step = FRAME * fmax(1, frames * r->rig.mesh.positions.count / MAX_POINTS);
  s.input = shape_of(&r->input, r->input.mesh.positions.at);
  for (uint32_t i = 0; i < rig->clip_count; i++) measure_clip(&s, &rig->clips[i], step);
  search sorted = {.count = 0};
  for (uint32_t i = 0; i < s.count; i++) {
    sbfi_clip_moment between = s.best[i];
    refine(&s, &between, step);
    keep(&sorted, between.difference <= ALIKE_BETWEEN ? between : s.best[i]);
  }
  for (uint32_t i = 0; i < sorted.count && *count < SBFI_MAX_CLIP_MOMENTS; i++)
    if (sorted.best[i].difference <= ALIKE) poses[(*count)++] = sorted.best[i];
  return true;
}

const sbfi_matrix *sbfi_clip_moment_worlds(const sbfi_rigging *r, const sbfi_clip_moment *pose) {
  search s = {.r = r};
  if (!reserve(&s)) return NULL;
  pose_at(&s, pose->clip, pose->time_s);
  return s.worlds;
}
