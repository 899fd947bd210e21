#include "part_shapes.h"

#include <math.h>
#include <stdlib.h>

#include "turns.h"

/* Minimum distance that a hull lies outside of its points, m and as a fraction of their size: flat parts need
 * a volume. */
static const float MARGIN_M = 0.001f, MARGIN = 0.01f;

static float dot(sbf_vec3 a, sbf_vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Point i of a Fibonacci lattice on the unit sphere. */
static sbf_vec3 direction_of(uint32_t i) {
  float y = 1 - (2 * (float)i + 1) / PART_POINTS, r = sqrtf(1 - y * y), angle = 2.3999632f * (float)i;
  return (sbf_vec3){r * cosf(angle), y, r * sinf(angle)};
}

/* The outermost points in evenly spread directions, which are stretched as the points are. */
static void hull_around(const sbf_vec3 *points, uint32_t count, sbf_vec3 hull[PART_POINTS]) {
  sbf_vec3 low = points[0], high = points[0];
  for (uint32_t i = 1; i < count; i++) {
    sbf_vec3 p = points[i];
    low = (sbf_vec3){fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z)};
    high = (sbf_vec3){fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z)};
  }
  sbf_vec3 size = {high.x - low.x, high.y - low.y, high.z - low.z};
  float largest = fmaxf(size.x, fmaxf(size.y, size.z)), margin = fmaxf(MARGIN_M, MARGIN * largest);
  sbf_vec3 inverse = {
      1 / fmaxf(size.x, 2 * margin), 1 / fmaxf(size.y, 2 * margin), 1 / fmaxf(size.z, 2 * margin)};
  for (uint32_t k = 0; k < PART_POINTS; k++) {
    sbf_vec3 outward = direction_of(k);
    sbf_vec3 d = {outward.x * inverse.x, outward.y * inverse.y, outward.z * inverse.z};
    uint32_t best = 0;
    for (uint32_t i = 1; i < count; i++)
      if (dot(points[i], d) > dot(points[best], d)) best = i;
    sbf_vec3 p = points[best];
    hull[k] = (sbf_vec3){p.x + margin * outward.x, p.y + margin * outward.y, p.z + margin * outward.z};
  }
}

/* ---- Points of a part ---- */

typedef struct point_set {
  sbf_vec3 *at; /* capacity for all points of the asset */
  uint32_t count;
} point_set;

static void add_all(point_set *set, const sbf_vec3_list *points) {
  for (uint32_t i = 0; i < points->count; i++) set->at[set->count++] = points->at[i];
}

/* The bone with the maximum weight of a skinned point; -1: none. */
static int32_t leading_bone(const sbf_skin *skin, uint32_t first, uint32_t count) {
  uint32_t best = first;
  for (uint32_t i = first + 1; i < first + count; i++)
    if (skin->weights.at[i] > skin->weights.at[best]) best = i;
  return count ? (int32_t)skin->bones.at[best] : -1;
}

static void add_skinned(point_set *set, const sbf_render_mesh *mesh, int32_t bone) {
  uint32_t at = 0;
  if (!mesh->skin) {
    if (mesh->bone == bone) add_all(set, &mesh->mesh.positions);
    return;
  }
  for (uint32_t i = 0; i < mesh->mesh.positions.count; at += mesh->skin->influence_counts.at[i++])
    if (leading_bone(mesh->skin, at, mesh->skin->influence_counts.at[i]) == bone)
      set->at[set->count++] = mesh->mesh.positions.at[i];
}

/* Sections of the bone, else its rigid bodies, else its skin. */
static void collect_bone(
    const sbf_asset *asset, int32_t bone, bool loose, point_set *set, int32_t *soft_body) {
  for (uint32_t i = 0; !loose && i < asset->soft_bodies.count; i++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[i];
    if (body->bone != bone) continue;
    add_all(set, &body->surface.positions);
    if (*soft_body < 0) *soft_body = (int32_t)i;
  }
  for (uint32_t i = 0; *soft_body < 0 && i < asset->rigid_bodies.count; i++) {
    const sbf_rigid_body *body = &asset->rigid_bodies.at[i];
    if (body->bone == bone && body->hull) add_all(set, &body->hull->positions);
  }
  for (uint32_t i = 0; !loose && !set->count && i < asset->render_meshes.count; i++)
    add_skinned(set, &asset->render_meshes.at[i], bone);
}

static sbf_vec3 middle_of(const point_set *set) {
  double x = 0, y = 0, z = 0, n = set->count;
  for (uint32_t i = 0; i < set->count; i++)
    x += (double)set->at[i].x, y += (double)set->at[i].y, z += (double)set->at[i].z;
  return (sbf_vec3){(float)(x / n), (float)(y / n), (float)(z / n)};
}

