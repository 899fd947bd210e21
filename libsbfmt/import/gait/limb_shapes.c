/* Finds limbs (parts of a rig whose skin is on one side), their shapes, and which limbs mirror each other. */
#include <math.h>

#include "import/gait/locomotion.h"
#include "mechanics/symmetric_eigen.h"

enum { SECTORS = 12, MIN_ROUND_POINTS = 12, MIN_LOOP = 8 };
static const double TWINS = 0.12;          /* fraction of the size; maximum difference of mirrored extents */
static const double TWIN_SEPARATION = 0.4; /* the same for limbs in different poses with equal point counts */
static const double ROUND_EXTENT = 0.8; /* minimum ratio of a disc's height and length, smaller by greater */
static const double ROUND_RADIUS = 0.8; /* minimum ratio of a disc's radii by sector, smallest by greatest */

static void extend_box(double low[3], double high[3], sbf_vec3 point) {
  const double p[3] = {(double)point.x, (double)point.y, (double)point.z};
  for (int k = 0; k < 3; k++) {
    low[k] = fmin(low[k], p[k]);
    high[k] = fmax(high[k], p[k]);
  }
}

/* Measures extents along the principal axes of the points. */
static void measure_own(
    const sbfi_rig_points *points, const int32_t *limb_of, int32_t limb, sbfi_limb_shape *shape) {
  double mean[3] = {0}, spread[9] = {0}, axes[9], extent[3];
  uint32_t count = 0;
  for (uint32_t i = 0; i < points->count; i++) {
    if (limb_of[points->bone[i]] != limb) continue;
    mean[0] += (double)points->at[i].x;
    mean[1] += (double)points->at[i].y;
    mean[2] += (double)points->at[i].z;
    count++;
  }
  shape->flatness = shape->slimness = 1;
  if (count < 4) return;
  for (int k = 0; k < 3; k++) mean[k] /= count;
  for (uint32_t i = 0; i < points->count; i++) {
    if (limb_of[points->bone[i]] != limb) continue;
    const double d[3] = {(double)points->at[i].x - mean[0], (double)points->at[i].y - mean[1],
        (double)points->at[i].z - mean[2]};
    for (int r = 0; r < 3; r++)
      for (int k = 0; k < 3; k++) spread[3 * r + k] += d[r] * d[k];
  }
  sbfi_symmetric_compute_eigen(3, spread, axes);
  for (int k = 0; k < 3; k++) extent[k] = sqrt(fmax(0, spread[4 * k]));
  for (int a = 0; a < 2; a++)
    for (int b = 0; b < 2 - a; b++)
      if (extent[b] > extent[b + 1]) {
        double swap = extent[b];
        extent[b] = extent[b + 1];
        extent[b + 1] = swap;
      }
  if (extent[1] > 0) shape->flatness = extent[0] / extent[1];
  if (extent[2] > 0) shape->slimness = extent[1] / extent[2];
}

/* Whether a limb is a disc seen from the side: as high as long, no wider, and with the same radius in
 * every sector. */
static bool is_disc(
    const sbfi_rig_points *points, const int32_t *limb_of, int32_t limb, const sbfi_limb_shape *shape) {
  double height = shape->high[1] - shape->low[1], length = shape->high[2] - shape->low[2];
  double width = shape->high[0] - shape->low[0], radius[SECTORS] = {0};
  if (shape->points < MIN_ROUND_POINTS || !(height > 0) || !(length > 0)) return false;
  if (fmin(height, length) < ROUND_EXTENT * fmax(height, length) || width > 1.1 * height) return false;
  for (uint32_t i = 0; i < points->count; i++) {
    if (limb_of[points->bone[i]] != limb) continue;
    double y = (double)points->at[i].y - 0.5 * (shape->low[1] + shape->high[1]);
    double z = (double)points->at[i].z - 0.5 * (shape->low[2] + shape->high[2]);
    int sector = (int)((atan2(y, z) / 6.283185307179586 + 0.5) * SECTORS) % SECTORS;
    radius[sector] = fmax(radius[sector], sqrt(y * y + z * z));
  }
  double min = INFINITY, max = 0;
  for (int k = 0; k < SECTORS; k++) {
    min = fmin(min, radius[k]);
    max = fmax(max, radius[k]);
  }
  return min > ROUND_RADIUS * max && max < 1.2 * 0.5 * fmax(height, length);
}

/* Whether siblings on one side form an upright loop around their centre: links of a track. */
static bool is_in_loop(const sbfi_gait_draft *d, const sbfi_limb_shape *limbs, uint32_t limb_count,
    const sbfi_limb_shape *limb) {
  double y = 0, z = 0;
  uint32_t count = 0, filled = 0;
  bool sectors[SECTORS] = {false};
  int32_t parent = sbfi_draft_bone(d, limb->root)->parent;
  for (int pass = 0; pass < 2; pass++) {
    for (uint32_t l = 0; l < limb_count; l++) {
      const sbfi_limb_shape *one = &limbs[l];
      if (sbfi_draft_bone(d, one->root)->parent != parent || one->side != limb->side || !one->points)
        continue;
      double at_y = 0.5 * (one->low[1] + one->high[1]), at_z = 0.5 * (one->low[2] + one->high[2]);
      if (pass == 0) {
        y += at_y;
        z += at_z;
        count++;
      } else {
        double angle = atan2(at_y - y / count, at_z - z / count);
        sectors[(int)((angle / 6.283185307179586 + 0.5) * SECTORS) % SECTORS] = true;
      }
    }
    if (count < MIN_LOOP) return false;
  }
  for (int k = 0; k < SECTORS; k++) filled += sectors[k];
  return filled * 3 >= SECTORS * 2;
}

