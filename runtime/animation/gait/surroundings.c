#include "animation/gait/surroundings.h"

#include "shapes/ground.h"

static const float MARGIN =
    0.5f; /* fraction of the radius of its wall volume: search distance for colliders */
static const float ABOVE = 0.01f;   /* m; rays begin this far above a shape */
static const float UPRIGHT = 0.01f; /* cosine; a steeper plane has no height */

static bool is_convex(const sbr_shape *shape) {
  return shape->kind != SBR_SHAPE_MESH && shape->kind != SBR_SHAPE_HEIGHT_FIELD &&
         shape->kind != SBR_SHAPE_HOST;
}

bool sbri_surroundings_has(const sbri_surroundings *around, uint32_t collider) {
  const sbri_collider *c = &around->colliders->at[collider];
  if (!sbri_layers_collide(c->layer, c->mask, around->wall_volume->layer, around->wall_volume->mask))
    return false;
  const sbri_collider *leader = sbri_collider_leader(around->colliders, collider);
  float cube = around->scale * around->scale * around->scale;
  return !leader || leader->body.inverse_mass * around->wall_volume->mass * cube < 1;
}

/* Pose of a collider at the beginning or end of the tick. */
typedef struct collider_pose {
  const sbr_shape *shape;
  const sbr_double3 *at;
  sbf_quat rotation;
} collider_pose;

static collider_pose collider_pose_of(const sbri_collider *c, bool begin) {
  return (collider_pose){c->shape, begin ? &c->from : &c->to, begin ? c->rotation_from : c->rotation_to};
}

/* Intersection of a vertical ray from (x, from, z) over `travel` with the shape. */
static bool enter(
    const collider_pose *s, double x, double z, double from, double travel, double *y, sbf_vec3 *normal) {
  sbf_quat into = sbri_quat_conjugate(s->rotation);
  sbf_vec3 start = {(float)(x - s->at->x), (float)(from - s->at->y), (float)(z - s->at->z)}, n;
  float fraction;
  if (!sbri_shape_enter(s->shape, sbri_rotate(into, start), sbri_rotate(into, sbri_vec3(0, (float)travel, 0)),
          &fraction, &n))
    return false;
  *y = from + (double)fraction * travel;
  *normal = sbri_rotate(s->rotation, n);
  return true;
}

static bool plane_top(const collider_pose *s, double x, double z, double *y, sbf_vec3 *normal) {
  sbf_vec3 n = sbri_rotate(s->rotation, sbri_vec3(0, 1, 0));
  if (n.y < UPRIGHT) return false;
  *y = s->at->y - ((double)n.x * (x - s->at->x) + (double)n.z * (z - s->at->z)) / (double)n.y;
  *normal = n;
  return true;
}

/* Height of a collider at (x, z): its highest point below `overhead`. For a solid collider that extends from
 * below to above that, its top, which is too high to step on. */
static bool top_of(const sbri_surroundings *around, const sbri_collider *c, bool begin, double x, double z,
    double *y, sbf_vec3 *normal) {
  collider_pose s = collider_pose_of(c, begin);
  if (s.shape->kind == SBR_SHAPE_PLANE) return plane_top(&s, x, z, y, normal);
  sbri_box box = sbri_collider_bounds(c);
  double high = (double)(box.high.y + ABOVE), low = (double)(box.low.y - ABOVE), overhead = around->overhead;
  if (high <= overhead) return enter(&s, x, z, high, low - high, y, normal);
  if (overhead > low && enter(&s, x, z, overhead, low - overhead, y, normal)) return true;
  double bottom;
  sbf_vec3 unused;
  return is_convex(s.shape) && overhead > low && enter(&s, x, z, high, low - high, y, normal) &&
         !enter(&s, x, z, overhead, high - overhead, &bottom, &unused);
}

static bool next_below(sbri_bounds_walk *walk, const sbri_surroundings *around, uint32_t *collider) {
  while (sbri_bounds_walk_next(walk, collider)) {
    *collider = around->colliders->listed[*collider];
    if (sbri_surroundings_has(around, *collider)) return true;
  }
  return false;
}

static void walk_column(
    sbri_bounds_walk *walk, const sbri_surroundings *around, double x, double z, double low) {
  sbri_box column = {{(float)x, (float)low, (float)z}, {(float)x, (float)around->overhead, (float)z}};
  sbri_bounds_walk_begin(walk, &around->colliders->tree, sbri_box_grown(column, ABOVE));
}

static double height(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  const sbri_surroundings *around = ground->user;
  double y = around->base->height(around->base, x, z, normal), top;
  sbri_bounds_walk walk;
  sbf_vec3 hit;
  uint32_t i;
  walk_column(&walk, around, x, z, y < around->overhead ? y : around->overhead);
  while (next_below(&walk, around, &i))
    if (top_of(around, &around->colliders->at[i], false, x, z, &top, &hit) && top > y) y = top, *normal = hit;
  return y;
}

bool sbri_surroundings_bearer(
    const sbri_surroundings *around, sbr_double3 position, double tolerance, uint32_t *collider) {
  sbri_bounds_walk walk;
  sbf_vec3 normal;
  double best = tolerance, y;
  uint32_t i;
  bool any = false;
  walk_column(&walk, around, position.x, position.z, position.y - tolerance);
  while (next_below(&walk, around, &i)) {
    if (!top_of(around, &around->colliders->at[i], true, position.x, position.z, &y, &normal)) continue;
    double away = y > position.y ? y - position.y : position.y - y;
    if (away < best || (any && away == best && i < *collider)) best = away, *collider = i, any = true;
  }
  return any;
}

void sbri_surroundings_find(const sbri_rig *rig, float scale, const sbri_collider_set *colliders,
    const sbr_ground *base, sbr_double3 position, sbri_surroundings *out) {
  const sbri_wall_volume *wall_volume = &rig->wall_volume;
  *out = (sbri_surroundings){.base = base,
      .wall_volume = wall_volume,
      .scale = scale,
      .overhead = position.y + (double)(wall_volume->step_up * scale)};
  out->ground = (sbr_ground){.height = height, .user = out};
  if (!wall_volume->wall_sphere_count || !colliders->tree.node_count) return;
  float reach = wall_volume->radius * (1 + MARGIN) * scale,
        low = (float)sbri_ground_height(base, position.x, position.z, NULL);
  sbri_box box = sbri_box_grown(
      sbri_box_of_point(sbri_vec3((float)position.x, (float)position.y, (float)position.z)), reach);
  if (low < box.low.y) box.low.y = low; /* the surface on which it would land */
  sbri_bounds_walk walk;
  uint32_t i;
  sbri_bounds_walk_begin(&walk, &colliders->tree, box);
  out->colliders = colliders;
  if (!next_below(&walk, out, &i)) out->colliders = NULL;
}