/* Takes the points into the frame of a part, and their hull. */
static void enclose(part_shape *part, point_set *set, sbf_vec3 origin, sbf_quat rotation, float scale) {
  for (uint32_t i = 0; i < set->count; i++) {
    sbf_vec3 p = set->at[i];
    p = turned(turn_back(rotation), (sbf_vec3){p.x - origin.x, p.y - origin.y, p.z - origin.z});
    set->at[i] = (sbf_vec3){scale * p.x, scale * p.y, scale * p.z};
  }
  hull_around(set->at, set->count, part->hull);
}

static uint32_t count_points(const sbf_asset *asset) {
  uint32_t count = 1;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    count += asset->soft_bodies.at[i].surface.positions.count;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    count += asset->render_meshes.at[i].mesh.positions.count;
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++)
    if (asset->rigid_bodies.at[i].hull) count += asset->rigid_bodies.at[i].hull->positions.count;
  return count;
}

part_shape *part_shapes_make(const sbf_asset *asset, float scale, bool loose, uint32_t *count) {
  uint32_t bones = asset->bones.count, bodies = asset->soft_bodies.count;
  part_shape *made = malloc((bones + bodies + 1) * sizeof *made);
  point_set set = {malloc(count_points(asset) * sizeof *set.at), 0};
  *count = 0;
  for (uint32_t i = 0; made && set.at && i < bones; i++) {
    part_shape *part = &made[*count];
    *part = (part_shape){.bone = (int32_t)i, .soft_body = -1};
    set.count = 0;
    collect_bone(asset, (int32_t)i, loose, &set, &part->soft_body);
    if (!set.count) continue;
    enclose(part, &set, asset->bones.at[i].head, asset->bones.at[i].rotation, scale);
    ++*count;
  }
  for (uint32_t i = 0; made && set.at && i < bodies; i++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[i];
    part_shape *part = &made[*count];
    if ((body->bone >= 0 && !loose) || !body->surface.positions.count) continue;
    *part = (part_shape){.bone = body->bone, .soft_body = (int32_t)i, .follows_surface = true};
    set.count = 0;
    add_all(&set, &body->surface.positions);
    part->middle = middle_of(&set);
    enclose(part, &set, part->middle, (sbf_quat){0, 0, 0, 1}, scale);
    ++*count;
  }
  free(set.at);
  if (*count) return made;
  free(made);
  return NULL;
}

/* ---- Rotation of a surface ---- */

/* Iterative extraction of the rotation of a matrix (Müller et al. 2016). */
sbf_quat part_rotation(const sbf_vec3 *rest, sbf_vec3 middle, const sbf_vec3 *now, sbf_vec3 center,
    uint32_t count, sbf_quat guess) {
  enum { ROUNDS = 12 };
  sbf_vec3 a[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}; /* columns: where the axes at rest go */
  for (uint32_t i = 0; i < count; i++) {
    sbf_vec3 r = {rest[i].x - middle.x, rest[i].y - middle.y, rest[i].z - middle.z};
    sbf_vec3 p = {now[i].x - center.x, now[i].y - center.y, now[i].z - center.z};
    const float along[3] = {r.x, r.y, r.z};
    for (int k = 0; k < 3; k++)
      a[k] = (sbf_vec3){a[k].x + along[k] * p.x, a[k].y + along[k] * p.y, a[k].z + along[k] * p.z};
  }
  for (int round = 0; round < ROUNDS; round++) {
    sbf_vec3 axes[3] = {turned(guess, (sbf_vec3){1, 0, 0}), turned(guess, (sbf_vec3){0, 1, 0}),
        turned(guess, (sbf_vec3){0, 0, 1})};
    sbf_vec3 sum = {0, 0, 0};
    float fit = 0;
    for (int k = 0; k < 3; k++) {
      sbf_vec3 c = turn_cross(axes[k], a[k]);
      sum = (sbf_vec3){sum.x + c.x, sum.y + c.y, sum.z + c.z};
      fit += dot(axes[k], a[k]);
    }
    float scale = 1 / (fabsf(fit) + 1e-30f), angle = scale * sqrtf(dot(sum, sum));
    if (!(angle > 1e-6f)) break;
    float half = sinf(angle / 2) * scale / angle;
    guess = turn_product((sbf_quat){half * sum.x, half * sum.y, half * sum.z, cosf(angle / 2)}, guess);
  }
  float length = sqrtf(guess.x * guess.x + guess.y * guess.y + guess.z * guess.z + guess.w * guess.w);
  return (sbf_quat){guess.x / length, guess.y / length, guess.z / length, guess.w / length};
}