/* Error of two limbs as mirror images, m. */
static double twin_error(const sbfi_limb_shape *a, const sbfi_limb_shape *b) {
  double error = fmax(fabs(a->low[0] + b->high[0]), fabs(a->high[0] + b->low[0]));
  for (int k = 1; k < 3; k++)
    error = fmax(error, fmax(fabs(a->low[k] - b->low[k]), fabs(a->high[k] - b->high[k])));
  return error;
}

/* In a rig bound in mid stride, twins are recognized by their numbers of points and bones. */
static bool are_alike(const sbfi_limb_shape *a, const sbfi_limb_shape *b) {
  uint32_t slack = (a->points + b->points) / 100;
  return a->bones == b->bones && a->points > 0 && a->points <= b->points + slack &&
         b->points <= a->points + slack;
}

static int32_t nearest_twin(
    const sbfi_limb_shape *limbs, uint32_t count, uint32_t a, double within, bool alike) {
  int32_t twin = SBF_NONE;
  for (uint32_t b = 0; b < count; b++) {
    double error = limbs[a].side == limbs[b].side ? INFINITY : twin_error(&limbs[a], &limbs[b]);
    if (!(error <= within) || (alike && (limbs[b].twin != SBF_NONE || !are_alike(&limbs[a], &limbs[b]))))
      continue;
    within = error;
    twin = (int32_t)b;
  }
  return twin;
}

/* Twins are mutually nearest. */
static void find_twins(const sbfi_rig_points *points, sbfi_limb_shape *limbs, uint32_t count) {
  double size = 0;
  for (int k = 0; k < 3; k++) size = fmax(size, points->high[k] - points->low[k]);
  for (int alike = 0; alike < 2; alike++)
    for (uint32_t a = 0; a < count; a++) {
      double within = (alike ? TWIN_SEPARATION : TWINS) * size;
      if (limbs[a].twin != SBF_NONE) continue;
      int32_t b = nearest_twin(limbs, count, a, within, alike);
      if (b == SBF_NONE || nearest_twin(limbs, count, (uint32_t)b, within, alike) != (int32_t)a) continue;
      limbs[a].twin = b;
      limbs[b].twin = (int32_t)a;
    }
}

bool sbfi_find_limbs(const sbfi_gait_draft *d, const sbfi_rig_points *points, sbfi_arena *scratch,
    sbfi_limb_shape *limbs, uint32_t *count) {
  uint32_t bones = d->asset->bones.count;
  int32_t *limb_of = sbfi_arena_allocate(scratch, (size_t)bones + 1, sizeof *limb_of);
  uint32_t *holds = sbfi_arena_allocate(scratch, (size_t)bones + 1, sizeof *holds);
  if (!limb_of || !holds) return false;
  *count = 0;
  for (uint32_t i = 0; i < bones; i++) {
    int32_t parent = sbfi_draft_bone(d, (int32_t)i)->parent;
    bool inside = parent != SBF_NONE && limb_of[parent] != SBF_NONE;
    limb_of[i] = inside ? limb_of[parent] : SBF_NONE;
    if (inside || !d->shapes[i].side) continue;
    limb_of[i] = (int32_t)*count;
    limbs[*count] = (sbfi_limb_shape){.root = (int32_t)i,
        .side = d->shapes[i].side,
        .low = {INFINITY, INFINITY, INFINITY},
        .high = {-INFINITY, -INFINITY, -INFINITY},
        .twin = SBF_NONE};
    (*count)++;
  }
  for (uint32_t i = 0; i < points->count; i++) {
    if (limb_of[points->bone[i]] == SBF_NONE) continue;
    sbfi_limb_shape *limb = &limbs[limb_of[points->bone[i]]];
    extend_box(limb->low, limb->high, points->at[i]);
    limb->points++;
    if (holds[points->bone[i]]++ == 0) limb->bones++;
  }
  for (uint32_t l = 0; l < *count; l++) {
    measure_own(points, limb_of, (int32_t)l, &limbs[l]);
    limbs[l].is_round = is_disc(points, limb_of, (int32_t)l, &limbs[l]);
    limbs[l].is_loop = is_in_loop(d, limbs, *count, &limbs[l]);
  }
  find_twins(points, limbs, *count);
  return true;
}

bool sbfi_view_rig(sbfi_rig_view *view, const sbf_asset *asset, uint32_t turns, sbfi_arena *scratch) {
  uint32_t bones = asset->bones.count;
  *view = (sbfi_rig_view){.draft = {.asset = (sbf_asset *)(uintptr_t)asset, .turns = turns}};
  view->limbs = sbfi_arena_allocate(scratch, (size_t)bones + 1, sizeof *view->limbs);
  view->holds = sbfi_arena_allocate(scratch, (size_t)bones + 1, sizeof *view->holds);
  if (!view->limbs || !view->holds || !sbfi_gather_points(asset, turns, scratch, &view->points)) return false;
  if (!sbfi_draft_shapes(&view->draft, scratch)) return false;
  for (uint32_t i = 0; i < view->points.count; i++) view->holds[view->points.bone[i]]++;
  return sbfi_find_limbs(&view->draft, &view->points, scratch, view->limbs, &view->limb_count);
}
