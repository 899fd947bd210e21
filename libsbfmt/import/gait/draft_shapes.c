/* Measures the input of a gait draft: extents of each bone's points, and the side it is on. */
#include <math.h>
#include <string.h>

#include "import/gait/gait_draft.h"
#include "model/bone_ends.h"

/* fraction of the height; points this close to the plane of symmetry are in the middle */
static const double SIDE_FRACTION = 0.02;
static const double FLAT_FRACTION = 0.006; /* fraction of the greatest extent, used for flat characters */

double sbfi_draft_distance(const sbfi_gait_draft *d, int32_t a, int32_t b) {
  const sbf_vec3 p = sbfi_draft_bone(d, a)->head, q = sbfi_draft_bone(d, b)->head;
  double x = (double)p.x - (double)q.x, y = (double)p.y - (double)q.y, z = (double)p.z - (double)q.z;
  return sqrt(x * x + y * y + z * z);
}

bool sbfi_draft_is_below(const sbfi_gait_draft *d, int32_t bone, int32_t ancestor) {
  while (bone != ancestor && bone != SBF_NONE) bone = sbfi_draft_bone(d, bone)->parent;
  return bone == ancestor;
}

int32_t sbfi_draft_only_child(const sbfi_gait_draft *d, int32_t bone) {
  if (d->shapes[bone].children != 1) return SBF_NONE;
  for (uint32_t i = (uint32_t)bone + 1; i < d->asset->bones.count; i++)
    if (sbfi_draft_bone(d, (int32_t)i)->parent == bone && d->shapes[i].moves_points) return (int32_t)i;
  return SBF_NONE;
}

typedef struct extents {
  double low[3], high[3];
  bool all;      /* also counts points without a bone */
  double *sum_x; /* (bones) sum over the points of each bone */
} extents;

static void extend(extents *e, sbf_vec3 point) {
  const double p[3] = {(double)point.x, (double)point.y, (double)point.z};
  for (int k = 0; k < 3; k++) {
    e->low[k] = fmin(e->low[k], p[k]);
    e->high[k] = fmax(e->high[k], p[k]);
  }
}

static void add_bone_point(sbfi_gait_draft *d, extents *e, uint32_t bone, sbf_vec3 point) {
  sbfi_bone_shape *shape = &d->shapes[bone];
  shape->points++;
  shape->low = fmin(shape->low, (double)point.y);
  shape->sum_z += (double)point.z;
  e->sum_x[bone] += (double)point.x;
}

static void add_points(sbfi_gait_draft *d, extents *e, const sbf_vec3_list points, int32_t bone) {
  for (uint32_t i = 0; i < points.count; i++) {
    sbf_vec3 point = sbfi_draft_seen(d, points.at[i]);
    if (bone >= 0 || e->all) extend(e, point);
    if (bone >= 0) add_bone_point(d, e, (uint32_t)bone, point);
  }
}

static void add_skin(sbfi_gait_draft *d, extents *e, const sbf_render_mesh *mesh) {
  const sbf_skin *skin = mesh->skin;
  for (uint32_t i = 0, at = 0; i < mesh->mesh.positions.count; at += skin->influence_counts.at[i++]) {
    uint32_t max = at;
    for (uint32_t s = at; s < at + skin->influence_counts.at[i]; s++)
      if (skin->weights.at[s] > skin->weights.at[max]) max = s;
    sbf_vec3 point = sbfi_draft_seen(d, mesh->mesh.positions.at[i]);
    if (skin->influence_counts.at[i] || e->all) extend(e, point);
    if (skin->influence_counts.at[i]) add_bone_point(d, e, skin->bones.at[max], point);
  }
}

static void add_meshes(sbfi_gait_draft *d, extents *e) {
  const sbf_asset *a = d->asset;
  for (uint32_t b = 0; b < a->soft_bodies.count; b++)
    add_points(d, e, a->soft_bodies.at[b].surface.positions, a->soft_bodies.at[b].bone);
  for (uint32_t m = 0; m < a->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &a->render_meshes.at[m];
    if (mesh->skin)
      add_skin(d, e, mesh);
    else
      add_points(d, e, mesh->mesh.positions, mesh->bone);
  }
  d->has_mesh = e->low[0] <= e->high[0];
}

/* A floor or a prop beside the character must not make it taller. If no bone has points, all points count. */
static void add_all_points(sbfi_gait_draft *d, extents *e) {
  const sbf_asset *a = d->asset;
  add_meshes(d, e);
  if (!d->has_mesh) {
    e->all = true;
    add_meshes(d, e);
  }
  for (uint32_t i = 0; i < a->bones.count && !d->has_mesh; i++) extend(e, sbfi_draft_head(d, (int32_t)i));
}

static void widen(sbfi_bone_shape *shape, double min_x, double max_x) {
  shape->min_x = fmin(shape->min_x, min_x);
  shape->max_x = fmax(shape->max_x, max_x);
}

/* Children come after their parents, so a reverse pass handles each bone after its descendants. */
static void gather_upwards(sbfi_gait_draft *d, const extents *e) {
  double extent = fmax(e->high[0] - e->low[0], e->high[2] - e->low[2]);
  double margin = fmax(SIDE_FRACTION * d->height, FLAT_FRACTION * extent);
  for (uint32_t i = d->asset->bones.count; i-- > 0;) {
    sbfi_bone_shape *shape = &d->shapes[i];
    const sbf_bone *bone = sbfi_draft_bone(d, (int32_t)i);
    if (!d->has_mesh) {
      shape->moves_points |= !sbfi_name_is_end(bone->name, strlen(bone->name));
      shape->low = (double)bone->head.y; /* tips mark the end of the bones above them */
    }
    shape->moves_points |= shape->points > 0;
    shape->low_below = fmin(shape->low_below, shape->low);
    if (shape->points) widen(shape, e->sum_x[i] / shape->points, e->sum_x[i] / shape->points);
    double head_x = (double)sbfi_draft_head(d, (int32_t)i).x;
    if (shape->moves_points) widen(shape, head_x, head_x);
    shape->side = shape->moves_points && shape->min_x > -margin && shape->max_x > margin   ? 1
                  : shape->moves_points && shape->max_x < margin && shape->min_x < -margin ? -1
                                                                                           : 0;
    if (bone->parent == SBF_NONE) continue;
    sbfi_bone_shape *parent = &d->shapes[bone->parent];
    parent->low_below = fmin(parent->low_below, shape->low_below);
    if (!shape->moves_points) continue;
    parent->moves_points = true;
    parent->children++;
    parent->middle_children += shape->side == 0;
    widen(parent, shape->min_x, shape->max_x);
  }
}

bool sbfi_draft_shapes(sbfi_gait_draft *d, sbfi_arena *scratch) {
  uint32_t count = d->asset->bones.count;
  extents e = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, false, NULL};
  d->shapes = sbfi_arena_allocate(scratch, count, sizeof *d->shapes);
  e.sum_x = sbfi_arena_allocate(scratch, count, sizeof *e.sum_x);
  if (!d->shapes || !e.sum_x || !sbfi_rig_center(d->asset, scratch, &d->center)) return false;
  for (uint32_t i = 0; i < count; i++)
    d->shapes[i] =
        (sbfi_bone_shape){.low = INFINITY, .low_below = INFINITY, .min_x = INFINITY, .max_x = -INFINITY};
  add_all_points(d, &e);
  d->ground = e.low[1];
  d->height = e.high[1] - e.low[1];
  d->low_z = e.low[2];
  d->high_z = e.high[2];
  gather_upwards(d, &e);
  return true;
}
