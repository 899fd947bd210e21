#include "skin_bend.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct d3 {
  double x, y, z;
} d3;
/* x -> rows x + t */
typedef struct motion {
  double rows[3][3], t[3];
} motion;

static d3 of(sbf_vec3 v) {
  return (d3){v.x, v.y, v.z};
}
static d3 sub(d3 a, d3 b) {
  return (d3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static d3 cross(d3 a, d3 b) {
  return (d3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static double dot(d3 a, d3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static d3 turned(const motion *m, d3 p) {
  const double(*r)[3] = m->rows;
  return (d3){r[0][0] * p.x + r[0][1] * p.y + r[0][2] * p.z, r[1][0] * p.x + r[1][1] * p.y + r[1][2] * p.z,
      r[2][0] * p.x + r[2][1] * p.y + r[2][2] * p.z};
}
static d3 moved(const motion *m, d3 p) {
  d3 q = turned(m, p);
  return (d3){q.x + m->t[0], q.y + m->t[1], q.z + m->t[2]};
}
static void add(d3 *to, d3 p, double w) {
  to->x += w * p.x, to->y += w * p.y, to->z += w * p.z;
}

/* About the line through `at` along the unit vector `axis`, after Rodrigues. */
static motion turn(d3 at, d3 axis, double angle) {
  const double c = cos(angle), s = sin(angle), a[3] = {axis.x, axis.y, axis.z};
  const double k[3][3] = {{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
  motion m;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) m.rows[i][j] = (i == j) * c + s * k[i][j] + (1 - c) * a[i] * a[j];
  m.t[0] = m.t[1] = m.t[2] = 0;
  d3 back = sub(at, turned(&m, at));
  m.t[0] = back.x, m.t[1] = back.y, m.t[2] = back.z;
  return m;
}

static d3 axis_of(const sbf_bone *bone, int axis) {
  sbf_quat r = bone->rotation;
  double length = sqrt((double)r.x * r.x + (double)r.y * r.y + (double)r.z * r.z + (double)r.w * r.w);
  double x = r.x / length, y = r.y / length, z = r.z / length, w = r.w / length;
  if (axis == 0) return (d3){1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
  if (axis == 1) return (d3){2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
  return (d3){2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
}

typedef struct work {
  const sbf_asset *asset;
  const sbf_render_mesh *mesh;
  uint32_t number, count; /* of the mesh, of its vertices */
  double size;
  motion *bones;
  d3 *ours, *lbs;
  double *sums;
  uint32_t *twins;     /* (count) first vertex with the same position and weights */
  int32_t *alone;      /* (count) section that carries it all; -1: several */
  uint32_t *triangles; /* (3 x triangle_count) */
  uint32_t triangle_count;
  uint32_t *influences; /* (count) first influence */
} work;

static void *zeroed(size_t count, size_t size) {
  void *memory = calloc(count ? count : 1, size);
  if (!memory) abort();
  return memory;
}

static double weight_difference(const work *w, uint32_t a, uint32_t b) {
  const sbf_skin *s = w->mesh->skin;
  double difference = 0;
  for (int side = 0; side < 2; side++, b ^= a, a ^= b, b ^= a)
    for (uint32_t i = w->influences[a]; i < w->influences[a] + s->influence_counts.at[a]; i++) {
      double other = 0;
      for (uint32_t j = w->influences[b]; j < w->influences[b] + s->influence_counts.at[b]; j++)
        if (s->bones.at[j] == s->bones.at[i]) other += (double)s->weights.at[j];
      if ((double)s->weights.at[i] > other) difference += (double)s->weights.at[i] - other;
    }
  return difference / 2;
}

static const sbf_vec3 *sorting;
static int compare_positions(const void *a, const void *b) {
  uint32_t i = *(const uint32_t *)a, j = *(const uint32_t *)b;
  int order = memcmp(&sorting[i], &sorting[j], sizeof *sorting);
  return order ? order : (i > j) - (i < j);
}

static void find_twins(work *w) {
  const sbf_vec3 *at = w->mesh->mesh.positions.at;
  uint32_t *order = zeroed(w->count, sizeof *order);
  for (uint32_t v = 0; v < w->count; v++) order[v] = w->twins[v] = v;
  sorting = at;
  qsort(order, w->count, sizeof *order, compare_positions);
  for (uint32_t i = 0; i < w->count; i++)
    for (uint32_t j = i; j-- > 0 && memcmp(&at[order[i]], &at[order[j]], sizeof *at) == 0;)
      if (weight_difference(w, order[i], order[j]) <= 0.25) w->twins[order[i]] = order[j];
  free(order);
}

static void find_triangles(work *w) {
  const sbf_polygon_mesh *mesh = &w->mesh->mesh;
  const uint32_t *corners = mesh->polygon_points.at;
  w->triangles = zeroed(mesh->polygon_points.count, 3 * sizeof *w->triangles);
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 1; k + 1 < mesh->polygon_sizes.at[p]; k++) {
      uint32_t *t = w->triangles + 3 * (size_t)w->triangle_count++;
      t[0] = corners[0], t[1] = corners[k], t[2] = corners[k + 1];
    }
}

/* The places of a level's points when its section, and what pins hold, moves. */
static void pose_level(const work *w, const sbf_soft_body *body, const sbf_level *level, d3 *points) {
  for (uint32_t i = 0; i < level->positions.count; i++)
    points[i] = body->bone >= 0 ? moved(&w->bones[body->bone], of(level->positions.at[i]))
                                : of(level->positions.at[i]);
  for (uint32_t s = 0; s < level->pins.count; s++)
    for (uint32_t i = 0; i < level->pins.at[s].points.count && level->pins.at[s].bone >= 0; i++) {
      uint32_t point = level->pins.at[s].points.at[i];
      points[point] = moved(&w->bones[level->pins.at[s].bone], of(level->positions.at[point]));
    }
}

static void evaluate(work *w) {
  memset(w->ours, 0, w->count * sizeof *w->ours);
  memset(w->sums, 0, w->count * sizeof *w->sums);
  for (uint32_t v = 0; v < w->count; v++) w->alone[v] = -2;
  for (uint32_t b = 0; b < w->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &w->asset->soft_bodies.at[b];
    const sbf_level *level = body->levels.count ? &body->levels.at[0] : NULL;
    for (uint32_t e = 0; level && e < level->embeddings.count; e++) {
      const sbf_embedding *by = &level->embeddings.at[e];
      if (by->render_mesh != (int32_t)w->number) continue;
      d3 *points = zeroed(level->positions.count, sizeof *points);
      pose_level(w, body, level, points);
      for (uint32_t i = 0; i < by->points.count; i++) {
        uint32_t v = by->vertices.count ? by->vertices.at[i] : i;
        double blend = by->blends.count ? (double)by->blends.at[i] : 1;
        const float weights[4] = {
            by->weights.at[i].x, by->weights.at[i].y, by->weights.at[i].z, by->weights.at[i].w};
        for (int k = 0; k < 4; k++)
          add(&w->ours[v], points[by->points.at[i].at[k]], blend * (double)weights[k]);
        w->sums[v] += blend;
        w->alone[v] = w->alone[v] == -2 ? (int32_t)b : -1;
      }
      free(points);
    }
  }
  const sbf_skin *skin = w->mesh->skin;
  for (uint32_t v = 0; v < w->count; v++) {
    d3 at = of(w->mesh->mesh.positions.at[v]), sum = {0, 0, 0};
    double weight = 0;
    for (uint32_t i = w->influences[v]; i < w->influences[v] + skin->influence_counts.at[v]; i++) {
      add(&sum, moved(&w->bones[skin->bones.at[i]], at), (double)skin->weights.at[i]);
      weight += (double)skin->weights.at[i];
    }
    w->lbs[v] = weight > 0 ? (d3){sum.x / weight, sum.y / weight, sum.z / weight} : at;
    if (w->sums[v] > 0)
      w->ours[v] = (d3){w->ours[v].x / w->sums[v], w->ours[v].y / w->sums[v], w->ours[v].z / w->sums[v]};
    else
      w->ours[v] = w->lbs[v];
  }
}

static d3 normal_of(const d3 *at, const uint32_t *t) {
  return cross(sub(at[t[1]], at[t[0]]), sub(at[t[2]], at[t[0]]));
}

/* What the corners' bones turn a normal to. */
static d3 carried_normal(const work *w, const uint32_t *t, d3 normal) {
  const sbf_skin *skin = w->mesh->skin;
  d3 sum = {0, 0, 0};
  for (int k = 0; k < 3; k++)
    for (uint32_t i = w->influences[t[k]]; i < w->influences[t[k]] + skin->influence_counts.at[t[k]]; i++)
      add(&sum, turned(&w->bones[skin->bones.at[i]], normal), (double)skin->weights.at[i]);
  return sum;
}

static void take_pose(work *w, skin_bend *r) {
  uint32_t flips = r->flips, lbs_flips = r->lbs_flips;
  evaluate(w);
  r->poses++;
  for (uint32_t v = 0; v < w->count; v++) {
    d3 off = sub(w->ours[v], w->lbs[v]), separation = sub(w->ours[v], w->ours[w->twins[v]]);
    r->lbs_distance = fmax(r->lbs_distance, sqrt(dot(off, off)) / w->size);
    r->crack = fmax(r->crack, sqrt(dot(separation, separation)) / w->size);
  }
  for (uint32_t i = 0; i < w->triangle_count; i++) {
    const uint32_t *t = w->triangles + 3 * (size_t)i;
    const sbf_vec3 *rest = w->mesh->mesh.positions.at;
    d3 at[3] = {of(rest[t[0]]), of(rest[t[1]]), of(rest[t[2]])};
    static const uint32_t own[3] = {0, 1, 2};
    d3 before = normal_of(at, own), here = normal_of(w->ours, t), there = normal_of(w->lbs, t);
    double area = sqrt(dot(before, before));
    if (!(area > 1e-9 * w->size * w->size)) continue; /* without area there is no stretch */
    d3 should = carried_normal(w, t, before);
    r->flips += dot(here, should) < 0;
    r->lbs_flips += dot(there, should) < 0;
    if (w->alone[t[0]] >= 0 && w->alone[t[0]] == w->alone[t[1]] && w->alone[t[0]] == w->alone[t[2]]) continue;
    double stretch = sqrt(dot(here, here)) / area, lbs = sqrt(dot(there, there)) / area;
    r->seam_stretch = fmax(r->seam_stretch, stretch);
    r->lbs_stretch = fmax(r->lbs_stretch, lbs);
    r->stretched += stretch > 2;
    r->lbs_stretched += lbs > 2;
    r->seam_count += r->poses == 1;
  }
  r->worse_poses += r->flips - flips > r->lbs_flips - lbs_flips;
}

static void stand_still(work *w) {
  static const motion still = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
  for (uint32_t b = 0; b < w->asset->bones.count; b++) w->bones[b] = still;
}

static void measure_rest(work *w, skin_bend *r) {
  stand_still(w);
  evaluate(w);
  for (uint32_t v = 0; v < w->count; v++) {
    d3 off = sub(w->ours[v], of(w->mesh->mesh.positions.at[v]));
    r->rest_error = fmax(r->rest_error, sqrt(dot(off, off)) / w->size);
  }
}

static void bend(work *w, uint32_t bone, int axis, double angle) {
  const sbf_bone_list bones = w->asset->bones;
  stand_still(w);
  w->bones[bone] = turn(of(bones.at[bone].head), axis_of(&bones.at[bone], axis), angle);
  for (uint32_t b = bone + 1; b < bones.count; b++)
    if (bones.at[b].parent >= (int32_t)bone) w->bones[b] = w->bones[bones.at[b].parent];
}

void skin_bend_measure(const sbf_asset *asset, uint32_t mesh, double angle_rad, skin_bend *result) {
  work w = {.asset = asset, .mesh = &asset->render_meshes.at[mesh], .number = mesh};
  const sbf_vec3_list at = w.mesh->mesh.positions;
  w.count = at.count;
  *result = (skin_bend){.poses = 0};
  for (uint32_t v = 1; v < at.count; v++) {
    d3 displacement = sub(of(at.at[v]), of(at.at[0]));
    w.size = fmax(w.size, sqrt(dot(displacement, displacement)));
  }
  w.bones = zeroed(asset->bones.count, sizeof *w.bones);
  w.ours = zeroed(w.count, sizeof *w.ours);
  w.lbs = zeroed(w.count, sizeof *w.lbs);
  w.sums = zeroed(w.count, sizeof *w.sums);
  w.twins = zeroed(w.count, sizeof *w.twins);
  w.alone = zeroed(w.count, sizeof *w.alone);
  w.influences = zeroed(w.count, sizeof *w.influences);
  for (uint32_t v = 1; v < w.count; v++)
    w.influences[v] = w.influences[v - 1] + w.mesh->skin->influence_counts.at[v - 1];
  find_triangles(&w);
  find_twins(&w);
  measure_rest(&w, result);
  for (uint32_t b = 0; b < asset->bones.count; b++)
    for (int direction = 0; asset->bones.at[b].parent >= 0 && direction < 6; direction++) {
      bend(&w, b, direction % 3, direction < 3 ? angle_rad : -angle_rad);
      take_pose(&w, result);
    }
  void *all[] = {w.bones, w.ours, w.lbs, w.sums, w.twins, w.alone, w.influences, w.triangles};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) free(all[i]);
}
