/* Collects the skin of a rig as points with the bone of greatest weight, and finds its plane of symmetry. */
#include <math.h>

#include "import/gait/locomotion.h"
#include "motion/retargeting.h"

enum {
  SAMPLED = 400,
  COMPARED = 6000
};                      /* points that are mirrored, and points that they are compared with */
enum { MIN_NAMED = 2 }; /* minimum number of bones that name a side */
/* minimum difference between the scores of names along x and along z */
static const double CLEAR_VOTES = 0.3;
static const double CLEARLY = 0.85; /* maximum ratio of errors for facing along X to be the better guess */

static void add_point(sbfi_rig_points *points, const sbfi_gait_draft *seen, sbf_vec3 at, int32_t bone) {
  points->at[points->count] = sbfi_draft_seen(seen, at);
  points->bone[points->count++] = bone;
}

static void add_mesh(sbfi_rig_points *points, const sbfi_gait_draft *seen, const sbf_render_mesh *mesh) {
  const sbf_skin *skin = mesh->skin;
  for (uint32_t i = 0, at = 0; i < mesh->mesh.positions.count; i++) {
    int32_t bone = skin ? SBF_NONE : mesh->bone;
    uint32_t end = skin ? at + skin->influence_counts.at[i] : 0, max = at;
    for (uint32_t s = at; s < end; s++)
      if (skin->weights.at[s] > skin->weights.at[max]) max = s;
    if (skin && at < end) bone = (int32_t)skin->bones.at[max];
    at = end;
    if (bone != SBF_NONE) add_point(points, seen, mesh->mesh.positions.at[i], bone);
  }
}

static void measure(sbfi_rig_points *points) {
  for (int k = 0; k < 3; k++) {
    points->low[k] = INFINITY;
    points->high[k] = -INFINITY;
  }
  for (uint32_t i = 0; i < points->count; i++) {
    const double p[3] = {(double)points->at[i].x, (double)points->at[i].y, (double)points->at[i].z};
    for (int k = 0; k < 3; k++) {
      points->low[k] = fmin(points->low[k], p[k]);
      points->high[k] = fmax(points->high[k], p[k]);
    }
  }
}

bool sbfi_gather_points(
    const sbf_asset *asset, uint32_t turns, sbfi_arena *scratch, sbfi_rig_points *points) {
  sbfi_gait_draft seen = {.turns = turns};
  size_t max = asset->bones.count;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++)
    max += asset->soft_bodies.at[b].surface.positions.count;
  for (uint32_t m = 0; m < asset->render_meshes.count; m++)
    max += asset->render_meshes.at[m].mesh.positions.count;
  points->count = 0;
  points->at = sbfi_arena_allocate(scratch, max, sizeof *points->at);
  points->bone = sbfi_arena_allocate(scratch, max, sizeof *points->bone);
  if (!points->at || !points->bone || !sbfi_rig_center(asset, scratch, &seen.center)) return false;
  points->center = seen.center;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &asset->soft_bodies.at[b];
    for (uint32_t i = 0; body->bone != SBF_NONE && i < body->surface.positions.count; i++)
      add_point(points, &seen, body->surface.positions.at[i], body->bone);
  }
  for (uint32_t m = 0; m < asset->render_meshes.count; m++)
    add_mesh(points, &seen, &asset->render_meshes.at[m]);
  for (uint32_t i = 0; points->count == 0 && i < asset->bones.count; i++)
    points->at[i] = sbfi_draft_seen(&seen, asset->bones.at[i].head);
  points->are_heads = points->count == 0;
  if (points->are_heads)
    for (uint32_t i = 0; i < asset->bones.count; i++) points->bone[points->count++] = (int32_t)i;
  measure(points);
  return true;
}

/* Mean distance from mirrored points to their nearest points, as a fraction of the size. The mirror plane
 * is at the rig's middle or in the middle of the extent, whichever fits better. `axis` 0: across x, 2: across
 * z. */
static double mirror_error(const sbfi_rig_points *points, int axis) {
  double size = 0, best = INFINITY;
  for (int k = 0; k < 3; k++) size = fmax(size, points->high[k] - points->low[k]);
  uint32_t sample_step = points->count / SAMPLED + 1, compare = points->count / COMPARED + 1;
  for (int middle = 0; middle < 2; middle++) {
    double plane = middle ? 0.5 * (points->low[axis] + points->high[axis]) : 0, sum = 0;
    uint32_t sampled = 0;
    for (uint32_t i = 0; i < points->count; i += sample_step, sampled++) {
      double p[3] = {(double)points->at[i].x, (double)points->at[i].y, (double)points->at[i].z};
      double nearest = INFINITY;
      p[axis] = 2 * plane - p[axis];
      for (uint32_t k = i % compare; k < points->count; k += compare) {
        double x = (double)points->at[k].x - p[0], y = (double)points->at[k].y - p[1];
        double z = (double)points->at[k].z - p[2];
        nearest = fmin(nearest, x * x + y * y + z * z);
      }
      sum += sqrt(nearest);
    }
    best = fmin(best, sum / (sampled * size));
  }
  return best;
}

/* Scores named sides along x and z: difference of left and right bones as a fraction of the maximum. */
static uint32_t ask_sides(const sbf_asset *asset, sbf_vec3 center, double votes[2]) {
  uint32_t named = 0;
  double max[2] = {0, 0};
  votes[0] = votes[1] = 0;
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    int side = sbfi_name_side(asset->bones.at[i].name);
    const sbf_vec3 at = asset->bones.at[i].head;
    const double head[2] = {(double)at.x - (double)center.x, (double)at.z - (double)center.z};
    if (!side) continue;
    named++;
    for (int k = 0; k < 2; k++) {
      votes[k] += side * head[k];
      max[k] += fabs(head[k]);
    }
  }
  for (int k = 0; k < 2; k++) votes[k] = max[k] > 0 ? fabs(votes[k]) / max[k] : 0;
  return named;
}

uint32_t sbfi_mirror_turns(const sbf_asset *asset, const sbfi_rig_points *points, bool *clear) {
  static const double noise = 1e-3; /* fraction of the size; below it both planes are good */
  double votes[2];
  *clear = true;
  if (ask_sides(asset, points->center, votes) >= MIN_NAMED && fabs(votes[0] - votes[1]) > CLEAR_VOTES)
    return votes[1] > votes[0];
  if (points->are_heads || points->count < 3) return 0; /* heads of bones often lie in one plane */
  *clear = false;
  double across_x = mirror_error(points, 0), across_z = mirror_error(points, 2);
  *clear = fmax(across_x, across_z) > 3 * fmin(across_x, across_z) + 5 * noise;
  return across_z + noise < CLEARLY * across_x;
}
