#include "build/weights/bone_fit.h"

#include <stdlib.h>

enum { SAMPLES = 8, MAX_RAYS = 8192 };
/* Fraction of the surface ignored at each end of its extent: spears and whiskers. */
static const double TAIL = 0.01;
/* Offset below the surface at which rays start. */
static const double BELOW = 1e-4;

typedef struct measured {
  double value, area;
} measured;

static int compare_measured(const void *left, const void *right) {
  double a = ((const measured *)left)->value, b = ((const measured *)right)->value;
  return a < b ? -1 : a > b;
}

/* Value at a fraction of the area. */
static double at_fraction(const measured *sorted, uint32_t count, double fraction) {
  double all = 0, sum = 0;
  for (uint32_t i = 0; i < count; i++) all += sorted[i].area;
  for (uint32_t i = 0; i < count; i++) {
    sum += sorted[i].area;
    if (sum >= fraction * all) return sorted[i].value;
  }
  return 0;
}

static double coordinate(sbfi_d3 p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/* Longest side of the surface, and of the bones. */
static double extent_of_surface(const sbfi_weight_mesh *mesh, measured *buffer) {
  double longest = 0;
  for (int axis = 0; axis < 3; axis++) {
    for (uint32_t i = 0; i < mesh->site_count; i++)
      buffer[i] = (measured){coordinate(sbfi_d3_of(mesh->sites[i]), axis), mesh->areas[i]};
    qsort(buffer, mesh->site_count, sizeof *buffer, compare_measured);
    longest = fmax(longest,
        at_fraction(buffer, mesh->site_count, 1 - TAIL) - at_fraction(buffer, mesh->site_count, TAIL));
  }
  return longest;
}

static double extent_of_bones(const sbfi_bone_segment *segments, uint32_t bone_count) {
  double longest = 0;
  for (int axis = 0; axis < 3; axis++) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t b = 0; b < bone_count; b++) {
      if (!segments[b].is_deforming) continue;
      double head = coordinate(segments[b].head, axis), tail = coordinate(segments[b].tail, axis);
      low = fmin(low, fmin(head, tail));
      high = fmax(high, fmax(head, tail));
    }
    longest = fmax(longest, high - low);
  }
  return longest;
}

static double inside_fraction(
    const sbfi_body_rays *rays, const sbfi_bone_segment *segments, uint32_t bone_count) {
  double inside = 0, all = 0;
  for (uint32_t b = 0; b < bone_count; b++) {
    sbfi_d3 along = sbfi_d3_sub(segments[b].tail, segments[b].head);
    double length = segments[b].is_deforming ? sbfi_d3_length(along) : 0;
    all += length;
    for (uint32_t k = 0; length > 0 && k < SAMPLES; k++) {
      sbfi_d3 at = sbfi_d3_add(segments[b].head, sbfi_d3_scale(along, (k + 0.5) / SAMPLES));
      inside += length / SAMPLES * sbfi_body_contains(rays, at);
    }
  }
  return all > 0 ? inside / all : 1;
}

/* Median distance of the surface from its bones, relative to half the local thickness of the body. Sites
 * without a hit of the far side are skipped. On a dense surface only every nth site casts a ray, which is
 * enough for a median. */
static double median_distance(const sbfi_weight_mesh *mesh, const sbfi_body_rays *rays,
    const sbfi_nearest_bone *nearest, measured *buffer, uint32_t *ray_count) {
  uint32_t count = 0, step = mesh->site_count / MAX_RAYS + 1;
  for (uint32_t i = 0; i < mesh->site_count; i += step) {
    sbfi_d3 inwards = sbfi_d3_scale(mesh->normals[i], -1);
    if (sbfi_d3_length(inwards) == 0) continue;
    sbfi_d3 from = sbfi_d3_add(sbfi_d3_of(mesh->sites[i]), sbfi_d3_scale(inwards, BELOW));
    double thickness = sbfi_body_exit_distance(rays, from, inwards);
    ++*ray_count;
    if (!isfinite(thickness) || !(thickness > BELOW)) continue;
    buffer[count++] = (measured){2 * (double)nearest[i].distance / thickness, mesh->areas[i]};
  }
  qsort(buffer, count, sizeof *buffer, compare_measured);
  return at_fraction(buffer, count, 0.5);
}

bool sbfi_bone_fit_measure(const sbfi_weight_mesh *mesh, const sbfi_body_rays *rays,
    const sbfi_bone_segment *segments, uint32_t bone_count, const sbfi_nearest_bone *nearest,
    sbfi_weights_figures *figures, sbfi_arena *arena) {
  measured *buffer = sbfi_arena_allocate(arena, mesh->site_count, sizeof *buffer);
  if (!buffer) return false;
  double surface = extent_of_surface(mesh, buffer);
  figures->inside = inside_fraction(rays, segments, bone_count);
  figures->bone_extent = surface > 0 ? extent_of_bones(segments, bone_count) / surface : 1;
  figures->median_distance = median_distance(mesh, rays, nearest, buffer, &figures->ray_count);
  for (uint32_t b = 0; b < bone_count; b++) figures->deforming_count += segments[b].is_deforming;
  return true;
}
